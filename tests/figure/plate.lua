-- Figures of plates as a script asks for them.
local check <const> = require "check"
local refused <const> = require "refused"
local size <const> = require "png_size"
local law <const> = dotyk.law

local mesh <const> = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {6, 6} }
local s <const> = dotyk.solve(dotyk.plate{ mesh = mesh, load = -1, edges = { left = { deflection = law.signorini() }, right = { deflection = law.prescribed(), rotation = law.prescribed() },
  top = { deflection = law.friction(0.1) } }, supports = { { x = 0.3, y = 0.2, deflection = law.signorini() } }, obstacle = -0.002 })

check.equal(s:render{ file = "plate.png" }, "plate.png")
check.equal(size "plate.png", { 1200, 800 })
check.equal(s:render{ file = "plate.png", view = "plan" }, "plate.png")
check.equal(size "plate.png", { 1200, 1100 })
for _, field in ipairs{ "none", "deflection", "mxx", "myy", "mxy", "m1", "m2", "von_mises" } do
  for _, view in ipairs{ "surface", "plan" } do
    s:render{ file = "plate.png", view = view, field = field, title = "T", units = { length = "m", force = "kN" }, size = { 400, 300 } }
  end
end
check.equal(size "plate.png", { 400, 300 })
s:render{ file = "plate.png", deform = 3, edges = false, range = { -1, 1 }, eye = { -1, -1, 1 }, size = { 300, 300 } }
s:render{ file = "plate.png", deform = "auto", edges = true, size = { 300, 300 } }

refused(function() s:render{} end, "'file'")
refused(function() s:render{ file = "plate.jpg" } end, ".png")
refused(function() s:render{ file = "nowhere/plate.png" } end, "nowhere")
refused(function() s:render{ file = "plate.png", view = "plane" } end, 'did you mean "plan"?')
refused(function() s:render{ file = "plate.png", field = "von_mise" } end, 'did you mean "von_mises"?')
refused(function() s:render{ file = "plate.png", deform = 0/0 } end, "deform")
refused(function() s:render{ file = "plate.png", range = { 1, -1 } } end, "range of the field")
refused(function() s:render{ file = "plate.png", view = "plan", eye = { 1, 0, 1 } } end, 'view = "surface"')
refused(function() s:render{ file = "plate.png", eye = { 0, 0, 0 } } end, "direction")
refused(function() s:render{ file = "plate.png", size = { 10, 400 } } end, "from 160 to 8192")
