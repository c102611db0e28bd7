-- dotyk.solver.multigrid on meshes that refine others: the state of the default method, iterations that do not grow with the mesh, few steps from the
-- solution on the coarser mesh.
local check <const> = require "check"

local S <const> = dotyk.solver
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }
local function body(name, mesh, force) return dotyk.body{ name = name, material = material, force = force, mesh = mesh } end
local function box(from, to, cells, element) return dotyk.mesh.box{ from = from, to = to, cells = cells, element = element } end

-- S3 and S3C of the benchmarks.
local function cube(n, friction, element, nu)
  local b <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = nu or 0.3 }, mesh = box({0, 0, 0}, {1, 1, 1}, {n, n, n}, element) }
  b:part"bottom":fix()
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part"top", friction = friction, interference = true,
    rigid = dotyk.rigid.gap{ normal = {0, 0, 1}, gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.02 end } }
  return scene
end
do
  local there <const>, said <const> = pcall(S.multigrid().solve, S.multigrid(), cube(2))
  if not there then
    check.that(said:find("libpetsc-real-dev", 1, true), said)
    print "PETSc is absent: multigrid was not tried"
    return
  end
end

local scenes = {}
function scenes.cube() return cube(8) end
function scenes.cube_with_friction() return cube(8, dotyk.friction.coulomb(0.3)) end
-- An angle section of six-sided cells, refined; a third of it is held, half of a node's components on its side.
function scenes.refined_angle()
  local m <const> = box({0, 0, 0}, {2, 2, 1}, {3, 3, 2}, "Q1"):keep(function(x, y) return x < 0.7 or y < 0.7 end, "inside")
  local b <const> = body("b", m:refined(2))
  b:part("foot", function(x, y) return y < 1e-9 and x > 1 end):fix()
  b:part"left":slide()
  b:part"top":load{ 0, 1, -3 }
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part"right", rigid = dotyk.rigid.plane{ point = {2.001, 0, 0}, normal = {-1, 0, 0} } }
  scene:contact{ b:part"back", rigid = dotyk.rigid.plane{ point = {0, 2.0005, 0}, normal = {0, -1, 0} }, friction = dotyk.friction.coulomb(0.2) }
  return scene
end
-- Two bodies that do not match, of unequal hierarchies; the upper one is held by contact and slides alone.
local function two(cells, upper_times)
  local a <const> = body("a", box({0, 0, 0}, {1, 1, 0.5}, cells):refined(1))
  local b <const> = body("b", box({0.1, 0.1, 0.5}, {0.9, 0.9, 1}, {3, 3, 2}):refined(upper_times), {0, 0, -4})
  a:part"bottom":fix()
  b:part"left":slide()
  b:part"front":slide()
  local scene <const> = dotyk.scene{ a, b }
  scene:contact{ b:part"bottom", a:part"top" }
  return scene
end
function scenes.two_that_do_not_match() return two({4, 4, 2}, 1) end
function scenes.the_smaller_without_levels() return two({6, 6, 4}, 0) end
function scenes.glued_second_order()
  local a <const>, b <const> = body("a", box({0, 0, 0}, {1, 1, 0.5}, {4, 4, 2}, "P2")), body("b", box({0, 0, 0.5}, {1, 1, 1}, {3, 3, 2}, "Q2"))
  a:part"bottom":fix()
  b:part"top":load{ 1, 0, -2 }
  local scene <const> = dotyk.scene{ a, b }
  scene:glue{ b:part"bottom", a:part"top" }
  return scene
end
function scenes.turned_slide()
  local m <const> = box({0, 0, 0}, {1, 1, 1}, {6, 6, 6})
  m:transform(function(x, y, z) return 0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z end)
  local b <const> = body("b", m)
  b:part"bottom":fix "z"
  b:part"left":slide()
  b:part"front":slide()
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part"top", rigid = dotyk.rigid.ball{ center = {0, 0.5, 1.48}, radius = 0.5 }, interference = true }
  return scene
end
function scenes.plane()
  local b <const> = body("b", dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {64, 32} })
  b:part"bottom":displace{ x = 0.03, y = 0.02 }
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 end }, interference = true, friction = dotyk.friction.coulomb(0.4) }
  return scene
end
function scenes.curved_disc()
  local b <const> = body("b", dotyk.mesh.disc{ center = {0, 1}, radius = 1, cells = 4, element = "P2" }:refined(2), {0, -5})
  b:part("axis", function(x, y, nx) return y > 1 end):fix "x"
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part("below", function(x, y) return y < 0.5 end), rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
  return scene
end

for name, make in pairs(scenes) do
  local reference <const> = dotyk.solve(make())
  check.that(reference.converged, name .. ": " .. reference.reason)
  for _, levels in ipairs{ "meshes", "aggregates" } do
    for _, nested in ipairs{ true, false } do
      local s <const> = S.multigrid{ levels = levels, nested = nested }:solve(make())
      local what <const> = ("%s, levels of %s, %s"):format(name, levels, nested and "nested" or "from rest")
      check.that(s.converged and s.method == "multigrid", what .. ": " .. s.reason)
      check.that(math.abs(s.energy / reference.energy - 1) < 1e-9, ("%s: energy %.15g, not %.15g"):format(what, s.energy, reference.energy))
      check.that(s.residual.equilibrium < 1e-9 and s.residual.penetration < 1e-9, what)
      check.that(s.multigrid.levels >= 1 and s.multigrid.newton == s.iterations and s.multigrid.cg > 0, what)
      check.that((s.ordering:find("geometric", 1, true) ~= nil) == (levels == "meshes" and s.multigrid.levels > 1), what .. ": " .. s.ordering)
    end
  end
end

-- Iterations: those of a mesh of 24³ cells are hardly more than of 12³; nested steps are few.
local before
for _, n in ipairs{ 12, 24 } do
  local s <const>, cold <const> = S.multigrid{}:solve(cube(n)), S.multigrid{ nested = false }:solve(cube(n))
  check.that(math.abs(s.energy / cold.energy - 1) < 1e-10, "cold")
  check.that(s.multigrid.newton <= 3, ("%d steps"):format(s.multigrid.newton))
  check.that(s.reason:find("begun on %d coarser mesh"), s.reason)
  check.that(not before or s.multigrid.cg <= 1.3 * before, ("%s iterations, before %s"):format(s.multigrid.cg, before))
  before = s.multigrid.cg
end

-- A body without coarser meshes is so large a part that the coarser problem has none that is worth a level, though the mesh after it is known: it is solved
-- with aggregates.
do
  local function scene()
    local lower <const>, upper <const> = body("lower", box({0, 0, 0}, {1, 1, 1}, {16, 16, 16})), body("upper", box({0, 0, 1}, {1, 1, 1.8}, {11, 11, 8}))
    lower:part"bottom":fix()
    upper:part"top":displace{ x = 0, y = 0, z = -0.01 }
    local all <const> = dotyk.scene{ lower, upper }
    all:contact{ upper:part"bottom", lower:part"top" }
    return all
  end
  local nested <const>, cold <const> = S.multigrid{}:solve(scene()), S.multigrid{ nested = false }:solve(scene())
  check.that(nested.reason:find("begun on 1 coarser mesh", 1, true), nested.reason)
  check.that(math.abs(nested.energy / cold.energy - 1) < 1e-10, ("energy %.15g, not %.15g"):format(nested.energy, cold.energy))
end

-- Where contact, stick and slip end is put right on the finer mesh before the first step: with friction, too, steps are few.
do
  local scenes <const> = include "../../scripts/lib/scale_scenes.lua"
  local s <const>, one <const> = S.multigrid{}:solve(scenes.cube(24, { friction = 0.3 })), S.multigrid{}:solve(scenes.cube(12, {}))
  check.that(s.converged and s.multigrid.newton <= 3, s.multigrid.newton)
  local cut <const> = S.multigrid{}:solve(scenes.cube(16, { friction = 0.3, refine = 2 }))
  check.that(cut.converged and cut.multigrid.newton <= 3, cut.multigrid.newton) -- four after ten sweeps
  check.that(one.converged and one.multigrid.newton == 1, one.multigrid.newton) -- two, not relaxed; of 24³ cells either way one
  -- Beside a body far stiffer, where the row's stiffness is the softer body's.
  for _, contrast in ipairs{ 1000, 1e5 } do
    local apart <const> = S.multigrid{}:solve(scenes.blocks(16, { friction = 1.2, contrast = contrast }))
    check.that(apart.converged and apart.iterations <= 12, apart.reason)
  end
end

-- Given friction begins on coarser meshes as well.
do
  local scene <const> = cube(24, dotyk.friction.tresca(2))
  local s <const>, cold <const> = S.multigrid{}:solve(scene), S.multigrid{ nested = false }:solve(scene)
  check.that(s.converged and s.iterations < cold.iterations, ("%d steps, %d at rest"):format(s.iterations, cold.iterations))
  check.near(s.energy, cold.energy, 1e-9 * math.abs(cold.energy))
end

-- Coarser problems that cannot say where to begin: no row at a node of theirs; oblique slides that are all turned away; springs; a beam.
do
  local function plane(cells, to)
    return body("b", dotyk.mesh.rectangle{ from = {0, 0}, to = to, cells = cells })
  end
  local one <const> = plane({64, 64}, {1, 1})
  one:part"left":fix()
  local corner <const> = dotyk.scene{ one }
  corner:contact{ one:part("first", function(x, y) return y > 1 - 1e-9 and x < 1 / 64 end), rigid = dotyk.rigid.plane{ point = {0, 1}, normal = {0, -1} } }
  one:part"right":load{ 0, 5 }
  local turned <const> = dotyk.mesh.rectangle{ from = {0, 0}, to = {20, 1}, cells = {400, 14} }
  turned:transform(function(x, y) return 0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y end)
  local slope <const> = body("b", turned)
  slope:part"bottom":slide()
  slope:part"left":fix()
  slope:part"top":load{ 1, -1 }
  local bed <const> = plane({128, 64}, {2, 1})
  bed:part"bottom":support{ normal = dotyk.law.one_sided_elastic(100) }
  bed:part"left":fix "x"
  bed:part("middle", function(x, y) return y > 1 - 1e-9 and math.abs(x - 1) < 0.2 end):load{ 0, -3 }
  for name, scene in pairs{ corner = corner, slope = dotyk.scene{ slope }, bed = dotyk.scene{ bed } } do
    local s <const>, d <const> = S.multigrid{}:solve(scene), dotyk.solve(scene)
    check.that(s.converged and math.abs(s.energy / d.energy - 1) < 1e-9, ("%s: %s, energy %.12g, not %.12g"):format(name, s.reason, s.energy, d.energy))
  end
  local beam <const> = dotyk.beam{ length = 1, EJ = 1, cells = 8, load = -1, left = { deflection = dotyk.law.signorini() }, right = { deflection = dotyk.law.signorini() } }
  check.that(math.abs(S.multigrid{}:solve(beam):deflection(0.5) + 5 / 384) < 1e-6, "beam")
  -- Only the iterations on the mesh itself are told; one that says no ends it with its state.
  local told = 0
  local s <const> = S.multigrid{ on_iteration = function() told = told + 1 end }:solve(cube(12))
  check.that(told == #s.history, told)
  local stopped <const> = S.multigrid{ on_iteration = function() return false end }:solve(cube(12, dotyk.friction.coulomb(0.3)))
  check.that(not stopped.converged and stopped.reason:find("interrupted", 1, true), stopped.reason)
end
-- Below a coarsest mesh that is large, aggregates: 66 is twice 33.
do
  local b <const> = body("b", dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {66, 66} })
  b:part"bottom":fix()
  b:part"top":load{ 0, -1 }
  local s <const> = S.multigrid{}:solve(dotyk.scene{ b })
  check.that(s.converged and s.multigrid.levels > 2 and s.multigrid.cg < 40, ("%d levels, %d iterations"):format(s.multigrid.levels, s.multigrid.cg))
end

-- Rows of elements of order 2 are means of displacements: the unknowns that share them are solved exactly, or iterations are seven times as many.
do
  local s <const> = S.multigrid{ nested = false }:solve(cube(6, nil, "P2"))
  check.that(s.converged and s.multigrid.cg < 40 * s.multigrid.newton, s.multigrid.cg .. " iterations with order 2")
end

-- Great contrasts with friction, the load by a moved support: its forces are no measure of those of the contact, points that hardly slip are no springs
-- without bound, and points that slip against their force stick first. Newton's method with factors takes six steps.
do
  local scenes <const> = include "../../scripts/lib/scale_scenes.lua"
  for _, contrast in ipairs{ 10, 100 } do
    local by <const> = { friction = 0.3, contrast = contrast }
    local s <const>, direct <const> = S.multigrid{}:solve(scenes.blocks(16, by)), S.newton{}:solve(scenes.blocks(16, by))
    check.that(s.converged and s.iterations <= 9, s.reason)
    check.near(s.energy, direct.energy, 1e-9 * direct.energy)
  end
end

-- The default method gives multigrid up where its rate is slow, and says so.
do
  local function solved(nu) return dotyk.solve(cube(20, nil, "P1", nu)) end
  local fast <const>, slow <const> = solved(0.3), solved(0.4999)
  check.that(fast.converged and slow.converged, slow.reason)
  check.that(fast.method == "multigrid", fast.method)
  check.that(slow.method ~= "multigrid" and slow.reason:find("no solution of a linear system within the iterations allowed", 1, true), slow.reason)
end

-- A refusal is said once, and no other method is tried.
do
  local b <const> = body("lifted", box({0, 0, 0}, {1, 1, 1}, {20, 20, 20}))
  b:part"top":load{ 0, 0, 1 }
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0, 0}, normal = {0, 0, 1} } }
  check.that(scene:plan():find("method: multigrid on all", 1, true), scene:plan())
  local solved <const>, said <const> = pcall(dotyk.solve, scene)
  check.that(not solved and select(2, said:gsub("nothing stops", "")) == 1 and not said:find("before", 1, true), said)
end

-- What a mesh forgets, and what it does not.
local m <const> = box({0, 0, 0}, {1, 1, 1}, {2, 2, 2})
local levels <const> = function(mesh)
  local b <const> = body("b", mesh)
  b:part"bottom":fix()
  b:part"top":load{ 0, 0, -1 }
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part"left", rigid = dotyk.rigid.plane{ point = {-0.1, 0, 0}, normal = {1, 0, 0} } }
  return S.multigrid{}:solve(scene).multigrid.levels
end
check.that(levels(m) == 2 and levels(m:refined(2)) == 4, "levels")
local turned <const> = m:refined(2)
turned:transform(function(x, y, z) return x + 0.1 * z^2, y, z end)
check.that(levels(turned) == 4, "levels of a mesh that was moved")

-- New nodes of a curved boundary are put onto it, and the levels stay: of 128 chords none is farther than 3.1e-4 from the circle, of the first 16 up to 0.02.
local round = dotyk.mesh.disc{ center = {0, 0}, radius = 1, cells = 4 }
for _ = 1, 3 do round = round:refined():transform(function(x, y) local r <const> = math.sqrt(x^2 + y^2) return x / r, y / r end, "boundary") end
local disc <const> = body("disc", round)
disc:part("below", function(_, y) return y < -0.5 end):fix()
disc:part("above", function(_, y) return y > 0.5 end):load{ 0, -1 }
local pressed <const> = S.multigrid{}:solve(dotyk.scene{ disc })
check.that(pressed.converged and pressed.multigrid.levels == 4, "levels of a disc")
check.near(pressed.energy, dotyk.solve(dotyk.scene{ disc }).energy, 1e-9 * math.abs(pressed.energy))
for k = 0, 255 do pressed:displacement(disc, 0.9996 * math.cos(k * math.pi / 128), 0.9996 * math.sin(k * math.pi / 128)) end
check.error(function() round:transform(function(x, y) return x, y end, "rim") end, "boundary")

-- A load that ends takes all forces with it.
do
  local b <const> = body("pressed", box({-2, -1, 0}, {2, 1, 1}, {8, 4, 2}, "Q1"))
  b:part"top":load({ 0, 0, -10 }, "press")
  b:part"left":spring{ x = 30, y = 3 }
  local scene <const> = dotyk.scene{ b }
  local contact <const> = scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0, 0}, normal = {0, 0, 1} }, friction = dotyk.friction.coulomb(0.3) }
  local s <const> = S.multigrid{}:solve(scene, { steps = { { load = { press = 1 } }, { load = { press = 0 } } } })
  check.that(s.converged, s.reason)
  check.near(s.steps[1]:contact(contact).force[3], 80, 1e-7)
  check.near(s:contact(contact).force[3], 0, 1e-9)
end
