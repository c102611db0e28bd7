-- Loads that no friction bears: forces in the cones of friction would balance them, but no pressures that the bodies can build up
-- have so much of it. And contacts that supports contradict.
local check <const> = require "check"

local material <const> = dotyk.material{ E = 1000, nu = 0.3 }
local function block() return dotyk.body{ name = "block", mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }, material = material } end
local function wall(x, n, depth) return dotyk.rigid.plane{ point = {x + n * depth, 0}, normal = {n, 0} } end

-- 1. A block wedged between two walls by an interference of 0.01 on either side: pressures of some 20, friction of some 20.
local function wedged(load)
  local b = block()
  local scene = dotyk.scene{ b }
  for side, at in pairs{ left = wall(0, 1, 0.01), right = wall(1, -1, 0.01) } do
    scene:contact{ b:part(side), rigid = at, friction = dotyk.friction.coulomb(0.5), interference = true }
  end
  b:part"bottom":load{ 0, -load }
  return scene
end
check.that(dotyk.solve(wedged(1)).converged)
local message <const> = check.error(dotyk.solve, "not held: friction cannot bear what nothing else stops, 'block': translation along -y", wedged(100))
check.that(message:find("no pressures that the bodies can build up have friction enough", 1, true), message)

-- The same on finer meshes, where no search through all states ends, by every method that treats friction: refused from some per cent above what
-- friction can bear, about 22, and below that said to be perhaps without a solution.
local function wedge(load, cells, element, unit)
  local material <const> = dotyk.material{ E = 1000 * (unit or 1), nu = 0.3 }
  local w = dotyk.body{ name = "w", mesh = dotyk.mesh.rectangle{ from = {-0.01,0}, to = {1.01,1}, cells = {cells, cells}, element = element },
                        material = material, force = { 0, -load * (unit or 1) } }
  local scene = dotyk.scene{ w }
  for side, n in pairs{ left = 1, right = -1 } do
    scene:contact{ w:part(side), rigid = wall(n > 0 and 0 or 1, n, 0), friction = dotyk.friction.coulomb(0.5), interference = true }
  end
  return scene
end
for _, name in ipairs{ "newton", "proximal", "coulomb_loop", "uzawa", "uzawa_pdas", "psor", "projected_cg" } do
  local text <const> = check.error(function() dotyk.solver[name]{}:solve(wedge(60, 12, "P1")) end,
    "friction cannot bear what nothing else stops, 'w': translation along -y")
  check.that(text:find("two convex programs", 1, true), name .. ": " .. text)
end
for cells, element in pairs{ [30] = "P1", [12] = "Q1", [6] = "P2" } do
  check.that(dotyk.solve(wedge(20, cells, element)).converged)
  check.error(dotyk.solve, "friction cannot bear what nothing else stops", wedge(24, cells, element))
end
for _, unit in ipairs{ 1e-12, 1e12 } do
  check.that(dotyk.solve(wedge(20, 12, "P1", unit)).converged)
  check.error(dotyk.solve, "friction cannot bear what nothing else stops", wedge(24, 12, "P1", unit))
end
local between <const> = dotyk.solver.psor{}:solve(wedge(22, 12, "P1"))
check.that(not between.converged, between.reason)
check.that(between.reason:find("there may be no solution: only friction stops 'w': translation along -y", 1, true), between.reason)

-- A box in space between two walls.
local function box(load)
  local w = dotyk.body{ name = "w", mesh = dotyk.mesh.box{ from = {-0.01,0,0}, to = {1.01,1,1}, cells = {3,2,3}, element = "Q1" },
                        material = material, force = { 0, 0, -load } }
  for _, side in ipairs{ "front", "back" } do w:part(side):fix"y" end
  local scene = dotyk.scene{ w }
  for side, n in pairs{ left = 1, right = -1 } do
    local plane = dotyk.rigid.plane{ point = { n > 0 and 0 or 1, 0, 0 }, normal = { n, 0, 0 } }
    scene:contact{ w:part(side), rigid = plane, friction = dotyk.friction.coulomb(0.5), interference = true }
  end
  return scene
end
check.that(dotyk.solve(box(15)).converged)
check.error(dotyk.solve, "friction cannot bear what nothing else stops, 'w': translation along -z", box(40))

-- 2. Laws that prescribe where a node is, inside what it touches: as `fix` does.
local b <const> = block()
local scene <const> = dotyk.scene{ b }
b:part"left":support{ normal = dotyk.law.prescribed(0), tangential = dotyk.law.prescribed(0) }
scene:contact{ b:part"top", rigid = dotyk.rigid.plane{ point = {0, 0.99}, normal = {0, -1} }, interference = true }
check.error(dotyk.solve, "no displacement can part them", scene)

-- 3. Given friction acts where supports hold the normal, in space as in the plane.
for dimension = 2, 3 do
  local mesh = dimension == 2 and dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }
               or dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {2,2,2} }
  local held = dotyk.body{ mesh = mesh, material = material }
  local s = dotyk.scene{ held }
  held:part"right":fix(dimension == 2 and "y" or "z")
  held:part"top":load(dimension == 2 and { 0.1, -1 } or { 0.1, 0.1, -1 })
  local up = dimension == 2 and { 0, 1 } or { 0, 0, 1 }
  local c = s:contact{ held:part"bottom", rigid = dotyk.rigid.plane{ point = dimension == 2 and { 0, 0 } or { 0, 0, 0 }, normal = up },
                       friction = dotyk.friction.tresca(math.huge) }
  for _, node in ipairs(dotyk.solve(s):contact(c).nodes) do
    for _, slip in ipairs(node.slip) do check.near(slip, 0, 1e-12) end
  end
end
