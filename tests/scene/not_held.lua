-- Bodies that nothing holds, or not in every direction, are refused with the motion that stays free.
local check <const> = require "check"
local refused <const> = require "refused"

local material <const> = dotyk.material{ E = 10, nu = 0 }
local function square(name)
  return dotyk.body{ name = name or "lid", material = material,
                     mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} } }
end
local floor <const> = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }

-- Not at all.
local free <const> = square()
free:part "top":load{ 0, -1 }
local alone <const> = dotyk.scene{ free }
refused(function() dotyk.solve(alone) end, "solve: 'lid' is not held: nothing stops its translation along x, translation along y and rotation about (0.5, 0.5)", "fix a part")
-- The other body's support does not help, and the right one is named.
local base <const> = square "base"
base:part "bottom":fix()
refused(function() dotyk.solve(dotyk.scene{ base, free }) end, "'lid' is not held")
-- Held afterwards, the same scene solves.
free:part "bottom":fix()
check.near({ dotyk.solve(alone):reaction(free:part "bottom") }, { 0, 1 })

-- In part.
local sliding <const> = square()
sliding:part "bottom":slide()
sliding:part "top":load{ 1, 0 }
local rail <const> = dotyk.scene{ sliding }
refused(function() dotyk.solve(rail) end, "'lid' is not held: nothing stops its translation along x")
check.that(tostring(rail:plan()):find("no solution: 'lid' is not held: nothing stops its translation along x", 1, true))
sliding:part "left":fix "x"
check.that(dotyk.solve(rail).converged)
local pinned <const> = square()
pinned:part("corner", function(x, y, nx, ny) return ny < 0 and x < 0.5 end):fix "x"
refused(function() dotyk.solve(dotyk.scene{ pinned }) end, "'lid' is not held: nothing stops its rotation about (0.5, 0) and translation along y")
local springs <const> = square()
springs:part "bottom":spring{ x = 0, y = 0 }
refused(function() dotyk.solve(dotyk.scene{ springs }) end, "'lid' is not held")

-- By contact alone: pushed sideways, lifted off, or solved up to a motion that nothing notices.
local function on_floor(load)
  local lid = square()
  lid:part "top":load(load)
  local scene = dotyk.scene{ lid }
  return scene, lid, scene:contact{ lid:part "bottom", rigid = floor }
end
local scene, lid, contact = on_floor{ 1, -1 }
refused(function() dotyk.solve(scene) end, "not held: nothing stops 'lid': translation along x; the load does work 1 on a unit of this motion")
scene, lid, contact = on_floor{ 0, -1 }
local loose <const> = dotyk.solve(scene)
check.that(loose.converged)
check.that(loose.reason:find("unique up to 'lid': translation along x, which no support or contact notices", 1, true))

-- All motions that nothing notices are named: a cube on a floor.
local cube <const> = dotyk.body{ name = "cube", mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {2,2,2} },
                                 material = dotyk.material{ E = 10, nu = 0.3 }, force = {0, 0, -1} }
local ground <const> = dotyk.scene{ cube }
local sole <const> = ground:contact{ cube:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0,0}, normal = {0,0,1} } }
local resting <const> = dotyk.solve(ground)
check.near(resting:contact(sole).force, { 0, 0, 1 }, 1e-12)
check.that(resting.reason:find("unique up to 'cube': translation along x, 'cube': translation along y and 'cube': rotation about", 1, true))
check.near(loose:contact(contact).force, { 0, 1 })
lid:part "left":fix "x"
check.near(dotyk.solve(scene):contact(contact).force, { 0, 1 })
scene, lid = on_floor{ 0, 1 }
lid:part "left":fix "x"
refused(function() dotyk.solve(scene) end, "nothing stops 'lid': translation along y; the load does work 1", "add a contact in its way")
-- Both ways of solving agree on that.
refused(function() dotyk.solver.pdas{ reduced = false }:solve(scene) end, "nothing stops 'lid': translation along y")
-- What would hold it is said: where, and which way.
refused(function() dotyk.solve(scene) end, "Hold 'lid' along y (fix \"y\" or a spring on a part of it)", "on the side of greater y")

-- In space rotations are named too.
local cube <const> = dotyk.body{ name = "cube", material = material,
                                 mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {1,1,1} } }
cube:part "bottom":slide()
cube:part "left":slide()
refused(function() dotyk.solve(dotyk.scene{ cube }) end, "'cube' is not held: nothing stops its translation along y")
cube:part "front":slide()
check.near(dotyk.solve(dotyk.scene{ cube }).energy, 0)
