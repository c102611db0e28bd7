-- The profile of a roller that spreads its load evenly: peaks of 1.02 times the mean at its ends, not infinite ones.
--
--   ./dotyk scripts/examples/roller.lua [CELLS]       CELLS: along half the roller, 16 or more; below 32 without the tables of section 7
--
-- An axial section in plane strain: a roller of length 2a, pressed on a raceway by p0 on average. Two cases, each
-- a half beside its plane of symmetry, a half-plane being a block of 20a:
--   free      the roller is a block 2a wide with free sides, as rollers are; the raceway is a half-plane;
--   embedded  both are half-planes, in contact along |x| < a alone.
-- Straight, both have infinite pressure at the ends: embedded that of an external crack, 2 p0/(π √(1 − ξ²)), ξ = x/a,
-- free r^(λ − 1) with 2 cot πλ + sin πλ/(sin² ½πλ − λ²) = 0, λ = 0.774 (wedges π and ½π of one material; Dundurs and
-- Lee 1972).
--
-- The profile sought is known. A line load P moves the surface of a half-plane by −2c/π P ln|x − s| + const, c = (1 − ν²)/E
-- (Flamant); pressure p0 over |s| < a, added up, moves it away from the tangent in the middle by
--   z(x) = 2 p0 a c/π · [(1 + ξ) ln(1 + ξ) + (1 − ξ) ln(1 − ξ)],
-- and a profile that drops by as much, for all bodies in contact together, closes evenly. Embedded c is the sum of both
-- bodies'. Between free sides even pressure strains the roller evenly from end to end: its surface stays straight and c
-- is the raceway's alone. At the end the slope is infinite, the drop 4 ln 2 p0 a c/π.
-- Lundberg's profile, A ln(1/(1 − ξ²)), does the same for a contact in space that is narrow against its length. Here it is only
-- compared, A fitted; so is its kind with a finite end, A ln(1/(1 − κξ²)) (Johns and Gohar).
--
-- Found without knowing it: the least (mean of p^8)^(1/8) over control points of B-splines. Of all pressures with one
-- mean the constant one has the least mean of p^q, whatever q > 1: smoothing the peak does not shift the optimum. Splines end
-- with a finite slope, the profile sought does not: with splines alone a weak singularity of the pressure is left, and its peak
-- over the mean grows with each refinement. So one variable more is the amplitude of the infinite slope, (1 − ξ) ln(1 − ξ) + ξ,
-- and a second search with q = 40 follows: the mean of p^8 hardly feels a peak that is one node wide.
-- What is left: on 16 cells peaks of 1.002 embedded and 1.004 between free sides, and no node has less than 0.99 of the mean.
-- Draws images/roller.png and images/roller_scene.png. Units: N, mm.

local cells <const> = tonumber(arg[1]) or 48
local a <const>, E <const>, nu <const>, p0 <const> = 10, 2.1e5, 0.3, 1500
local far <const> = 20 -- size of the blocks by a
local steel <const> = dotyk.material{ E = E, nu = nu }
local fit <const> = include "../lib/least_squares.lua"

-- 1. Known profiles.
local function xlnx(x) return x > 0 and x * math.log(x) or 0 end
local function closed_form(case, p)
  local factor = (case == "free" and 1 or 2) * 2 * p * a * (1 - nu^2) / E / math.pi
  return function(x) return factor * (xlnx(1 + x / a) + xlnx(1 - x / a)) end
end
local function logarithmic(kappa) return function(x) return -math.log(math.max(1e-9, 1 - kappa * (x / a)^2)) end end

-- 2. The scene, on the right of x = 0 or, side = -1, on the left. Cells grow like exp(5t) away from the end, |x| = a, y = 0.
-- A profile z(x) given moves the roller's nodes, a gap given leaves them and is added to the gap.
local growth <const> = 5
local function grown(t) return (math.exp(growth * t) - 1) / (math.exp(growth) - 1) end -- in a; grown(1) = 1
local function steps_to(l) return math.log(1 + l * (math.exp(growth) - 1)) / growth end -- grown(steps_to(l)) = l
local function depth(l) return function(s) return grown(s * steps_to(l)) / l end end
local function mirrored(f) return function(s) return 1 - f(1 - s) end end
local function body(name, side, from, to, count, x, y, profile)
  if side < 0 then from, to, x = { -to[1], from[2] }, { -from[1], to[2] }, mirrored(x) end
  local mesh = dotyk.mesh.rectangle{ from = from, to = to, cells = count, element = "Q1", grading = { x = x, y = y } }
  if profile then mesh:transform(function(u, v) return u, v + profile(math.abs(u)) * (1 - v / to[2]) end) end
  return dotyk.body{ name = side > 0 and name or name .. " on the left", material = steel, mesh = mesh }
end
local function half(case, n, p, side, profile)
  local beside, deep, L = math.ceil(n * steps_to(far - 1)), math.ceil(n * steps_to(far)), far * a
  local function wide(s)
    local k = s * (n + beside) - n
    return k <= 0 and (1 - grown(-k / n)) / far or (1 + grown(k / beside * steps_to(far - 1))) / far
  end
  local raceway = body("raceway", side, { 0, -L }, { L, 0 }, { n + beside, deep }, wide, mirrored(depth(far)))
  local roller
  if case == "free" then
    roller = body("roller", side, { 0, 0 }, { a, 2 * a }, { n, math.ceil(n * steps_to(2)) }, mirrored(depth(1)), depth(2), profile)
    roller:part "top":load{ 0, -p }
  else
    roller = body("roller", side, { 0, 0 }, { L, L }, { n + beside, deep }, wide, depth(far), profile)
    roller:part "top":load{ 0, -p / far }
  end
  raceway:part "bottom":fix()
  for _, one in ipairs{ roller, raceway } do one:part(side > 0 and "left" or "right"):fix "x" end
  return roller, raceway
end
local function edge(of, from)
  return of:part("edge", function(x, y, nx, ny) return math.abs(ny) > 0.5 and math.abs(y) < 0.1 * a and math.abs(x) < a and math.abs(x) > from end)
end
local function pair(case, n, p, gap)
  local roller, raceway = half(case, n, p, 1)
  local scene = dotyk.scene{ roller, raceway }
  return { scene = scene, roller = roller, contact = scene:contact{ edge(roller, 0), edge(raceway, 0), gap = gap } }
end

-- 3. What the nodes of a contact say, pressure by its mean.
local function judge(s, contact, p)
  local r = { nodes = s:contact(contact).nodes, solution = s, peak = 0, least = math.huge, norm = 0 }
  local length = 0
  for _, node in ipairs(r.nodes) do
    r.peak = math.max(r.peak, node.pressure / p)
    if math.abs(node.x) <= 0.99 * a then r.least = math.min(r.least, node.pressure / p) end
    r.norm, length = r.norm + node.weight * (math.max(0, node.pressure) / p)^8, length + node.weight
  end
  r.norm = (r.norm / length)^(1 / 8)
  return r
end
local function pressed(case, gap)
  local m = pair(case, cells, p0, gap)
  return judge(dotyk.solve(m.scene), m.contact, p0)
end
-- Greatest difference of a profile found from z over |x| <= reach a, by the drop at the end.
local function difference(profile, z, drop, reach)
  local worst = 0
  for k, x in ipairs(profile.x) do
    if x <= reach * a then worst = math.max(worst, math.abs(profile.z[k] - z(x)) / drop) end
  end
  return worst
end

-- 4. The search. B-splines over the whole edge, the first control point held (all together they would move the roller as
-- a whole), and finer ones over the last tenth, which join smoothly because their first two are held
-- (these go both ways, within a tenth of the range: much farther down the straight roller would overlap the raceway).
-- A variable of its own moves the nodes as end_drop, less towards the far side; options.splines: without it, and q = 8 alone.
local function end_drop(x) return x < a and xlnx(1 - x / a) + x / a or 1 end
local function depth_of(case) return case == "free" and 2 * a or far * a end
local function optimise(case, n, options)
  local p, moves = options.p or p0, {}
  local control, finer = options.control or 8, options.finer or 6
  local m = pair(case, n, p)
  local function move(part, count, held, least, most)
    local lower, upper = {}, {}
    for i = 1, count do lower[i], upper[i] = i > held and least or 0, i > held and most or 0 end
    moves[#moves + 1] = { part = part, control_points = count, direction = { 0, 1 }, lower = lower, upper = upper }
  end
  local most <const> = 0.25 * p / p0
  move(edge(m.roller, 0), control, 1, 0, most)
  if finer > 0 then move(edge(m.roller, 0.9 * a), finer, 2, -most / 10, most / 10) end
  if not options.splines then
    moves[#moves + 1] = { body = m.roller, velocity = function(x, y) return 0, end_drop(x) * (1 - y / depth_of(case)) end, lower = -0.4 * most, upper = most }
  end
  local o, designs, seconds = nil, 0, 0
  for _, q in ipairs(options.splines and { 8 } or { 8, 40 }) do
    local shape, start = dotyk.shape{ scene = m.scene, moves = moves, objective = "peak_pressure", exponent = q }, o and {}
    for i, variable in ipairs(o and o.design.alpha or {}) do start[i] = variable.value end
    o = shape:optimise{ method = options.method or "slsqp", max_designs = 150, start = start }
    designs, seconds = designs + o.cost.designs, seconds + o.cost.seconds
  end
  local r = judge(o.solution, m.contact, p)
  r.designs, r.seconds = designs, seconds
  r.optimum, r.variables, r.profile = o, control - 1 + math.max(0, finer - 2) + (options.splines and 0 or 1), { x = {}, z = {}, weight = {} }
  for k, node in ipairs(o.design:contact(m.contact)) do
    r.profile.x[k], r.profile.z[k], r.profile.weight[k] = node.x.value, node.y.value, node.weight.value
  end
  local z = closed_form(case, p)
  r.drop = r.profile.z[#r.profile.z]
  r.inner, r.whole = 100 * difference(r.profile, z, z(a), 0.9), 100 * difference(r.profile, z, z(a), 1)
  return r
end

-- 5. A shape's amplitude nearest to a profile in the least squares over |x| <= reach a, and what is left.
local function fitted(profile, shape, reach)
  local above, below, rest = 0, 0, 0
  for k, x in ipairs(profile.x) do
    if x <= reach * a then
      local f, z, w = shape(x), profile.z[k], profile.weight[k]
      above, below, rest = above + w * z * f, below + w * f^2, rest + w * z^2
    end
  end
  return above / below, rest - above^2 / below
end
local function fitted_with_end(profile)
  local best = { rest = math.huge }
  for k = 1, 999 do
    local A, rest = fitted(profile, logarithmic(k / 1000), 1)
    if rest < best.rest then best = { A = A, kappa = k / 1000, rest = rest } end
  end
  return best
end

-- 6. Straight, with known profiles, and optimised. The first two say whether the scene and the formulas are right.
print(("roller of length %g mm on a raceway, E = %g MPa, nu = %g, mean pressure %g MPa; %d cells along its half"):format(2 * a, E, nu, p0, cells))
print "                                     drop   pressure by its mean:       from the closed form:        (least: |x| < 0.99a)"
print "case      profile                    [mm]    peak   least  (p^8)^1/8  |x|<0.9a     all   designs  seconds"
local function row(case, name, r, drop)
  local o = r.optimum
  print(("%-9s %-22s %9s %7.3f %7.4f %10.4f%s"):format(case, name, drop and ("%.5f"):format(drop) or "–", r.peak, r.least, r.norm,
    o and ("  %7.2f%% %6.2f%%    %4d   %7.2f"):format(r.inner, r.whole, r.designs, r.seconds) or ""))
end
local function check_straight(case, nodes)
  local x, y, worst = {}, {}, 0
  for _, node in ipairs(nodes) do
    local rest = 1 - node.x / a
    if rest > 2 / cells^2 and rest < 0.05 then x[#x + 1], y[#y + 1] = math.log(rest), math.log(node.pressure) end
    if rest >= 0.02 then worst = math.max(worst, math.abs(node.pressure / p0 * math.pi / 2 * math.sqrt(1 - (node.x / a)^2) - 1)) end
  end
  local power, theory = fit.line(x, y), case == "free" and -0.226 or -0.5
  assert(math.abs(power / theory - 1) < 0.1, "the pressure at a straight roller's end has the wrong power")
  assert(case == "free" or worst < 0.5 / cells, "the straight roller's pressure is not that of the external crack")
  print(("%10sstraight: pressure like r^%.3f towards the end (theory %g)%s"):format("", power, theory,
    case == "free" and "" or (", that of the external crack within %.2f%% over x < 0.98a"):format(100 * worst)))
end
local results = {}
for _, case in ipairs{ "free", "embedded" } do
  local z = closed_form(case, p0)
  local r = { z = z, straight = pressed(case), known = pressed(case, z), best = optimise(case, cells, {}) }
  local A, J = fitted(r.best.profile, logarithmic(1), 0.9), fitted_with_end(r.best.profile)
  function r.lundberg(x) return A * logarithmic(1)(x) end
  function r.with_end(x) return J.A * logarithmic(J.kappa)(x) end
  row(case, "straight", r.straight, 0)
  row(case, "closed form", r.known, z(a))
  r.rounded = pressed(case, r.lundberg)
  row(case, "Lundberg's, fitted", r.rounded)
  row(case, "Lundberg's with an end", pressed(case, r.with_end), r.with_end(a))
  row(case, "optimised", r.best, r.best.drop)
  check_straight(case, r.straight.nodes)
  print(("%10sLundberg's: A = %.5f mm, %.1f%% of the drop from the optimised one over |x| < 0.9a; with an end: A = %.5f mm, kappa = %.3f, %.1f%%"):format("",
    A, 100 * difference(r.best.profile, r.lundberg, z(a), 0.9), J.A, J.kappa, 100 * difference(r.best.profile, r.with_end, z(a), 1)))
  print(("%10s%s"):format("", r.best.optimum))
  assert(math.abs(r.known.peak - 1) < 0.01 and r.known.least > 0.98, "the closed form does not press evenly")
  assert(r.straight.peak > 4 and r.best.peak < 1.03 and r.best.norm < 1.003, "the peak of pressure is not gone")
  results[case] = r
end
local function dip(r) -- of all nodes
  local least = math.huge
  for _, node in ipairs(r.nodes) do least = math.min(least, node.pressure) end
  return least
end
print(("%10sleast pressure of all nodes by the mean: embedded %.3f, free %.3f"):format("", dip(results.embedded.best) / p0, dip(results.free.best) / p0))
assert(results.embedded.best.inner < 0.5 and results.free.best.inner < 0.5, "the optimised profile is not the known one")

-- 7. How much control points, cells and methods matter.
local function table_row(name, case, r)
  local o = r.optimum
  print(("%-9s %-8s %6d %8d  %6.3f %7.4f %10.5f  %7.2f%% %6.2f%%    %4d   %7.2f   %.0e"):format(name, case, r.variables, r.solution.unknowns,
    r.peak, r.least, r.norm, r.inner, r.whole, r.designs, r.seconds, o.gap))
end
if cells >= 32 then
  local n <const> = cells // 2
  print "\nsplines alone: control points of the whole edge and its last tenth, methods; then with the end's variable and q = 40, too"
  print "          case  variables unknowns   peak   least  (p^8)^1/8  |x|<0.9a     all   designs  seconds   gap"
  for _, points in ipairs{ { 4, 0 }, { 8, 0 }, { 12, 0 }, { 8, 6 }, { 12, 8 } } do
    table_row(points[1] .. " + " .. points[2], "embedded", optimise("embedded", n, { control = points[1], finer = points[2], splines = true }))
  end
  for _, method in ipairs{ "slsqp", "slp", "mma", "ccsaq" } do table_row(method, "free", optimise("free", n, { method = method, splines = true })) end
  local spread <const> = {}
  for _, k in ipairs{ cells // 3, n, cells } do
    local r <const> = optimise("free", k, { splines = true })
    table_row(k .. " cells", "free", r)
    spread[#spread + 1] = r.peak
  end
  assert(spread[1] < spread[2] and spread[2] < spread[3], "splines alone leave no singularity")
  print "with the end's variable"
  for _, case in ipairs{ "free", "embedded" } do
    for _, k in ipairs{ cells // 3, n, cells } do
      local r <const> = k == cells and results[case].best or optimise(case, k, {})
      table_row(k .. " cells", case, r)
      assert(r.peak < 1.03, "a peak of pressure is left")
    end
  end
end

-- 8. Figures. One scene of two halves that share nothing but their plane of symmetry: a straight roller on the left, on
-- the right one set up anew with the optimised profile.
local free <const>, embedded <const> = results.free, results.embedded
local function found(x)
  local X, Z = free.best.profile.x, free.best.profile.z
  local k = 2
  while k < #X and X[k] < x do k = k + 1 end
  return Z[k - 1] + (Z[k] - Z[k - 1]) * (x - X[k - 1]) / (X[k] - X[k - 1])
end
local straight, under_straight = half("free", cells, p0, -1)
local shaped, under_shaped = half("free", cells, p0, 1, found)
local both <const> = dotyk.scene{ straight, under_straight, shaped, under_shaped }
both:contact{ edge(straight, 0), edge(under_straight, 0) }
local again <const> = both:contact{ edge(shaped, 0), edge(under_shaped, 0) }
local s <const> = dotyk.solve(both)
-- Nodes within the body lie otherwise than the search moved them.
assert(math.abs(judge(s, again, p0).peak - free.best.peak) < 1e-4, "the optimised roller, set up anew, is another one")
s:render{ file = "images/roller_scene.png", field = "von_mises", units = { length = "mm", stress = "MPa" }, window = { -1.6 * a, -1.3 * a, 1.6 * a, 0.8 * a }, range = { 0, 2000 },
          edges = false, notes = { { at = { -a, 0 }, text = "its edge" } }, title = "Straight on the left, optimised on the right" }

local function pressures(r)
  local x, p = {}, {}
  for k, node in ipairs(r.nodes) do x[k], p[k] = node.x, node.pressure end
  return x, p
end
local function markers(profile) -- that do not cover one another
  local x, z = {}, {}
  for k, at in ipairs(profile.x) do
    if #x == 0 or at - x[#x] >= 0.03 * a then x[#x + 1], z[#z + 1] = at, 1e3 * profile.z[k] end
  end
  return x, z
end
local function sampled(f, to)
  local x, y = {}, {}
  for k = 0, 200 do x[k + 1], y[k + 1] = to * k / 200, 1e3 * f(to * k / 200) end
  return x, y
end
local function series(name, style, x, y) return { name = name, style = style, x = x, y = y, reference = not style } end
local function over_mean(r)
  local x, p = {}, {}
  for k, node in ipairs(r.nodes) do
    if node.x >= 0.9 * a then x[#x + 1], p[#p + 1] = node.x / a, node.pressure / p0 end
  end
  return x, p
end
local alone <const> = optimise("free", cells, { splines = true })
local peak <const> = math.max(table.unpack((select(2, pressures(free.straight)))))
dotyk.chart{ file = "images/roller.png", columns = 3, size = { 2100, 800 }, panels = {
  { title = "Pressure", x = "x [mm]", y = "contact pressure [MPa]", y_break = { 2500, 500 * (0.94 * peak // 500) }, series = {
    series("straight", "line", pressures(free.straight)), series("optimised", "line", pressures(free.best)),
    series("Lundberg's, fitted", "line", pressures(free.rounded)) } },
  { title = "Ends of the shaped ones", x = "x / half length", y = "pressure / mean", x_range = { 0.9, 1.002 }, y_range = { 0.79, 1.21 }, series = {
    series("optimised", "line", over_mean(free.best)),
    series("Lundberg's, fitted", "line", over_mean(free.rounded)), series("splines alone", "line", over_mean(alone)) } },
  { title = "Profile", x = "x [mm]", y = "drop of the profile [µm]", series = {
    series("embedded", "points", markers(embedded.best.profile)), series("free sides", "points", markers(free.best.profile)),
    series("Lundberg's, fitted", "line", sampled(free.lundberg, 0.96 * a)),
    series("closed forms", nil, sampled(embedded.z, a)), series(nil, nil, sampled(free.z, a)) } } } }
print "images/roller.png, images/roller_scene.png"
