-- Foundations under beams, with the laws of supports: Horák (ODAM 2001, section 4) proposes them and gives no example.
--
--   ./dotyk scripts/papers/horak/beam_foundations.lua [CELLS]
--
-- 1. A long beam is pressed by a force P in the middle; x is counted from there. Its length scale is 1/λ with λ = (k/4EJ)^(1/4). With pressures
--    in units of λP/2 and deflections in units of λP/2k the foundation bears
--    Winkler      -k u:         e^{-λx} (cos λx + sin λx);
--    one-sided    k u⁻:         (cosh τ sin τ + sinh τ cos τ)/sinh(π/2) with τ = π/2 - λx (Hetényi's beam with free ends): it touches over
--                               |x| < π/2λ whatever P is;
--    capped       -k u, |·| ≤ g: it yields over |x| < a where λP/2g = (2/3 α³ + 2α² + 2α + 1)/(1 + α)², α = λa. Beyond a the deflection is a
--                               decaying wave that begins with g/k, within it a polynomial of degree 4. Here α = 1 and λP/2g = 17/12.
-- 2. A clamped beam under the load q meets a rigid floor, u ≥ h(x) = -d + ½κ (x - L/2)². It hangs free over 0 < x < a, and meets the floor with
--    its slope and curvature: u = h(a) - h'(a) s + ½κ s² + A s³ - q/24EJ s⁴, s = a - x. A and a follow from u(0) = u'(0) = 0. The floor bears q
--    where they touch, and a force 6EJ A where they part. For κ = 0: a = (72 EJ d/q)^(1/4) and a force qa/3.
-- Checked: against these closed forms, with errors of the order of the square of a cell, the balance of forces, PDAS against a second method.
-- CELLS: along each beam at most. Draws images/papers_beam_foundations.png.

local most <const> = math.tointeger(tonumber(arg[1]) or 240)
local law <const> = dotyk.law
local common <const> = include "../../lib/common.lua"
local function ch(t) return (math.exp(t) + math.exp(-t)) / 2 end
local function sh(t) return (math.exp(t) - math.exp(-t)) / 2 end
local function apart(s, t, length)
  local worst = 0
  for i = 0, 100 do worst = math.max(worst, math.abs(s:deflection(length * i / 100) - t:deflection(length * i / 100))) end
  return worst
end

-- 1. EJ = 1 and k = 4, so that λ = 1; P = 2, so that pressures are scaled, and so is -k u.
local long <const>, k <const>, P <const> = 20, 4, 2
local function winkler(x) return math.exp(-x) * (math.cos(x) + math.sin(x)) end
local lift <const> = math.pi / 2
local function one_sided(x) -- beyond the contact it is straight
  local t <const> = lift - x
  if t > 0 then return (ch(t) * math.sin(t) + sh(t) * math.cos(t)) / sh(lift) end
  return 2 * t / sh(lift)
end
local a <const>, cap <const> = 1, 12 / 17
local function capped(x) -- A and B of the wave from u(a) = -g/k and the shear force there, c₂ from the curvature
  local A <const> = cap
  local B <const> = cap * (2 / cap - 2 * a - 1)
  if x > a then return math.exp(a - x) * (A * math.cos(x - a) + B * math.sin(x - a)) end
  local c2 <const> = (-2 * B - 2 * P * a + 2 * cap * a^2) / 2
  local function inner(y) return c2 * y^2 + P * y^3 / 3 - cap * y^4 / 6 end
  return cap + inner(x) - inner(a)
end
assert(math.abs(1 / cap - (2 / 3 * a^3 + 2 * a^2 + 2 * a + 1) / (1 + a)^2) < 1e-15)
local foundations <const> = {
  { name = "Winkler", law = law.elastic(k), exact = winkler, second = "newton" },
  { name = "one-sided", law = law.one_sided_elastic(k), exact = one_sided, second = "newton", touches = lift },
  { name = "capped", law = law.capped_elastic(k, cap), exact = capped, second = "newton" } }
local order <const>, pressures <const>, lines <const> = {}, {}, {}
print "1. a force on a long beam; deflections and pressures in their units\n   foundation   cells   deflection   pressure in the middle   it should be   methods apart"
for _, f in ipairs(foundations) do
  f.errors = common.curve(f.name)
  local n = most // 8
  while n <= most do
    local b <const> = dotyk.beam{ length = long, cells = n, loads = { { x = long / 2, force = -P } }, foundation = f.law }
    local s <const> = dotyk.solve(b)
    local other <const> = dotyk.solver[f.second]{}:solve(b)
    local error, sum, touches = 0, 0, 0
    for i = 0, n // 4 do -- half of the half: the ends are far
      local x <const> = i * long / n
      error = math.max(error, math.abs(-k * s:deflection(long / 2 + x) - f.exact(x)))
      if s:pressure(long / 2 + x) > 0 then touches = x end
    end
    for i = 0, n do sum = sum + s:pressure(i * long / n) * long / n * ((i == 0 or i == n) and 0.5 or 1) end
    f.errors:add(long / n, error)
    print(("   %-12s %5d   %10.6f   %22.6f   %12.6f   %13.1e"):format(f.name, n, -k * s:deflection(long / 2), s:pressure(long / 2), f.exact(0), apart(s, other, long)))
    assert(s.converged and other.converged and apart(s, other, long) < 1e-6) -- what rounding leaves of fine beams
    assert(math.abs(sum - P) < 1e-8)
    assert(not f.touches or math.abs(touches - f.touches) <= long / n)
    if n == most then
      local points <const>, line <const> = common.curve(f.name), common.curve(f.name .. ", exact", { reference = true, style = "line" })
      for i = -27, 27 do points:add(i / 4.5, s:pressure(long / 2 + i / 4.5)) end
      for i = -240, 240 do
        local p = f.exact(math.abs(i) / 40)
        if f.touches then p = math.max(p, 0) end
        line:add(i / 40, f.name == "capped" and math.min(p, cap) or p)
      end
      points.style = "points"
      pressures[#pressures + 1], lines[#lines + 1] = points, line
    end
    n = 2 * n
  end
  order[#order + 1] = f.errors
end

-- The contact's length does not depend on the force.
local lengths <const> = {}
for _, force in ipairs{ 0.001, 1, 1000 } do
  local s <const> = dotyk.solve(dotyk.beam{ length = long, cells = most, loads = { { x = long / 2, force = -force } }, foundation = law.one_sided_elastic(k) })
  local touching = 0
  for i = 0, most do touching = touching + (s:pressure(i * long / most) > 0 and 1 or 0) end
  lengths[#lengths + 1] = touching * long / most
end
print(("   one-sided, forces 0.001, 1 and 1000: it touches over %.4f, %.4f and %.4f (π/λ = %.4f)"):format(lengths[1], lengths[2], lengths[3], math.pi))
assert(lengths[1] == lengths[2] and lengths[2] == lengths[3] and math.abs(lengths[1] - math.pi) < 2 * long / most)

-- 2. EJ = 1, L = 2.
local L <const>, q <const>, d <const> = 2, 40, 0.05
local B <const> = -q / 24
local floors, shapes <const> = { -0.1, 0, 0.1 }, {}
print "2. a clamped beam on a floor of curvature κ\n     κ      it parts at   force there   floor bears   it should be   moment at the wall   it should be   methods apart"
for _, kappa in ipairs(floors) do
  local function h(x) return -d + kappa / 2 * (x - L / 2)^2 end
  local function slope(x) return kappa * (x - L / 2) end
  local function cubic(at) return (slope(at) - kappa * at - 4 * B * at^3) / (3 * at^2) end
  local function missing(at) return h(at) - slope(at) * at + kappa / 2 * at^2 + cubic(at) * at^3 + B * at^4 end
  local low, high = 1e-3, L / 2
  assert(missing(low) < 0 and missing(high) > 0)
  for _ = 1, 60 do
    local between <const> = (low + high) / 2
    if missing(between) < 0 then low = between else high = between end
  end
  local at <const>, A <const> = low, cubic(low)
  if kappa == 0 then assert(math.abs(at - (72 * d / q)^0.25) < 1e-12) end
  local function exact(x)
    local s <const> = at - math.min(x, L - x)
    return s > 0 and h(at) - slope(at) * s + kappa / 2 * s^2 + A * s^3 + B * s^4 or h(x)
  end
  local held <const> = { deflection = law.prescribed(), rotation = law.prescribed() }
  local errors <const> = common.curve("κ = " .. tostring(kappa):gsub("-", "−"))
  local n, s = most // 8, nil
  while n <= most do
    local b <const> = dotyk.beam{ length = L, cells = n, load = -q, left = held, right = held, foundation = law.signorini(), foundation_at = h }
    s = dotyk.solve(b)
    local other <const> = dotyk.solver.interior_point{}:solve(b)
    local error, sum = 0, 0
    for i = 0, 400 do error = math.max(error, math.abs(s:deflection(L * i / 400) - exact(L * i / 400))) end
    for i = 0, n do sum = sum + s:pressure(i * L / n) * L / n * ((i == 0 or i == n) and 0.5 or 1) end
    errors:add(L / n, error / d)
    local bears <const>, moment <const> = q * (L - 2 * at) + 12 * A, -(kappa + 6 * A * at + 12 * B * at^2)
    assert(s.converged and other.converged and apart(s, other, L) < 1e-6 * d)
    assert(math.abs(sum + s:reaction "left".force + s:reaction "right".force - q * L) < 1e-6 * q)
    assert(s.residual.penetration < 1e-10)
    if n == most then
      print(("   %4.1f   %11.6f   %11.6f   %11.6f   %12.6f   %18.6f   %12.6f   %13.1e"):format(kappa, at, 6 * A, sum, bears, s:moment(0), moment, apart(s, other, L)))
      assert(math.abs(sum - bears) < 0.2 * bears * (96 / n)^2 + 1e-4 * bears and math.abs(s:moment(0) - moment) < 0.2 * math.abs(moment) * (96 / n)^2 + 1e-4 * math.abs(moment))
      local points <const>, floor <const> = common.curve(errors.name, { style = "points" }), common.curve(nil, { reference = true })
      for i = 0, 40 do points:add(L * i / 40, s:deflection(L * i / 40) / d) end
      for i = 0, 100 do floor:add(L * i / 100, exact(L * i / 100) / d) end
      shapes[#shapes + 1], lines[#lines + 1] = points, floor
    end
    n = 2 * n
  end
  order[#order + 1] = errors
end

-- Errors over the square of a cell's length: they do not fall evenly, since the ends of the contact lie between nodes.
local worst = 0
for _, errors in ipairs(order) do
  local ratios <const> = {}
  for i, length in ipairs(errors.x) do
    ratios[i] = ("%8.4f"):format(errors.y[i] / length^2)
    worst = math.max(worst, errors.y[i] / length^2)
  end
  print(("   error / cell²: %-17s %s"):format(errors.name, table.concat(ratios)))
end
local shown <const> = { pressures[1], pressures[2], pressures[3], lines[1], lines[2], lines[3] }
for i = 4, 6 do shapes[i] = lines[i] end
for i, line in ipairs(lines) do line.name, line.reference, line.style = (i == 1 or i == 4) and "exact" or nil, true, nil end
dotyk.chart{ file = "images/papers_beam_foundations.png", columns = 2, size = { 2100, 1400 }, panels = {
  { title = "A force on a long beam", x = "position λx", y = "pressure / peak of Winkler's", x_range = { -6.3, 6.3 }, series = shown },
  { title = "Clamped, floors of curvature κ", x = "x", y = "deflection / gap at the middle", y_range = { -1.3, 0.1 }, x_range = { -0.1, 2.1 }, series = shapes },
  { title = "A force: error of the deflection", x = "length of a cell", y = "relative error", log = "xy", slopes = { 2, 4 }, series = { table.unpack(order, 1, 3) } },
  { title = "Floors: error of the deflection", x = "length of a cell", y = "relative error", log = "xy", slopes = { 2 }, series = { table.unpack(order, 4) } } } }
print "images/papers_beam_foundations.png"
common.verdict(worst < 1.5, ("six foundations have the deflections of their closed forms up to %.2f times the square of a cell; without tension one bears over π/λ whatever the force"):format(worst))
