-- TR965's open question: is the derivative of the full Newton method, normal and tangential part together, regular?
--
--   ./dotyk scripts/papers/tr965/open_question.lua [STARTS]
--
-- In scaled unknowns the condensed derivative is G = I − S(I − W), S the slopes of the projections, W the compliance
-- of the rows (src/solver/rows/newton.hpp has the proofs). The answer, for B of full rank:
--   given friction, bodies held: always regular, on all pieces, in the plane and in space;
--   given friction, a free body: singular exactly where the pieces leave it a rigid motion;
--   Coulomb friction, bodies held: regular below a coefficient that depends on W alone; in the plane, beyond it,
--   for all but finitely many coefficients (for one node all but W_nn/|W_nt|), as on each of the finitely many
--   pieces det G is a polynomial in the coefficient, and not 0 without friction.
-- Seen here: Newton's method from STARTS random multipliers, from a tenth to a hundred times the size of the
-- solution's, on each problem, and on a family with growing coefficient of friction; the least singular value of
-- every step's derivative; those below 1e-12 are 0 but for rounding. Draws images/open_question.png (their
-- distribution) and images/open_question_mu.png.

local starts <const> = tonumber(arg[1]) or 1000
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }
local tresca <const>, coulomb <const> = dotyk.friction.tresca, dotyk.friction.coulomb

-- 1. The problems. Two blocks, the upper one free or held by springs; a cube on a paraboloid.
local function blocks(law, held)
  local function half(name, y)
    return dotyk.body{ name = name, material = material,
      mesh = dotyk.mesh.rectangle{ from = {0, y}, to = {2, y + 1}, cells = {8, 4} } }
  end
  local lower, upper = half("lower", 0), half("upper", 1)
  lower:part"bottom":fix()
  upper:part"top":load{ 2, -10 }
  if held then upper:part"top":spring{ x = 10, y = 10 } end
  local scene = dotyk.scene{ lower, upper }
  scene:contact{ upper:part"bottom", lower:part"top", friction = law }
  return scene
end

local function cube(law)
  local body = dotyk.body{ name = "cube", material = material,
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {4, 4, 4} } }
  body:part"bottom":fix()
  local scene = dotyk.scene{ body }
  scene:contact{ body:part"top", friction = law, rigid = dotyk.rigid.gap{ normal = {0, 0, 1},
    gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 + 0.2 * x - 0.15 end } }
  return scene
end

-- 2. All starts on one problem.
local function quantile(sorted, q) return sorted[math.max(1, math.ceil(q * #sorted))] end

local function run(scene)
  local r = { failed = 0, guarded = 0, steps = 0, singular = 0, iterations = 0, most = 0, values = {}, energies = {} }
  for seed = 1, starts do
    local s = dotyk.solver.newton{ seed = seed, watch = true }:solve(scene)
    if s.converged then r.energies[("%.7g"):format(s.energy)] = true else r.failed = r.failed + 1 end
    if s.reason:find "springs" or s.reason:find "fixed point" then r.guarded = r.guarded + 1 end
    r.iterations, r.most = r.iterations + s.iterations, math.max(r.most, s.iterations)
    for _, step in ipairs(s.history) do
      r.steps = r.steps + 1
      if step.singular_value < 1e-12 then r.singular = r.singular + 1 end
      r.values[r.steps] = step.singular_value
    end
  end
  table.sort(r.values)
  r.found = 0
  for _ in pairs(r.energies) do r.found = r.found + 1 end
  return r
end

local function row(name, r)
  print(("%-30s %6d  %9.2e %9.2e %9.2e  %8d  %7d  %6d  %5.1f %4d  %5d"):format(name, r.steps, r.values[1],
    quantile(r.values, 0.01), quantile(r.values, 0.5), r.singular, r.guarded, r.failed, r.iterations / starts, r.most, r.found))
end
local head <const> = "                                steps      least        1%    median  singular  guarded  failed" ..
  "  mean most  found"

-- 3. The problems of the report, and Coulomb's.
print(starts .. " random starts on each problem; least singular value of the scaled derivative, step by step")
print(head)
local cases <const> = {
  { "plane, given, held", blocks(tresca(2.5), true) }, { "plane, given, free", blocks(tresca(2.5), false) },
  { "plane, Coulomb 0.3, held", blocks(coulomb(0.3), true) }, { "plane, Coulomb 0.3, free", blocks(coulomb(0.3), false) },
  { "space, given", cube(tresca(10)) }, { "space, Coulomb 0.3", cube(coulomb(0.3)) } }
local series, failed = {}, 0
for _, case in ipairs(cases) do
  local name <const>, scene <const> = table.unpack(case)
  local r = run(scene)
  row(name, r)
  failed = failed + r.failed
  local x, y = {}, {} -- the distribution, at 400 places
  for k = 1, 400 do x[k], y[k] = math.max(1e-18, quantile(r.values, k / 400)), k / 4 end
  series[#series + 1] = { name = name:find "given" and (name:gsub(", given", "")) or nil, x = x, y = y, style = "line", twin = name:find "given" == nil }
  if name:find "given" and not name:find "free" then assert(r.singular == 0) end
end

-- With everything stuck G = W: the least eigenvalue m of W, and the proof's lower bound is m/(m + ‖I − W‖).
local stuck = dotyk.solver.newton{ watch = true, seed = 1 }:solve(blocks(tresca(1e6), true))
local m = stuck.history[#stuck.history].singular_value
print(("in the plane, everything stuck, held: %.3e, the least eigenvalue of W"):format(m))
series[2], series[3] = series[3], series[2] -- the twins
dotyk.chart{ file = "images/open_question.png", title = "Given friction; dashed: Coulomb, μ = 0.3", log = "x", series = series,
             x = "least singular value of the derivative", y = "steps not above it [%]", x_range = { 2e-3, 2 }, y_range = { -3, 103 },
             notes = { { x = 3e-3, y = 55, text = "below: zero by rounding" } } }

-- 4. A growing coefficient of friction.
print("\nplane, Coulomb, held" .. (" "):rep(12) .. head:sub(33))
local x, middle, low, high, smallest = {}, {}, {}, {}, {}
for _, mu in ipairs{ 0.1, 0.2, 0.4, 0.7, 1, 1.5, 2, 3, 4, 5, 6, 7, 8, 10, 15, 30 } do
  local r = run(blocks(coulomb(mu), true))
  row(("mu = %g"):format(mu), r)
  failed = failed + r.failed
  x[#x + 1], middle[#x + 1], smallest[#x + 1] = mu, quantile(r.values, 0.5), r.values[1]
  low[#x], high[#x] = quantile(r.values, 0.01), quantile(r.values, 0.99)
end
dotyk.chart{ file = "images/open_question_mu.png", log = "xy", x = "coefficient of friction",
  y = "least singular value", y_range = { 1e-6, 1 },
  series = { { name = "median, 1% to 99%", x = x, y = middle, low = low, high = high },
             { name = "least of all steps", x = x, y = smallest },
             { name = "everything stuck", x = { x[1], x[#x] }, y = { m, m }, style = "line", reference = true } } }

print(("\n%d of all starts did not converge."):format(failed))
print "With given friction and held bodies no derivative was singular; with a free body those were on which"
print "nothing stops it (springs held it meanwhile). Coulomb friction comes nearer to singular as the coefficient"
print "grows, and never met a singular derivative of a held body."
print "images/open_question.png, images/open_question_mu.png"
assert(failed == 0)
