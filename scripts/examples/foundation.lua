-- A strip on foundations of three kinds: one that pulls as well, one that only pushes, one whose pressure has a greatest
-- value.
--
--   ./dotyk scripts/examples/foundation.lua [CELLS]
--
-- A slender elastic strip, free but for its foundation and symmetry, is pressed down in its middle; its ends lift. In
-- beam theory, λ = (k/4EJ)^(1/4), all is in closed form: a weightless beam on a foundation without tension touches over the
-- half length π/2λ whatever the load, and its pressure is that of a beam of just this length on springs. Checked
-- by that, by the balance of forces, and by a second method. CELLS: along half the strip, a multiple of 80.
-- Draws images/foundation.png: the pressures; images/foundation_strip.png: the strip on the one-sided foundation.

local cells <const> = tonumber(arg[1]) or 160
local law <const> = dotyk.law
local half <const>, height <const>, E <const> = 3, 0.1, 1000 -- of half the strip
local lambda <const> = 1.5
local EJ <const> = E * height^3 / 12
local k <const> = 4 * EJ * lambda^4
local load <const> = 0.1 -- of the whole strip, over a short patch
local patch <const> = half / 80
local contact <const> = math.pi / (2 * lambda)
local unit <const> = load * lambda / 2 -- the pressure under a load on a long beam on springs

local function strip(foundation)
  local body <const> = dotyk.body{ name = "strip", material = dotyk.material{ E = E, nu = 0.3, plane = "stress" },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { half, height }, cells = { cells, cells // 20 }, element = "Q1" } }
  body:part "left":slide() -- symmetry
  body:part "bottom":support{ normal = foundation }
  body:part("patch", function(x, _, _, ny) return ny > 0.9 and x < patch end):pressure(0.5 * load / patch)
  return body
end

-- The pressure of a beam of half length c on springs, pressed by `load` in the middle (Hetényi's finite beam): with t = c − x
-- from the free end, w = A cosh λt cos λt + B (cosh λt sin λt + sinh λt cos λt), A and B from w'(x = 0) = 0 and the balance.
local function beam(c)
  local function ch(t) return (math.exp(t) + math.exp(-t)) / 2 end
  local function sh(t) return (math.exp(t) - math.exp(-t)) / 2 end
  local l <const> = lambda * c
  local cc <const>, cs <const>, sc <const>, ss <const> = ch(l) * math.cos(l), ch(l) * math.sin(l), sh(l) * math.cos(l), sh(l) * math.sin(l)
  -- w'/λ = A (sc − cs) + 2B cc = 0;  ∫k w = k/2λ (A (sc + cs) + 2B ss) = load/2.
  local a <const>, b <const> = 2 * cc, cs - sc
  local size <const> = load * lambda / k / (a * (sc + cs) + 2 * b * ss)
  return function(x)
    local t <const> = lambda * (c - x)
    return k * size * (a * ch(t) * math.cos(t) + b * (ch(t) * math.sin(t) + sh(t) * math.cos(t)))
  end
end

local kinds <const> = {
  { name = "springs", law = law.elastic(k), exact = beam(half) },
  { name = "no tension", law = law.one_sided_elastic(k), exact = beam(contact), touches = contact },
  { name = "up to 0.7", law = law.capped_elastic(k, 0.7 * unit) } }

local series <const> = {}
print(("half length of contact in beam theory, pi/2 lambda = %.4f; pressures are scaled by lambda load/2 = %.4f"):format(contact, load * lambda / 2))
print "foundation                            reaction   greatest pressure   touches up to   beam theory apart by   methods apart by"
for number, kind in ipairs(kinds) do
  local body <const> = strip(kind.law)
  local scene <const> = dotyk.scene{ body }
  local s <const>, bottom <const> = dotyk.solve(scene), body:part "bottom"
  local _ <const>, up <const> = s:reaction(bottom)
  local r <const>, x, p = s:support(bottom), {}, {}
  local touches, apart = 0, 0
  for i, n in ipairs(r.nodes) do
    x[i], p[i] = n.x, n.pressure / unit
    if n.pressure > 0 then touches = math.max(touches, n.x) end
    if kind.exact and (not kind.touches or n.x < kind.touches) then apart = math.max(apart, math.abs(n.pressure - kind.exact(n.x))) end
  end
  local other <const> = dotyk.solver.newton{}:solve(scene)
  local between <const> = math.abs(other.energy / s.energy - 1)
  print(("%-36s  %8.5f   %17.4f   %13.4f   %20s   %16.1e"):format(kind.name, 2 * up, r.max_pressure / unit, touches,
    kind.exact and ("%.4f"):format(apart / unit) or "", between))
  assert(s.converged and other.converged and between < 1e-9)
  assert(math.abs(2 * up - load) < 1e-9)
  table.insert(series, { name = kind.name, x = x, y = p, style = "line" })
  if kind.exact then
    local bx <const>, by <const> = {}, {}
    for i = 0, 240 do
      bx[#bx + 1] = (kind.touches or half) * i / 240
      by[#by + 1] = kind.exact(bx[#bx]) / unit
    end
    table.insert(series, { name = kind.name == "springs" and "beam theory" or nil, x = bx, y = by, reference = true })
    assert(apart < 0.01 * (160 / cells)^2 * unit) -- bilinear elements are too stiff in bending, with h^2
  end
  if number == 2 then
    assert(math.abs(touches - contact) < 0.05 * contact + half / cells)
    s:render{ file = "images/foundation_strip.png", field = "xx", units = { length = "mm", stress = "MPa", load = "MPa" }, deform = 5, supports = true, loads = true,
              size = { 1200, 560 }, title = "Half a strip on springs without tension" }
  end
end
dotyk.chart{ file = "images/foundation.png", title = "A strip pressed in its middle", x = "distance from the middle [mm]",
  y = "pressure / peak of beam theory", series = series }
print "images/foundation.png, images/foundation_strip.png"
