-- The ten lines of the README: a rigid parabola pressed 0.001 mm into a block.
--
--   ./dotyk scripts/first.lua

local mesh  = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {64,32} }
local steel = dotyk.material{ E = 210e3, nu = 0.3 }
local block = dotyk.body{ name = "block", mesh = mesh, material = steel }
block:part"bottom":fix()
local scene = dotyk.scene{ block }
local punch = dotyk.rigid.gap{ normal = {0,1}, gap = function(x) return x^2/80 - 0.001 end }
local contact = scene:contact{ block:part"top", rigid = punch }
local s = dotyk.solve(scene)
print(s, s:contact(contact).max_pressure)
s:render{ file = "images/first.png", field = "von_mises", supports = true, units = { length = "mm", stress = "MPa" } }
