-- A square plate under its own weight, laid on four edges that do not pull: its corners lift.
--
--   ./dotyk scripts/examples/plate_corners.lua [FINEST]
--
-- D = 1, ν = 0.3, side 1, load 1 downwards; dotyk.law.signorini along all the edge, nothing else holds the plate. Simply supported
-- it would need forces of 0.065 at the corners to hold them down. Shown: how far from a corner the plate first touches,
-- with both elements, refined; the deflected plate and the reactions. FINEST: cells along a side, 96 at least.
-- Draws images/plate_corners.png, images/plate_corners_plan.png and images/plate_corners_length.png.
--
-- Nodes tell the lifted length up to a cell. But along the open edge, s from where it ends, u = a s^(5/2) + b s^(7/2) …: of the powers
-- of a free edge beside a supported one s^(3/2) has no place, it would pull or penetrate. So u^(2/5) = s (a' + b' s …), and the
-- parabola through it at the second, fourth and sixth open node has its zero where contact begins.

local law <const> = dotyk.law
local finest <const> = tonumber(arg[1]) or 128

local function solve(n, element)
  return dotyk.solve(dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } }, element = element, nu = 0.3,
    load = -1, edge = { deflection = law.signorini() } })
end

-- The zero of the parabola through three points that is nearest to x = 0.
local function zero(x, y)
  local first <const>, second <const> = (y[2] - y[1]) / (x[2] - x[1]), (y[3] - y[2]) / (x[3] - x[2])
  local c <const> = (second - first) / (x[3] - x[1])
  local b <const> = first - c * (x[1] + x[2])
  local a <const> = y[1] - b * x[1] - c * x[1]^2
  return -2 * a / (b + math.sqrt(b^2 - 4 * a * c))
end

-- Distance of where contact begins from the nearest corner: mean of the eight, and by how much they differ.
local function lifted(s)
  local points <const> = s:reaction "edge".points -- once about; the last is the first again
  local count <const> = #points - 1
  local function point(i) return points[(i - 1) % count + 1] end
  local sum, low, high, found = 0, math.huge, 0, 0
  for i = 1, count do
    for step = -1, 1, 2 do
      if point(i).status == "closed" and point(i + step).status == "open" then
        local x <const>, y <const> = {}, {}
        for k = 1, 3 do
          local p <const> = point(i + 2 * k * step)
          x[k], y[k] = math.abs(p.x - point(i).x) + math.abs(p.y - point(i).y), p.deflection^0.4
        end
        local at <const> = (point(i).at + step * zero(x, y)) % 1
        local length <const> = math.min(at, 1 - at)
        sum, low, high, found = sum + length, math.min(low, length), math.max(high, length), found + 1
      end
    end
  end
  assert(found == 8, "it lifts at four corners")
  return sum / 8, high - low
end

print "element  cells  iterations   lifted by nodes   extrapolated   eight apart by   u corner     u middle     reaction, largest"
local chart <const>, at <const> = {}, {}
for _, element in ipairs{ "morley", "hct" } do
  local nodes <const>, extrapolated <const> = { x = {}, y = {} }, { x = {}, y = {} }
  nodes.name, extrapolated.name = element == "hct" and "HCT" or "Morley", element == "hct" and "HCT, by nodes" or "Morley, by nodes"
  for _, part in ipairs{ 2, 3, 4, 6, 8 } do
    local n <const> = finest * part // 8
    local s <const> = solve(n, element)
    local r <const>, length <const>, apart <const> = s:reaction "edge", lifted(s)
    local most = 0
    for _, p in ipairs(r.points) do
      most = math.max(most, p.reaction)
      assert(p.reaction >= 0)
    end
    assert(s.converged and math.abs(r.force - 1) < 1e-9)
    print(("%-7s  %5d  %10d   %15.5f   %12.5f   %14.0e   %.4e   %.4e  %8.4f"):format(element, n, s.iterations, r.open / 8, length, apart,
      s:deflection(0, 0), s:deflection(0.5, 0.5), most))
    for series, y in pairs{ [nodes] = length, [extrapolated] = r.open / 8 } do
      series.x[#series.x + 1], series.y[#series.y + 1] = 1 / n, y
    end
    at[element] = { length = length, before = at[element] and at[element].length, corner = s:deflection(0, 0), middle = s:deflection(0.5, 0.5) }
  end
  extrapolated.twin = true
  chart[#chart + 1], chart[#chart + 2] = nodes, extrapolated
end
local morley <const>, hct <const> = at.morley, at.hct
local apart <const> = math.abs(morley.length / hct.length - 1)
print(("lifted length: Morley %.5f, HCT %.5f, apart by %.2f %%; deflection of the corner by %.2f %%, of the middle by %.2f %%"):format(morley.length,
  hct.length, 100 * apart, 100 * math.abs(morley.corner / hct.corner - 1), 100 * math.abs(morley.middle / hct.middle - 1)))
assert(apart < 0.005 * math.max(1, 128 / finest)) -- 0.5 % from 128 cells on
for _, e in pairs(at) do assert(math.abs(e.length / e.before - 1) < 0.01) end -- and it converges

dotyk.chart{ file = "images/plate_corners_length.png", title = "From a corner to where it touches", x = "length of a cell",
  y = "lifted length", series = chart }
solve(32, "hct"):render{ file = "images/plate_corners.png", title = "A plate laid on four edges lifts its corners", eye = { 1, -1.7, 1.1 }, deform = 60 }
solve(64, "morley"):render{ file = "images/plate_corners_plan.png", view = "plan", title = "Reactions of edges that do not pull" }
print "images/plate_corners.png, images/plate_corners_plan.png, images/plate_corners_length.png"
