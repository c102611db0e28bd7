-- Plates whose data vary along the edge: moments g₂(s) and forces g₃(s), friction κ(s), springs k(s) (Horák and Fibinger, ODAM 2001).
--
--   ./dotyk scripts/papers/horak_fibinger/plate_edges.lua [FINEST]
--
-- Unit square, D = 1, ν = 0.3. The deflections u = A(x) + B(x) ψ(y), ψ = -y²(1 - y)², are known; f = Δ²u, Mₙu and Tₙu follow from
-- them. u_xy = 0 at the corners, so no force is concentrated there. A and B are chosen for each problem of the paper:
-- Free plate, (26)-(31): A = 0, B = eˣ; u = 0 at the corners. g₂ and g₃ vary on all four edges, f inside. Together they satisfy
--    the three equations of lemma 2, (33), and so do the loads that the elements make of them: three corners are held in part 1 to fix the
--    rigid motions, and bear nothing. Without any support it is solved as well (part 2).
-- Friction, (51)-(58): ∂ₙu = 0. A > 0 left of 3/8, 0 as far as 5/8, < 0 to the right. On top and bottom Tₙ = 12 B. The edge slips
--    up on the left (Tₙ = -κ), down on the right (Tₙ = κ), and sticks between (|Tₙ| < κ). Loads that friction bears satisfy
--    |∫f| ≤ ∫κ (lemma 12); where uniform loads are refused is found by bisection.
-- One-sided springs, (65)-(72), which push up: A > 0 and Tₙ = 0 left of 3/8; to the right A < 0 and k = Tₙ/(-u).
-- Shown: errors of both elements and their orders, 1 in energy and 2 in L2 with Morley, 2 and 4 with HCT for the free plate,
-- whose loads are projected on the linear functions of each edge. Friction and springs act by their values at nodes, which leaves HCT 2 in L2. Where sticking or open parts end, the deflection of the edge begins with the fourth power; deflections are off
-- by h², so these ends are off by √h. FINEST: cells along a side, 32, 64, …
-- Draws images/papers_plate_edges.png, …_free.png, …_friction.png and …_springs.png.

local law <const> = dotyk.law
local common <const>, plate <const> = include "../../lib/common.lua", include "../../lib/plate.lua"
local finest <const>, nu <const> = math.tointeger(tonumber(arg[1]) or 64), 0.3
local x1 <const>, x2 <const> = 3 / 8, 5 / 8

local known_plate <const> = include "../../lib/plate_known.lua"
local polynomial <const>, scaled <const>, none <const>, sides <const>, place <const> = known_plate.polynomial, known_plate.scaled, known_plate.none,
  known_plate.sides, known_plate.place
local function deflection(A, B) return known_plate.deflection(A, B, nu) end

local steep <const> = polynomial{ 0, 0, 0, 0, 15, -24, 10 } -- 1 at 1, slope 0, third derivative 120
local flat <const> = polynomial{ 0, 0, 0, 0, 10, -14, 5 } -- 1 at 1, slope and third derivative 0

-- The three problems: what is known, and the laws of a side.
local function exponential(t)
  local e <const> = math.exp(t)
  return { e, e, e, e, e }
end
local free <const> = deflection(none, exponential)
free.supports = {}
for k, at in ipairs{ { 0, 0 }, { 1, 0 }, { 0, 1 } } do free.supports[k] = { x = at[1], y = at[2], deflection = law.prescribed() } end
function free.laws(side)
  return { rotation = function(x, y) return law.load(-free.M(side, x, y)) end, deflection = function(x, y) return law.load(free.T(side, x, y)) end }
end

local friction <const> = deflection(function(x) -- Tₙ = ±1 at the corners
  local size <const> = x1^3 / 120
  return x < x1 and scaled(steep, size, -1 / x1, x1)(x) or x > x2 and scaled(steep, -size, 1 / x1, x2)(x) or none()
end, scaled(polynomial{ 0, 3 / 2, 0, -1 / 2 }, 1 / 12, 2, 1 / 2))
function friction.data(side, x, y) -- κ
  local known <const> = math.abs(friction.T(side, x, y))
  return (side == "left" or side == "right") and known or math.max(known, math.abs(friction.T(side, x1, y)))
end
function friction.laws(side) return { rotation = law.prescribed(), deflection = function(x, y) return law.friction(friction.data(side, x, y)) end } end

local down <const>, bump <const> = 0.001, 0.001 * 120 / (12 * x2^3) -- k is continuous at the right corners
local springs <const> = deflection(function(x) return x < x1 and scaled(flat, down, -1 / x1, x1)(x) or scaled(steep, -down, 1 / x2, x1)(x) end,
  function(x) return x < x1 and none() or scaled(flat, bump, 1 / x2, x1)(x) end)
function springs.data(side, x, y) -- k
  if side == "right" then return springs.T(side, x, y) / -springs.u(x, y) end
  local s <const> = math.max(0, (x - x1) / x2)
  return 12 * bump / down * (10 - 14 * s + 5 * s^2) / (15 - 24 * s + 10 * s^2)
end
function springs.laws(side) return { rotation = law.prescribed(), deflection = function(x, y) return law.one_sided_elastic(springs.data(side, x, y)) end } end

local function make(problem, n, element, load)
  local edges <const> = {}
  for _, side in ipairs(sides) do edges[side] = problem.laws(side) end
  return dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } }, element = element, nu = nu,
    load = load or problem.f, edges = edges, supports = problem.supports }
end

-- 1. Errors on refined meshes; with friction and springs also that of the edge's forces, ∫|reaction - Tₙ| / ∫|Tₙ|.
local problems <const> = { { "free", free, "Free plate" }, { "friction", friction, "Friction" }, { "springs", springs, "One-sided springs" } }
local labels <const>, orders <const> = { morley = "Morley", hct = "HCT" }, { morley = { 1, 2 }, hct = { 2, 2 }, free = { 2, 4 } }
local panels <const>, solved <const>, wrong = {}, {}, 0
print "relative errors        cells    energy  order   L2       order   reactions  order   corner supports bear, or length that sticks or is open"
for _, problem in ipairs(problems) do
  local name <const>, known <const>, title <const> = table.unpack(problem)
  local series <const> = {}
  for _, element in ipairs{ "morley", "hct" } do
    local of <const> = {}
    for k, what in ipairs{ "energy", "L2", "reactions" } do of[k] = common.curve(labels[element] .. ", " .. what:gsub("L2", "L²")) end
    local n = 8
    while n <= finest do
      local s <const> = dotyk.solve(make(known, n, element))
      assert(s.converged, s.reason)
      local energy <const>, L2 <const> = plate.distance(s, n, nu, known.u)
      local off, size, length, expected = 0, 0, 0, nil
      if known.data then
        for _, side in ipairs(sides) do
          for _, point in ipairs(s:reaction(side).points) do
            local T <const> = known.T(side, point.x, point.y)
            off, size = off + point.length * math.abs(point.reaction - T), size + point.length * math.abs(T)
            if point.status == "stick" or point.status == "open" then length = length + point.length end
          end
        end
        expected = name == "friction" and 2 * (x2 - x1) or 1 + 2 * x1
        wrong = math.max(wrong, math.abs(length - expected) * math.sqrt(n))
      else
        for k = 1, 3 do length = math.max(length, math.abs(s:reaction(k).force)) end
      end
      local line = ("%-10s %-8s  %5d "):format(name, element, n)
      for k, value in ipairs{ energy, L2, known.data and off / size } do
        local before <const> = of[k].y[#of[k].y]
        local order <const> = before and math.log(before / value, 2)
        line = line .. ("   %.1e  %5s"):format(value, order and ("%.2f"):format(order) or "")
        of[k]:add(1 / n, value)
        if n == finest and k < 3 then assert(order > orders[name == "free" and element == "hct" and "free" or element][k] - 0.25, ("%s, %s: order %.2f"):format(name, element, order)) end
      end
      print(line .. (known.data and ("           %.4f (%.2f)"):format(length, expected) or ("                     %.1e"):format(length)))
      assert(known.data or length < 1e-12) -- the loads balance
      solved[name], n = s, 2 * n
    end
    of[2].twin = true
    series[#series + 1], series[#series + 2] = of[1], of[2]
  end
  panels[#panels + 1] = { title = title .. (not known.data and ": data" or name == "springs" and ": stiffness and reactions" or ": bound and reactions"), x = "s, along the edge from (0, 0)", y = known.data and "force per length" or "moment, force per length", x_range = { 0, 4 } }
  panels[#panels + 1] = { title = title .. ": relative errors", x = "length of a cell", y = "relative error", log = "xy", series = series, slopes = known.data and { 1, 2 } or { 2, 4 } }
end

-- 2. The free plate without its supports, under cubic data: u = -x³/6 up to rigid motions, Tₙ = ±1 at the right and left, Mₙ = x at the right and
-- 0.3 x at top and bottom. HCT has it exactly. Then one of the three equations of lemma 2 is violated by 0.001.
local function cubic(violation)
  local function moment(side, x) return (side == "right" and 1 or side == "left" and 0 or nu * x) + (violation == side and 0.001 or 0) end
  local edges <const> = {}
  for _, side in ipairs(sides) do
    local force <const> = (side == "right" and 1 or side == "left" and -1 or 0) + (violation == "force" and 0.00025 or 0)
    edges[side] = { rotation = function(x) return law.load(-moment(side, x)) end, deflection = law.load(force) }
  end
  return dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 8, 8 } }, element = "hct", nu = nu, edges = edges }
end
local exact <const>, off = dotyk.solve(cubic()), 0
for i = 0, 20 do
  for j = 0, 20 do -- (u, 1) = (u, x) = (u, y) = 0: -x³/6 less its nearest line
    local x <const>, y <const> = i / 20, j / 20
    off = math.max(off, math.abs(exact:deflection(x, y) + x^3 / 6 - (0.15 * x - 1 / 30)))
  end
end
local smooth <const> = dotyk.solve(make({ f = free.f, laws = free.laws }, finest, "hct"))
print(("\nfree plate, cubic data: off u by %.0e; smooth data without any support: %s"):format(off, smooth.reason))
assert(smooth.reason:find "unique up to all rigid motions")
assert(off < 1e-10 and exact.reason:find "unique up to all rigid motions")
for k, violation in ipairs{ "force", "right", "top" } do
  local found <const>, why <const> = pcall(dotyk.solve, cubic(violation))
  assert(not found and why:find("(33)", 1, true), why)
  print(("  equation %d of (33) violated by 0.001: refused, nothing stops %s"):format(k, why:match "the motion 'plate': (.-), on which"))
end

-- 3. The greatest uniform load that friction κ(s) bears, by bisection: ∫κ, which the elements take by the trapezoidal rule.
local bound, last, least = 0, nil, math.huge
for i = 0, 7999 do
  local side <const>, x <const>, y <const> = place((i + 0.5) / 2000)
  bound, least = bound + friction.data(side, x, y) / 2000, math.min(least, friction.data(side, x, y), springs.data(side, x, y))
end
assert(least > 0.1) -- κ ≥ κ₀ > 0, k ≥ k₀ > 0 (65)
print(("\n∫κ = %.6f; refused from p ="):format(bound))
for _, n in ipairs{ 8, 16, 32 } do
  local greatest <const> = common.boundary(0.5 * bound, 2 * bound, function(p) return (pcall(dotyk.solve, make(friction, n, "morley", -p))) end, 1e-6)
  print(("  %.6f  with %2d cells a side%s"):format(greatest, n, last and (", order %.2f"):format(math.log((last - bound) / (greatest - bound), 2)) or ""))
  assert(not last or math.abs(math.log((last - bound) / (greatest - bound), 2) - 2) < 0.1)
  last = greatest
end

-- 4. Figures.
local function along(name, of, options) -- a curve over s, broken at the corners by a small step
  local curve <const> = common.curve(name, options)
  curve.style = curve.style or "line"
  for side = 0, 3 do
    for i = 0, 60 do
      local s <const> = side + 1e-9 + (1 - 2e-9) * i / 60
      curve:add(s, of(place(s)))
    end
  end
  return curve
end
local function reactions(name) -- computed, at 15 places of a side, off the corners
  local every <const> = finest // 16
  local curve <const> = common.curve("reactions, HCT", { style = "points" })
  for k, side in ipairs(sides) do
    for i, point in ipairs(solved[name]:reaction(side).points) do
      local s <const> = k - 1 + (k == 1 and point.x or k == 2 and point.y or k == 3 and 1 - point.x or 1 - point.y)
      if not point.corner and i % every == 1 % every then curve:add(s, point.reaction) end
    end
  end
  return curve
end
panels[1].series = { along("g₂, moments", free.M), along("g₃, forces", free.T) }
panels[3].series = { along("κ and −κ", friction.data, { reference = true }), along(nil, function(...) return -friction.data(...) end, { reference = true }),
  along("Tₙ", friction.T), reactions "friction" }
panels[5].series = { along("k / 1000", function(...) return down * springs.data(...) end, { reference = true }), along("Tₙ", springs.T), reactions "springs" }
dotyk.chart{ file = "images/papers_plate_edges.png", panels = panels, columns = 2, size = { 2100, 1800 } }
smooth:render{ file = "images/papers_plate_edges_free.png", title = "Free plate under g₂(s), g₃(s) and f" }
solved.friction:render{ file = "images/papers_plate_edges_friction.png", view = "plan", title = "Friction κ(s) along the edge" }
solved.springs:render{ file = "images/papers_plate_edges_springs.png", title = "One-sided springs k(s) at the edge" }
print "images/papers_plate_edges.png, …_free.png, …_friction.png, …_springs.png"
common.verdict(wrong < 1, ("with data that vary along the edge both elements tend to the known deflections with order 1 or 2; lengths that stick or are open are off by %.2f √h at most")
  :format(wrong))
