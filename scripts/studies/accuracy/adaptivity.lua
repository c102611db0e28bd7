-- How far to trust a solution, and meshes refined where it errs.
--
--   ./dotyk scripts/studies/accuracy/adaptivity.lua [UNKNOWNS]
--
-- 1. Effectivity, the error estimate over the error in the energy norm, where that is known: a smooth
--    closed form, and energies of a reference mesh at corners, in bending and under punches.
-- 2. A punch with sharp edges: error against unknowns and against seconds, uniform and adaptive.
-- 3. Hertz's pressure: what a given accuracy costs, uniform and adaptive.
-- Draws images/adaptivity_{unknowns,seconds,punch,edge,solid,hertz,pressure}.png. Units: N, mm.

local most <const> = tonumber(arg[1]) or 40000 -- unknowns of the finest meshes
local E <const>, nu <const> = 1000, 0.3
local material <const> = dotyk.material{ E = E, nu = nu }
local mu <const>, lambda <const> = E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))
local pi <const>, sin <const>, cos <const> = math.pi, math.sin, math.cos
local fit <const> = include "../../lib/least_squares.lua"

-- 1. The scenes of the table: each takes a mesh and returns a scene, its dimension from the mesh.
local function body(mesh, force)
  return dotyk.body{ mesh = mesh, material = material, force = force }
end

-- u_i = A_i Π sin πx_k on the unit square or cube, held all round; J = -‖u‖²/2 by hand.
local amplitude <const> = { 0.01, -0.007, 0.004 }
local function smooth(mesh)
  local d <const> = mesh.dimension
  local b = body(mesh, function(...)
    local x <const>, f <const> = { ... }, {}
    for i = 1, d do
      local own = lambda + mu + d * mu
      local sum = amplitude[i] * own * sin(pi * x[1]) * sin(pi * x[2]) * (d == 3 and sin(pi * x[3]) or 1)
      for j = 1, d do
        local rest = d == 3 and j ~= i and sin(pi * x[6 - i - j]) or 1
        if j ~= i then sum = sum - (lambda + mu) * amplitude[j] * cos(pi * x[i]) * cos(pi * x[j]) * rest end
      end
      f[i] = pi^2 * sum
    end
    return table.unpack(f)
  end)
  for _, name in ipairs(mesh.parts) do b:part(name):fix() end
  local square = 0
  for i = 1, d do square = square + amplitude[i]^2 * pi^2 * (lambda + mu + d * mu) / 2^d end
  return dotyk.scene{ b }, -square / 2
end

local function vector(d, axis, value)
  local v = { 0, 0, d == 3 and 0 or nil }
  v[axis == "last" and d or 1] = value
  return v
end

local function cantilever(mesh)
  local b = body(mesh)
  b:part"left":fix()
  b:part"right":load(vector(mesh.dimension, "last", -1))
  return dotyk.scene{ b }
end

local function corner(mesh)
  local b = body(mesh)
  b:part"left":fix()
  b:part"bottom":load(vector(mesh.dimension, "first", 1))
  return dotyk.scene{ b }
end

-- The rigid flat punch |x| < 1/2 (and |y| < 1/2) ends where facets of the first mesh end.
local function punch(mesh)
  local d <const>, b <const> = mesh.dimension, body(mesh)
  b:part"bottom":fix()
  local scene = dotyk.scene{ b }
  local under = b:part("under", function(...)
    local x <const> = { ... }
    return x[2 * d] > 0.9 and math.abs(x[1]) < 0.5 and (d == 2 or math.abs(x[2]) < 0.5)
  end)
  return scene, nil, scene:contact{ under, rigid = dotyk.rigid.gap{ normal = vector(d, "last", 1), gap = -0.02 } }
end

-- A rigid roof: its gap is linear on every mesh with nodes at x = 0, so energies can be compared.
local function roof(mesh)
  local d <const>, b <const> = mesh.dimension, body(mesh)
  b:part"bottom":fix()
  local scene = dotyk.scene{ b }
  return scene, nil, scene:contact{ b:part"top", friction = dotyk.friction.tresca(2), rigid = dotyk.rigid.gap{
    normal = vector(d, "last", 1), gap = function(x) return 0.2 * math.abs(x) - 0.05 end } }
end

local function rectangle(from, to, cells) return dotyk.mesh.rectangle{ from = from, to = to, cells = cells } end
local function box(from, to, cells) return dotyk.mesh.box{ from = from, to = to, cells = cells } end
local slab <const> = rectangle({-1, -1}, {1, 0}, {8, 4})
local thick <const> = box({-1, -1, -1}, {1, 1, 0}, {4, 4, 2})
local function not_quarter(x, y, z) return not (x > 0 and (z or y) > 0) end

local cases <const> = {
  { "smooth, 2-D", smooth, rectangle({0, 0}, {1, 1}, {4, 4}) },
  { "smooth, 3-D", smooth, box({0, 0, 0}, {1, 1, 1}, {3, 3, 3}) },
  { "cantilever, 2-D", cantilever, rectangle({0, 0}, {4, 1}, {8, 2}) },
  { "cantilever, 3-D", cantilever, box({0, 0, 0}, {4, 1, 1}, {8, 2, 2}) },
  { "re-entrant corner, 2-D", corner, rectangle({-1, -1}, {1, 1}, {4, 4}):keep(not_quarter) },
  { "re-entrant corner, 3-D", corner, box({-1, 0, -1}, {1, 1, 1}, {4, 2, 4}):keep(not_quarter) },
  { "sharp punch, 2-D", punch, slab },
  { "sharp punch, 3-D", punch, thick },
  { "roof with given friction, 2-D", roof, slab },
  { "roof with given friction, 3-D", roof, thick } }

local function energy(s) return s.energy + s.friction_energy end

-- ‖u − u_h‖² = 2(J(u_h) − J(u)) where u_h is admissible, as in all of these.
print "effectivity of the error estimate (error from energies; reference: closed form, or the finest adaptive mesh, extrapolated)"
print "                                            unknowns  error/norm  estimate/norm  effectivity"
for _, case in ipairs(cases) do
  local name <const>, make <const>, mesh <const> = table.unpack(case)
  local d <const> = mesh.dimension
  local exact, rows, energies = nil, {}, {}
  local function note(how)
    return function(_, entry, s, closed)
      exact = closed or exact
      energies[#energies + 1] = { energy(s), entry.unknowns }
      rows[#rows + 1] = { how = how, J = energy(s), unknowns = entry.unknowns, estimate = entry.absolute, relative = entry.estimate }
      return true
    end
  end
  local limit <const> = d == 2 and most or most // 2
  local _, coarse = dotyk.adapt{ scene = make, mesh = mesh, uniform = true, tol = 1e-9, max_unknowns = most // 4, on_round = note "uniform" }
  local uniform_rounds <const> = #coarse
  dotyk.adapt{ scene = make, mesh = mesh, tol = 1e-9, max_unknowns = limit, on_round = note "adaptive" }
  if not exact then -- J(u_h) − J(u) ~ N^(-2/d) on adapted meshes
    local a <const>, b <const> = energies[#energies - 3], energies[#energies]
    exact = b[1] - (a[1] - b[1]) / ((b[2] / a[2])^(2 / d) - 1)
  end
  local shown <const>, low, high = { [1] = true, [uniform_rounds] = true, [(uniform_rounds + #rows + 1) // 2] = true }, math.huge, 0
  for k = 1, #rows - 1 do -- the last is next to what the limit comes from
    local r <const> = rows[k]
    local error <const> = math.sqrt(2 * (r.J - exact))
    local norm <const> = r.estimate / r.relative
    local effectivity <const> = r.estimate / error
    if shown[k] then print(("%-32s %-9s %9d %11.4f %14.4f %12.3f"):format(name, r.how, r.unknowns, error / norm, r.estimate / norm, effectivity)) end
    low, high = math.min(low, effectivity), math.max(high, effectivity)
  end
  print(("%-32s on %d meshes between %.2f and %.2f"):format("", #rows - 1, low, high))
  assert(low > 0.5 and high < 3, name .. ": the effectivity is not between 0.5 and 3")
end

-- 2. The sharp punch in the plane: orders.
local runs, adapted = {}, nil
local lowest
for _, uniform in ipairs{ true, false } do
  local run = { name = uniform and "uniform" or "adaptive", N = {}, J = {}, seconds = {} }
  runs[#runs + 1] = run
  adapted = dotyk.adapt{ scene = punch, mesh = slab, uniform = uniform, tol = 1e-9, max_unknowns = 2 * most, on_round = function(_, entry, s)
    run.N[#run.N + 1], run.J[#run.J + 1], run.seconds[#run.seconds + 1] = entry.unknowns, energy(s), entry.seconds
  end }
end
do -- J of the limit from the adaptive run
  local r <const> = runs[2]
  local n <const> = #r.N
  lowest = r.J[n] - (r.J[n - 4] - r.J[n]) / (r.N[n] / r.N[n - 4] - 1)
end
print "\nsharp punch in the plane: relative error in the energy norm"
local least <const> = math.sqrt(2 * math.abs(lowest))
for _, run in ipairs(runs) do
  run.error, run.h = {}, {}
  for k, J in ipairs(run.J) do
    run.error[k], run.h[k] = math.sqrt(2 * (J - lowest)) / least, 1 / run.N[k]
  end
  local from <const> = #run.N // 2 -- the tail but for the last, from which the limit comes
  local order <const> = fit.order({ table.unpack(run.h, from, #run.h - 1) }, { table.unpack(run.error, from, #run.error - 1) })
  print(("%-9s %d rounds, %d unknowns, error %.5f, %.2f s; error ~ N^-%.3f"):format(
    run.name, #run.N, run.N[#run.N], run.error[#run.error], run.seconds[#run.seconds], order))
  run.order = order
end
assert(math.abs(runs[2].order - 0.5) < 0.05, "the order is not that of smooth solutions")
for _, by in ipairs{ { "unknowns", "N", "displacement unknowns N", { -0.5, -0.25 } }, { "seconds", "seconds", "seconds, all rounds so far" } } do
  local series = {}
  for _, run in ipairs(runs) do series[#series + 1] = { name = run.name, x = run[by[2]], y = run.error } end
  dotyk.chart{ file = "images/adaptivity_" .. by[1] .. ".png", title = "Punch with sharp edges", x = by[3],
               y = "relative error in the energy norm", log = "xy", slopes = by[4], series = series }
end
local units <const> = { length = "mm", stress = "MPa" }
local shown <const> = dotyk.adapt{ scene = punch, mesh = slab, tol = 0.06 }
shown:render{ file = "images/adaptivity_punch.png", field = "none", units = units, edges = true, pressure = "none", deform = 1,
              title = "Mesh for an error of 6 %" }
shown:render{ file = "images/adaptivity_edge.png", field = "von_mises", units = units, edges = true, window = {0.42, -0.09, 0.58, 0.01},
              title = "The punch's right edge" }

local solid <const> = dotyk.adapt{ scene = punch, mesh = thick, tol = 1e-9, max_unknowns = most // 2 }
solid:render{ file = "images/adaptivity_solid.png", field = "von_mises", units = units, edges = false, deform = 1, width = 178,
              view = {-0.6, -1, 0.9}, title = "A square punch with sharp edges" }

-- 3. Hertz: a rigid parabola of radius R, on half of a block that is large beside the contact.
local R <const>, target <const> = 1, 0.02
local function hertz(mesh)
  local b = body(mesh)
  b:part"bottom":slide()
  b:part"left":slide()
  local scene = dotyk.scene{ b }
  return scene, scene:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / (2 * R) - 0.006 end } }
end
-- The pressure's error in L2, beside Hertz for the force found.
local function pressure_error(s, contact)
  local c = s:contact(contact)
  local force <const> = -2 * c.force[2] -- of both halves
  local a <const> = math.sqrt(4 * force * R * (1 - nu^2) / (pi * E))
  local p0 <const> = 2 * force / (pi * a)
  local square = 0
  for _, node in ipairs(c.nodes) do
    square = square + node.weight * (node.pressure - p0 * math.sqrt(math.max(0, 1 - (node.x / a)^2)))^2
  end
  return math.sqrt(square / (2 / 3 * a * p0^2)), a, p0, c
end

print(("\nHertz: pressure to %g %% in L2"):format(100 * target))
local cost, best = {}, nil
local half <const> = rectangle({0, -1}, {1, 0}, {8, 8})
for _, uniform in ipairs{ true, false } do
  local _, history = dotyk.adapt{ scene = hertz, mesh = half, uniform = uniform, tol = 1e-9, max_unknowns = 15 * most,
                                  on_round = function(_, entry, s, contact)
    entry.pressure, entry.a, entry.p0, entry.contact = pressure_error(s, contact)
    entry.solve = s.time.total
    best = { s, entry }
    return entry.pressure > target
  end }
  local last <const> = history[#history]
  cost[#cost + 1] = last
  print(("%-9s %2d rounds, %7d unknowns, pressure error %.4f, half-width %.4f, %.3f s in all, the last solve %.3f s%s"):format(
    uniform and "uniform" or "adaptive", #history, last.unknowns, last.pressure, last.a, last.seconds, last.solve,
    last.pressure > target and " (not reached)" or ""))
end
print(("adaptive takes 1/%.0f of the unknowns and 1/%.1f of the time"):format(cost[1].unknowns / cost[2].unknowns, cost[1].seconds / cost[2].seconds))
assert(cost[2].pressure <= target and cost[2].unknowns <= cost[1].unknowns / 5, "adaptive refinement should need at most a fifth of the unknowns")
assert(cost[2].seconds < cost[1].seconds, "adaptive refinement should need less time, all rounds counted")

local s <const>, last <const> = table.unpack(best)
local reach <const> = 1.6 * last.a
s:render{ file = "images/adaptivity_hertz.png", field = "von_mises", units = units, edges = true, window = {0, -1.6 * reach, 2 * reach, 0.2 * reach} }
local x, p, hx, hp = {}, {}, {}, {}
for _, node in ipairs(last.contact.nodes) do
  if node.x < reach then x[#x + 1], p[#p + 1] = node.x, node.pressure end
end
for i = 0, 200 do
  hx[#hx + 1], hp[#hp + 1] = last.a * i / 200, last.p0 * math.sqrt(1 - (i / 200)^2)
end
dotyk.chart{ file = "images/adaptivity_pressure.png", x = "x [mm]", y = "contact pressure [MPa]",
             series = { { name = "nodes of the adapted mesh", x = x, y = p, style = "points" }, { name = "Hertz", x = hx, y = hp, reference = true } } }
print "images/adaptivity_{unknowns,seconds,punch,edge,solid,hertz,pressure}.png"
