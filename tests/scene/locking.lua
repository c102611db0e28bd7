-- Linear cells of a nearly incompressible material lock: the plan and print say so, and name cells that do not.
local check <const> = require "check"

local function block(dimension, element, material)
  local box = dimension == 2 and dotyk.mesh.rectangle or dotyk.mesh.box
  local b = dotyk.body{ name = "pad", material = material, mesh = dimension == 2 and box{ from = {0,0}, to = {1,1}, cells = {2,2}, element = element }
    or box{ from = {0,0,0}, to = {1,1,1}, cells = {1,1,1}, element = element } }
  b:part"bottom":fix()
  b:part"top":load(dimension == 2 and { 0, -1e-3 } or { 0, 0, -1e-3 }) -- turns nothing
  return dotyk.scene{ b }
end
local function warns(scene)
  local s = dotyk.solve(scene)
  local plan, print = scene:plan():find("warning: 'pad' is nearly incompressible", 1, true), tostring(s):find("nearly incompressible", 1, true)
  check.that((plan ~= nil) == (print ~= nil) and (plan ~= nil) == (#s.warnings > 0))
  if plan then check.that(scene:plan():find("P2", 1, true)) end
  return plan ~= nil
end

for _, dimension in ipairs{ 2, 3 } do
  for _, element in ipairs{ "P1", "Q1", "P2", "Q2" } do
    local linear = element:sub(2) == "1"
    check.that(not warns(block(dimension, element, dotyk.material{ E = 1, nu = 0.44 })))
    check.that(warns(block(dimension, element, dotyk.material{ E = 1, nu = 0.46 })) == linear)
    check.that(warns(block(dimension, element, dotyk.material{ E = 1, nu = 0.4999 })) == linear)
  end
end
-- In plane stress nothing locks.
check.that(not warns(block(2, "P1", dotyk.material{ E = 1, nu = 0.499, plane = "stress" })))
-- By the ratio of bulk to shear: an orthotropic stiffness, and nu that varies in space.
local function orthotropic(bulk) return dotyk.material{ stiffness = { { bulk + 1, bulk - 0.5, 0 }, { bulk - 0.5, bulk + 2, 0 }, { 0, 0, 0.8 } } } end
check.that(not warns(block(2, "P1", orthotropic(3))))
check.that(warns(block(2, "P1", orthotropic(100))))
check.that(warns(block(2, "P1", dotyk.material{ E = 1, nu = function(x) return x < 0.5 and 0.2 or 0.49 end })))
-- How much it is: a clamped strip in bending, P1 against P2, loses most of its displacement where P1 says the same as P2 at nu = 0.3.
local function tip(element, nu)
  local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {4,1}, cells = {24,6}, element = element }, material = dotyk.material{ E = 1000, nu = nu } }
  b:part"left":fix()
  b:part"right":load{ 0, -1 }
  local _, y = dotyk.solve(dotyk.scene{ b }):displacement(b, 4, 0.5)
  return y
end
check.that(tip("P1", 0.3) / tip("P2", 0.3) > 0.8)
check.that(tip("P1", 0.4999) / tip("P2", 0.4999) < 0.5)
