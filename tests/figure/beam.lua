-- Figures of beams and laws as a script asks for them.
local check <const> = require "check"
local refused <const> = require "refused"
local size <const> = require "png_size"
local law <const> = dotyk.law

local s <const> = dotyk.solve(dotyk.beam{ length = 2, load = -1, left = { deflection = law.prescribed(), rotation = law.prescribed() },
  right = { deflection = law.signorini() }, supports = { { x = 1, deflection = law.elastic(3), rotation = law.friction(0.1) } } })

check.equal(s:render{ file = "beam.png" }, "beam.png")
check.equal(s:render{ file = "beam.png", panels = { "shear", "deflection" }, title = "T", units = { length = "m", force = "kN" }, size = { 500, 200 } }, "beam.png")
check.equal(size "beam.png"[1], 500)
check.that(size "beam.png"[2] > 2 * 30 / 85 * 500)  -- two panels of 30 mm
check.equal(s:render_law{ file = "law.png", support = "right" }, "law.png")
s:render_law{ file = "law.png", support = 1, of = "rotation", units = { force = "N" } }
for name, numbers in pairs{ free = {}, prescribed = { 0.2 }, load = { -1 }, elastic = { 2 }, one_sided_elastic = { 2 }, unequal_elastic = { 2, 1 }, signorini = {}, friction = { 1 },
  one_sided_friction = { 1 }, capped_elastic = { 2, 1 }, breaking = { 2, 1 } } do
  for _, of in ipairs{ "deflection", "rotation" } do check.equal(law[name](table.unpack(numbers)):render{ file = "law.png", of = of }, "law.png") end
end
check.equal(dotyk.support_gallery{ file = "gallery.png", rows = { { solution = s, support = 1 }, { solution = s, support = "right", title = "a" } } }, "gallery.png")
check.equal(size "gallery.png", { 1600, 820 })

refused(function() s:render{} end, "'file'")
refused(function() s:render{ file = "beam.png", panels = { "momnt" } } end, 'did you mean "moment"?')
refused(function() s:render{ file = "beam.png", panels = {} } end, "'panels'")
refused(function() s:render{ file = "beam.png", panel = { "moment" } } end, "did you mean 'panels'?")
refused(function() s:render{ file = "beam.jpg" } end, ".png")
refused(function() s:render{ file = "beam.png", size = { 10, 400 } } end, "from 160 to 8192")
refused(function() s:render_law{ file = "law.png" } end, "'support'")
refused(function() s:render_law{ file = "law.png", support = "rigth" } end, 'did you mean "right"?')
refused(function() s:render_law{ file = "law.png", support = 0.7 } end, "no support there; the supports are left, x = 1, right")
refused(function() s:render_law{ file = "law.png", support = "left", of = "rotaton" } end, 'did you mean "rotation"?')
refused(function() law.free():render{ file = "nowhere/law.png" } end, "nowhere")
refused(function() dotyk.support_gallery{ file = "g.png", rows = {} } end, "'rows'")
refused(function() dotyk.support_gallery{ file = "g.png", rows = { { solution = s, support = 3 } } } end, "no support there")
