-- Meshes that cannot be made, and maps that would break one.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
refused.intact = it.solve

local function rectangle(cells) return function() dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = cells } end end
local function expect(fn, ...)  -- the call stands in rectangle() above
  local message = select(2, pcall(fn))
  check.that(type(message) == "string" and message:find "^[^:]*refused_mesh.lua:8: rectangle: ", message)
  for _, text in ipairs{ ... } do check.that(message:find(text, 1, true), message .. " lacks " .. text) end
  it.solve()
end
expect(rectangle{ 0, 2 }, "cells along x is 0; it must be from 1 to")
expect(rectangle{ 2, 0 }, "cells along y is 0; it must be from 1 to")
expect(rectangle{ -3, 2 }, "cells along x is -3")
expect(rectangle{ 1.5, 2 }, "'cells': entry 1 must be an integer, got the number 1.5")
expect(rectangle{ 1e9, 2 }, "cells along x is 1000000000; it must be from 1 to 1000000")
expect(rectangle{ math.maxinteger, 2 }, "it must be from 1 to 1000000")
expect(rectangle{ 1e300, 2 }, "'cells': entry 1 must be an integer")
expect(rectangle{ 0/0, 2 }, "finite")
expect(rectangle{ "4", 2 }, "entry 1 must be an integer, got the string \"4\"")
expect(rectangle{ 4 }, "must be a table of 2 integers, got a table of 1")
expect(rectangle{ 4, 4, 4 }, "must be a table of 2 integers, got a table of 3")
expect(rectangle{}, "must be a table of 2 integers")
expect(rectangle(4), "must be a table of 2 integers, got the number 4")
expect(rectangle{ x = 4 }, "got the key 'x'")
-- What no machine holds is refused before any of it is made.
local clock <const> = os.clock()
expect(rectangle{ 20000, 20000 }, "4e+08 cells", "at most 2e8")
check.that(os.clock() - clock < 1)

refused(function() dotyk.mesh.disc{ center = {0,0}, radius = 1, cells = 0 } end, "disc: cells is 0; it must be from 1 to 10000")
refused(function() dotyk.mesh.disc{ center = {0,0}, radius = 0, cells = 2 } end, "'radius' must be a positive number, got the number 0")
refused(function() dotyk.mesh.disc{ center = {0,0}, radius = -1, cells = 2 } end, "'radius' must be a positive number")
refused(function() dotyk.mesh.disc{ center = {0,0,0}, radius = 1, cells = 2 } end, "'center' must be a table of 2 numbers")
refused(function() dotyk.mesh.rectangle{ from = {0,0}, to = {-1,1}, cells = {1,1} } end, "'to' must exceed 'from' along x (from 0 to -1)")
refused(function() dotyk.mesh.rectangle{ from = {0,0}, to = {1,0}, cells = {1,1} } end, "along y (from 0 to 0)")
refused(function() dotyk.mesh.rectangle{ from = {0,0,0}, to = {1,1}, cells = {1,1} } end, "'from' must be a table of 2 numbers")
refused(function() dotyk.mesh.box{ from = {0,0}, to = {1,1,1}, cells = {1,1,1} } end, "'from' must be a table of 3 numbers")
refused(function() dotyk.mesh.rectangle{ from = {0/0,0}, to = {1,1}, cells = {1,1} } end, "'from': entry 1 must be a finite number, got nan")
refused(function() dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {1,1}, element = "Q7" } end, "'element' must be", "did you mean \"Q")

-- Grading.
local function graded(f) return { from = {0,0}, to = {1,1}, cells = {2,2}, grading = { x = f } } end
refused(function() dotyk.mesh.rectangle(graded(function() return 0.5 end)) end, "grading.x must increase", "at s = 0.5 it gives 0.5")
refused(function() dotyk.mesh.rectangle(graded(function(s) return s / 2 end)) end, "grading.x must map 0 to 0 and 1 to 1")
refused(function() dotyk.mesh.rectangle(graded(function(s) end)) end, "function 'x' returned nothing at (0)")
refused(function() dotyk.mesh.rectangle(graded(function(s) return 0/0 end)) end, "returned nan (not a number) at (0)")
refused(function() dotyk.mesh.rectangle(graded(function(s) error "mine" end)) end, "mine (in 'x' of rectangle at")
refused(function() dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2}, grading = { z = math.abs } } end, "unknown key 'z'")

-- Pieces that are apart, or hinged at a node (in space: at an edge), are bodies of their own.
local function body(mesh) return function() dotyk.body{ name = "frame", mesh = mesh, material = dotyk.material{ E = 1, nu = 0 } } end end
local strip <const> = dotyk.mesh.rectangle{ from = {0,0}, to = {3,1}, cells = {12,4}, element = "Q1" }
refused(body(strip:keep(function(x) return math.abs(x - 1.5) > 0.5 end)), "the mesh of 'frame' is in 2 pieces that share no edge: "
  .. "16 cells around (0.5, 0.5), 16 cells around (2.5, 0.5); make each a body of its own")
refused(body(strip:keep(function(x, y) return (x < 1.5) == (y < 0.5) end)), "2 pieces", "12 cells around (0.75, 0.25), 12 cells around (2.25, 0.75)")
refused(body(strip:keep(function(x, y) return math.floor(4 * x) % 2 == 0 and y < 0.25 end)), "is in 6 pieces", "1 cell around (0.125, 0.125), ", " and 2 more; ")
local beam <const> = dotyk.mesh.box{ from = {0,0,0}, to = {2,2,1}, cells = {2,2,1} }
refused(body(beam:keep(function(x, y) return (x < 1) == (y < 1) end)), "2 pieces that share no face: 6 cells around (0.5, 0.5, 0.5), 6 cells around (1.5, 1.5, 0.5)")

-- Cells that lie side by side, each with points of its own: they are to share them.
local lines <const> = { "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n12" }
for c = 0, 2 do
  for k, x in ipairs{ c, c + 1, c + 1, c } do lines[#lines + 1] = ("%d %d %d 0"):format(4 * c + k, x, k // 3) end
end
lines[#lines + 1] = "$EndNodes\n$Elements\n3"
for c = 0, 2 do lines[#lines + 1] = ("%d 3 2 0 0 %d %d %d %d"):format(c, 4 * c + 1, 4 * c + 2, 4 * c + 3, 4 * c + 4) end
local f <const> = assert(io.open("apart.msh", "w"))
f:write(table.concat(lines, "\n"), "\n$EndElements\n")
f:close()
refused(body(dotyk.mesh.load "apart.msh"), "the mesh of 'frame' is in 3 pieces that share no edge: ",
        "; 4 of its 12 nodes lie where another one does: cells that hang together share nodes, so merge them in the program that made the mesh")
os.remove "apart.msh"
-- What is left of a body with a hole is one; and so is each piece alone.
body(strip:keep(function(x, y) return math.abs(x - 1.5) > 0.5 or math.abs(y - 0.5) > 0.25 end))()
body(beam:keep(function(x, y) return x < 1 and y < 1 end))()

-- A map that inverts, flattens or loses a cell leaves the mesh as it was.
local m <const> = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} }
local function area()  -- by a body that carries its own weight
  local b = dotyk.body{ mesh = m, material = it.material, force = {0,-1} }
  b:part "bottom":fix()
  return select(2, dotyk.solve(dotyk.scene{ b }):reaction(b:part "bottom"))
end
refused.intact = function() check.near(area(), 1) end
refused(function() m:transform(function(x, y) return -x, y end) end, "transform: the moved mesh: cell 1", "inverted", "must be positive")
refused(function() m:transform(function(x, y) return x, 0 end) end, "is flat")
refused(function() m:transform(function(x, y) return x < 0.4 and 1 - x or x, y end) end, "inverted")
refused(function() m:transform(function(x, y) return 0/0, y end) end, "function 'map' returned nan (not a number) at (0, 0)")
refused(function() m:transform(function(x, y) return x end) end, "function 'map' returned 1 number, expected 2 numbers")
refused(function() m:transform(function(x, y) return x, y, 0 end) end, "returned 3 numbers, expected 2 numbers")
refused(function() m:transform(function(x, y) if x > 0.5 then error "mine" end return 2 * x, y end) end, "mine")
refused(function() m:transform() end, "argument 1 'map' is missing, expected a function")
refused(function() m:transform(3) end, "argument 1 'map' must be a function, got the number 3")
m:transform(function(x, y) return 2 * x, y end)
check.near(area(), 2)
