-- A strip that touches all along: rows are a large part of its unknowns, and what condenses them takes the cube of their number.
local check = require "check"

local function strip(cells)
  local b = dotyk.body{ name = "strip", mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {4,0.1}, cells = {cells,1}, element = "Q1" },
    material = dotyk.material{ E = 1e6, nu = 0 }, force = { 0, -100 } }
  b:part"left":load{ 0, 20 }
  b:part"right":fix"x"
  local scene = dotyk.scene{ b }
  return scene, scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }
end

-- Few rows are condensed, many are not; the plan says so, and the solve does it.
check.that(tostring(strip(100):plan()):find("pdas on 101 condensed rows", 1, true))
local scene, contact = strip(3500)
check.that(tostring(scene:plan()):find("pdas on all 14002 unknowns", 1, true), tostring(scene:plan()))
local s = dotyk.solve(scene)
check.that(s.converged and s.time.factor == 0, s.reason)
check.that(s.residual.law < 1e-9 and s.residual.penetration < 1e-9)

-- What is pressed on the plane is the weight less the lift.
check.near(s:contact(contact).force[2], 100 * 4 * 0.1 - 20 * 0.1, 1e-5)
