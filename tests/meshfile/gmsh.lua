-- Meshing by Gmsh: what it is told, and that nodes of curved boundaries lie on them.
local check <const> = require "check"
if require "without_gmsh" then return end

local ring <const> = [[
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 1};
Disk(2) = {0, 0, 0, 0.5};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Physical Surface("ring") = {3};
edge() = Boundary{ Surface{3}; };
Physical Curve("edge") = {edge()};]]  -- no newline at the end: one is added

local m <const> = dotyk.mesh.gmsh{ text = ring, size = 0.1 }
check.equal({ m.dimension, m.element }, { 2, "P1" })
check.equal({ m.regions[1], m.parts[1] }, { "ring", "edge" })
local body <const> = dotyk.body{ name = "ring", mesh = m, material = dotyk.material{ E = 1, nu = 0.3 } }
-- Facet centres of chords of at most 0.1 lie within h^2/8r of their circles, on the inner side of each.
body:part("near", function(x, y)
  local r <const> = math.sqrt(x^2 + y^2)
  check.that(r <= 1 and r > 0.99 and r > 1 - 0.1^2 / 8 - 1e-12 or r <= 0.5 and r > 0.5 - 0.1^2 / 4 - 1e-12, "facet at " .. r)
  return true
end)
m:transform(function(x, y)
  check.that(x^2 + y^2 < 1 + 1e-12 and x^2 + y^2 > 0.25 - 1e-12)
  return x, y
end)

-- size: halved, about four times the cells.
local fine <const> = dotyk.mesh.gmsh{ text = ring, size = 0.05 }
check.that(fine.cell_count > 3 * m.cell_count and fine.cell_count < 5 * m.cell_count)
-- The same geometry gives the same mesh.
check.equal(dotyk.mesh.gmsh{ text = ring, size = 0.1 }.node_count, m.node_count)

local box <const> = [[
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {3, 0, 0, 1, 1, 1};
Physical Volume("one") = {1}; Physical Volume("two") = {2}; Physical Surface("low") = {5}; Physical Surface("face") = {1};]]
local solid <const> = dotyk.mesh.gmsh{ text = box, size = 0.5 }
check.equal({ solid.dimension, solid.element, #solid:pieces() }, { 3, "P1", 2 })
check.equal(solid.parts, { "face", "low" })
local two <const> = dotyk.mesh.gmsh{ text = box, size = 0.5, region = "two" }
check.equal({ two.cell_count, two.parts }, { solid:pieces()[2].cell_count, {} })
check.error(dotyk.mesh.gmsh, "surface in space", { text = box, size = 0.5, dimension = 2 })

-- From a file; what is wrong with it, and where.
local file <const> = "box.geo"
local function write(text)
  local f <const> = assert(io.open(file, "w"))
  f:write(text)
  f:close()
end
write(box .. "\n")
check.equal(dotyk.mesh.gmsh{ file = file, size = 0.5 }.cell_count, solid.cell_count)
write(box)
check.error(dotyk.mesh.gmsh, "its last line does not end", { file = file })
write "x = ;\n"
check.error(dotyk.mesh.gmsh, "gmsh: box.geo: Gmsh: './box.geo', line 1: syntax error", { file = file })
os.remove(file)
check.error(dotyk.mesh.gmsh, "gmsh: geometry: Gmsh: the text, line 2: syntax error", { text = "x = 1;\nBox(1 = 2;" })
check.error(dotyk.mesh.gmsh, "no surface and no volume", { text = "Point(1) = {0, 0, 0};" })
check.error(dotyk.mesh.gmsh, "cannot read 'nothing.geo': No such file", { file = "nothing.geo" })
check.error(dotyk.mesh.gmsh, "does not end in .geo, .step", { file = "box.msh" })
check.error(dotyk.mesh.gmsh, "one of 'file' and 'text' is needed", { size = 1 })
check.error(dotyk.mesh.gmsh, "one of 'file' and 'text' is needed", { file = file, text = box })
check.error(dotyk.mesh.gmsh, "region 'three'", { text = box, size = 0.5, region = "three" })
check.error(dotyk.mesh.gmsh, "size", { text = box, size = -1 })
check.error(dotyk.mesh.load, 'dotyk.mesh.gmsh{ file = "box.geo" }', file)
