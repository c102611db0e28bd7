-- Error estimates and refinement as a script sees them.
local check = require "check"

local function punch(mesh)
  local block = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 }, force = { 0, -1 } }
  block:part "bottom":fix()
  local scene = dotyk.scene{ block }
  scene:contact{ block:part "top", rigid = dotyk.rigid.gap{ normal = { 0, 1 }, gap = function(x) return x^2 / 4 - 0.02 end } }
  return dotyk.solve(scene)
end

local start = dotyk.mesh.rectangle{ from = { -1, -1 }, to = { 1, 0 }, cells = { 8, 4 } }
local s = punch(start)

-- The parts' squares add up to the whole, and so do the cells'.
local relative, e = s:error_estimate()
check.equal(relative, e.relative)
local sum, cells = 0, 0
for _, part in ipairs{ "recovery", "bulk", "jump", "boundary", "contact_pressure", "complementarity", "friction", "laws" } do sum = sum + e[part]^2 end
for _, cell in ipairs(e.cells[1]) do cells = cells + cell^2 end
check.near({ sum / e.absolute^2, cells / e.absolute^2 }, { 1, 1 }, 1e-12)
check.equal(#e.cells[1], start.cell_count)
check.equal(e.jump, 0.0)
check.error(function() return e.jmup end, "jmup")

-- Refinement by a solution, by cells, of everything; the mesh given stays.
local r = dotyk.refinement{ start }
check.equal(r.meshes[1].cell_count, 64)
check.that(r:refine(s).meshes[1].cell_count > 64)
local finer = punch(r.meshes[1])
check.that(finer:error_estimate() < relative)
check.equal(start.cell_count, 64)
check.equal(dotyk.refinement{ start }:refine().meshes[1].cell_count, 256)
local one = dotyk.refinement{ start }:refine{ { 1 } }.meshes[1]
check.that(one.cell_count > 64 and one.cell_count < 80)
check.equal(table.concat(one.parts, " "), table.concat(start.parts, " "))

-- A circle stays a circle.
local disc = dotyk.refinement{ dotyk.mesh.disc{ center = { 0, 0 }, radius = 1, cells = 2 } }
for _ = 1, 2 do
  disc:refine():project("boundary", function(x, y) local d = math.sqrt(x^2 + y^2) return x / d, y / d end)
end
local round = dotyk.body{ mesh = disc.meshes[1], material = dotyk.material{ E = 1, nu = 0 } }
round:part("boundary", function(x, y) check.that(math.abs(x^2 + y^2 - 1) < 0.01) return true end)

check.error(function() r:refine{ { 0 } } end, "cell 0 is to be refined")
check.error(function() r:refine{ { 1.5 } } end, "cell 1.5 is not a number of a cell")
check.error(function() r:refine{ { 1 }, { 2 } } end, "2 lists of cells are given for 1 mesh; give one a mesh")
check.error(function() r:refine(s) end, "no body of the solution has one of the meshes being refined, as it is now")
check.error(function() dotyk.refinement{ start }:refine(s, 2) end, "share of the error to be refined is 2; it must be in (0, 1]")
check.error(function() r:project("rim", function(x, y) return x, y end) end, "no mesh being refined has a part 'rim'")
check.error(function() dotyk.refinement{} end, "no mesh is given")
check.error(function() dotyk.refinement{ dotyk.mesh.disc{ center = { 0, 0 }, radius = 1, cells = 2, element = "Q1" } } end, "only simplices")
