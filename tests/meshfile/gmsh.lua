-- Meshing by Gmsh: what it is told, and that nodes of curved boundaries lie on them.
local check <const> = require "check"
local refused <const> = require "refused"
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
-- Made by a function, with or without a table; and what such a function can do wrong.
check.equal(dotyk.mesh.gmsh{ text = function() return ring end, size = 0.1 }.node_count, m.node_count)
check.equal(dotyk.mesh.gmsh(function() return "Mesh.MeshSizeMax = 0.1;" .. ring end).node_count, m.node_count)
refused(function() dotyk.mesh.gmsh(function() return 5 end) end, "function 'text' returned the number 5, expected a string")
refused(function() dotyk.mesh.gmsh(function() error "no geometry" end) end, "no geometry (in 'text' of gmsh")
refused(function() dotyk.mesh.gmsh(5) end, "expected a table of keys (file, text,", "got the number 5")

-- Order 2: nodes between corners lie on the circles, too, two for each facet of these closed curves; the area, which is
-- the reaction to a unit force per area, converges as h^4, with chords as h^2. (In the ring the chords' errors cancel: they
-- are pi h^2/6 on either circle.)
local disc <const> = 'SetFactory("OpenCASCADE"); Disk(1) = {0, 0, 0, 1}; Physical Surface("disc") = {1};'
local function area(text, size, order)
  local m <const> = dotyk.mesh.gmsh{ text = text, size = size, order = order }
  local body <const> = dotyk.body{ name = "round", mesh = m, material = dotyk.material{ E = 1, nu = 0.3 }, force = {0, -1} }
  local facets, on = 0, 0
  local edge <const> = body:part("circles", function() facets = facets + 1 return true end)
  edge:fix()
  m:transform(function(x, y)
    if math.min(math.abs(math.sqrt(x^2 + y^2) - 1), math.abs(math.sqrt(x^2 + y^2) - 0.5)) < 1e-12 then on = on + 1 end
    return x, y
  end)
  check.equal({ m.element, on }, { "P" .. order, order * facets })
  local _ <const>, force <const> = dotyk.solve(dotyk.scene{ body }):reaction(edge)
  return force, facets
end
for order = 1, 2 do
  local coarse <const>, facets <const> = area(disc, 0.2, order)
  local fine <const>, more <const> = area(disc, 0.1, order)
  local rate <const> = math.log((coarse - math.pi) / (fine - math.pi)) / math.log(more / facets)
  check.near(rate, 2 * order, 0.05, "order of the area's error with cells of order " .. order)
end
check.near(area(ring, 0.1, 2), 0.75 * math.pi, 2e-6)  -- with the disc's 4e-7 on the outer circle and 4 times that on the inner

-- A crescent between two arcs of nearly one radius: with so few cells those of order 2 are turned inside out, which Gmsh cannot mend. That is
-- said of the cell, with what helps; straight sides or finer cells do.
local function crescent(lower, upper)
  return ([[Point(1) = {-1, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {0, 0.49, 0}; Point(4) = {0, 0.5, 0};
    Point(5) = {0, %.17g, 0}; Point(6) = {0, -0.75, 0};
    Circle(1) = {1, 5, 3}; Circle(2) = {3, 5, 2}; Circle(3) = {1, 6, 4}; Circle(4) = {4, 6, 2};
    Curve Loop(1) = {1, 2, -4, -3}; Plane Surface(1) = {1}; Transfinite Curve{1, 2} = %d; Transfinite Curve{3, 4} = %d;]]):format((0.49^2 - 1) / 0.98, lower, upper)
end
refused(function() dotyk.mesh.gmsh{ text = crescent(3, 2), order = 2 } end, "gmsh: geometry: cell ", "its sides are bent too far",
        "with straight sides (order = 1) it is sound, finer cells are bent less")
for _, segments in ipairs{ 1, 30 } do check.equal(dotyk.mesh.gmsh{ text = crescent(segments + 1, segments + 1), order = 2 }.element, "P2") end
check.equal(dotyk.mesh.gmsh{ text = crescent(3, 2) }.element, "P1")

-- Elements of order 3 to 5 by their corners.
for order = 3, 5 do
  for _, with in ipairs{ "", "Mesh.SecondOrderIncomplete = 1;", "Mesh.RecombineAll = 1;" } do
    local m <const> = dotyk.mesh.gmsh{ text = disc .. with .. "Mesh.ElementOrder = " .. order .. ";", size = 0.7 }
    check.equal(m.node_count, dotyk.mesh.gmsh{ text = disc .. with, size = 0.7 }.node_count)
  end
end

-- Quadrilaterals, solids and what Gmsh's own options ask for.
local recombined <const> = ring .. "\nMesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 2; Mesh.SecondOrderIncomplete = 1;"
check.equal(dotyk.mesh.gmsh{ text = recombined, size = 0.2, order = 2 }.element, "Q2")
-- A quarter of a pipe, of hexahedra of 27 and of 20 nodes: the same nodes, volumes near the pipe's.
local pipe <const> = [[
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0}; Point(4) = {0, 2, 0}; Point(5) = {0, 1, 0};
Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 2; Transfinite Curve{2, 4} = 5; Transfinite Surface{1}; Recombine Surface{1};
out() = Extrude{0, 0, 1}{ Surface{1}; Layers{2}; Recombine; };
Physical Volume("pipe") = {out(1)}; Physical Surface("low") = {1};
Mesh.SecondOrderIncomplete = %d;]]
for incomplete = 0, 1 do
  local m <const> = dotyk.mesh.gmsh{ text = pipe:format(incomplete), order = 2 }
  check.equal({ m.element, m.node_count, m.cell_count, m.parts, #m.notes }, { "Q2", 3 * 9 * 5, 8, { "low" }, 0 })
  local body <const> = dotyk.body{ name = "pipe", mesh = m, material = dotyk.material{ E = 1, nu = 0.3 }, force = {0, 0, -1} }
  body:part "low":fix()
  local _ <const>, _ <const>, volume <const> = dotyk.solve(dotyk.scene{ body }):reaction(body:part "low")
  -- Sides are parabolas: 2/3 of chord times height between chord and arc.
  local turn <const> = math.pi / 8
  check.near(volume, 4 * (2^2 - 1^2) * (math.sin(turn) / 2 + 2 / 3 * 2 * math.sin(turn / 2) * (1 - math.cos(turn / 2))), 1e-12)
end
local own <const> = dotyk.mesh.gmsh{ text = ring .. "\nMesh.ElementOrder = 2;", size = 0.2 }
check.equal({ own.element, own.notes[1] }, { "P1", "its elements are of order 2; only their corners are used, so that curved sides become straight (order = 2 takes them as they are)" })
local ball <const> = dotyk.mesh.gmsh{ text = 'SetFactory("OpenCASCADE"); Sphere(1) = {0, 0, 0, 1};', size = 0.7, order = 2 }
local weighed <const> = dotyk.body{ name = "ball", mesh = ball, material = dotyk.material{ E = 1, nu = 0.3 }, force = {0, 0, -1} }
local surface <const> = weighed:part("surface", function() return true end)
surface:fix()
local _ <const>, _ <const>, weight <const> = dotyk.solve(dotyk.scene{ weighed }):reaction(surface)
check.near(weight, 4 / 3 * math.pi, 0.01, "the volume of a ball of cells 0.7 wide")
check.error(dotyk.mesh.gmsh, "order", { text = ring, order = 3 })

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
check.error(dotyk.mesh.gmsh, "'file' and 'text' are both given", { file = file, text = box })
check.error(dotyk.mesh.gmsh, "gmsh: geometry: Gmsh ended without a mesh; does the geometry say Exit?", { text = box .. "Exit;" })
check.error(dotyk.mesh.gmsh, "region 'three'", { text = box, size = 0.5, region = "three" })
check.error(dotyk.mesh.gmsh, "size", { text = box, size = -1 })
check.error(dotyk.mesh.load, 'dotyk.mesh.gmsh{ file = "box.geo" }', file)
