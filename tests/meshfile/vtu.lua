-- What dotyk writes for ParaView it reads back: the cells, body by body.
local check <const> = require "check"
local material <const> = dotyk.material{ E = 1, nu = 0.3 }

local function written(file, meshes)
  local bodies <const> = {}
  for i, m in ipairs(meshes) do
    bodies[i] = dotyk.body{ name = "body " .. i, mesh = m, material = material }
    bodies[i]:part "bottom":fix()
  end
  bodies[1]:part "top":pressure(0.1)
  return dotyk.solve(dotyk.scene(bodies)):write(file)
end

local low <const> = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {4, 2} }
local high <const> = dotyk.mesh.rectangle{ from = {0, 2}, to = {2, 3}, cells = {3, 5} }
local file <const> = written("two.vtu", { low, high })
local both <const> = dotyk.mesh.load(file)
check.equal({ both.dimension, both.element, both.node_count, both.cell_count }, { 2, "P1", 15 + 24, 16 + 30 })
check.equal(both.regions, { "body 1", "body 2" })
check.equal(#both:pieces(), 2)
local second <const> = dotyk.mesh.load(file, { region = "body 2" })
check.equal({ second.node_count, second.cell_count, second.parts }, { 24, 30, {} })
second:transform(function(x, y) check.that(y >= 2 and y <= 3) return x, y end)

for _, element in ipairs{ "P1", "Q1" } do
  local m <const> = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 2, 3}, cells = {2, 2, 3}, element = element }
  local back <const> = dotyk.mesh.load(written("solid.vtu", { m }))
  check.equal({ back.element, back.node_count, back.cell_count }, { element, m.node_count, m.cell_count })
end

-- Order 2: with the same nodes, also off the straight sides; or by the corners, which says so.
local function nodes(m)
  local all <const> = {}
  m:transform(function(...)
    all[#all + 1] = ("%.17g "):rep(select("#", ...)):format(...)
    return ...
  end)
  table.sort(all)
  return all
end
local function curved(element, dimension)
  local m <const> = dimension == 2 and dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {4, 2}, element = element }
    or dotyk.mesh.box{ from = {0, 0, 0}, to = {2, 1, 1}, cells = {2, 1, 2}, element = element }
  local function bent(x, y) return x + 0.1 * y^2, y * (1 - 0.05 * x^2) end
  m:transform(dimension == 2 and bent or function(x, y, z)
    x, y = bent(x, y)
    return x, y, z
  end)
  return m
end
for _, element in ipairs{ "P2", "Q2" } do
  for dimension = 2, 3 do
    local m <const> = curved(element, dimension)
    local body <const> = dotyk.body{ name = "bent", mesh = m, material = material }
    body:part("low", function(_, y) return y == 0 end):fix()
    dotyk.solve(dotyk.scene{ body }):write "bent.vtu"
    local back <const> = dotyk.mesh.load("bent.vtu", { order = 2 })
    check.equal({ back.element, back.cell_count, back.regions, back.notes }, { element, m.cell_count, { "bent" }, {} })
    check.equal(nodes(back), nodes(m), element .. " written and read")
    local first <const> = dotyk.mesh.load "bent.vtu"
    check.equal({ first.element, first.cell_count, #first.notes }, { element == "P2" and "P1" or "Q1", m.cell_count, 1 })
  end
end
os.remove "bent.vtu"

-- Text, a pixel and a voxel, regions by number, and what is not there.
local function grid(cells, more)
  local f <const> = assert(io.open("small.vtu", "w"))
  f:write('<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="8" NumberOfCells="1"><Points>',
    '<DataArray type="Float64" NumberOfComponents="3">0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1</DataArray></Points><Cells>', cells,
    "</Cells>", more or "", "</Piece></UnstructuredGrid></VTKFile>")
  f:close()
  return "small.vtu"
end
local function cell(type, nodes)
  local _ <const>, count <const> = nodes:gsub("%d+", "")
  return ('<DataArray type="Int64" Name="connectivity">%s</DataArray><DataArray type="Int64" Name="offsets">%d</DataArray><DataArray type="UInt8" Name="types">%d</DataArray>')
    :format(nodes, count, type)
end
local voxel <const> = dotyk.mesh.load(grid(cell(11, "0 1 2 3 4 5 6 7"), '<CellData><DataArray type="Int32" Name="region">42</DataArray></CellData>'))
check.equal({ voxel.element, voxel.cell_count, voxel.regions }, { "Q1", 1, { "42" } })
check.equal(dotyk.mesh.load(grid(cell(8, "0 1 2 3"))).node_count, 4)
check.error(dotyk.mesh.load, "VTK's type 7", grid(cell(7, "0 1 3 2 4")))
check.error(dotyk.mesh.load, "its cells are pyramids", grid(cell(14, "0 1 3 2 4")))
check.error(dotyk.mesh.load, "has a node that is not there", grid(cell(10, "0 1 2 8")))
check.error(dotyk.mesh.load, "small.vtu: ", grid(""))
check.error(dotyk.mesh.load, "XML", grid("<Cells>"))
local f = assert(io.open("small.vtu", "w"))
f:write '<VTKFile type="PolyData"></VTKFile>'
f:close()
check.error(dotyk.mesh.load, "small.vtu: ", "small.vtu")
os.remove "small.vtu"

-- Serendipity cells: a quarter ring of two quadrilaterals of 8 nodes, those nodes on the arcs. Its sides are parabolas, each
-- with 2/3 of chord times height between it and its chord.
local points <const>, cells <const> = {}, {}
local function point(r, angle) points[#points + 1] = ("%.17g %.17g 0"):format(r * math.cos(math.rad(angle)), r * math.sin(math.rad(angle))) end
for angle = 0, 90, 22.5 do point(1, angle) point(2, angle) if angle % 45 == 0 then point(1.5, angle) end end
-- inner, outer and, at sides, middle nodes: 0 1 2 | 3 4 | 5 6 7 | 8 9 | 10 11 12
for _, c in ipairs{ "0 1 6 5 2 4 7 3", "5 6 11 10 7 9 12 8" } do cells[#cells + 1] = c end
f = assert(io.open("ring.vtu", "w"))
f:write('<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="13" NumberOfCells="2"><Points><DataArray type="Float64" NumberOfComponents="3">',
  table.concat(points, " "), '</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity">', table.concat(cells, " "),
  '</DataArray><DataArray type="Int64" Name="offsets">8 16</DataArray><DataArray type="UInt8" Name="types">23 23</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>')
f:close()
local quarter <const> = dotyk.mesh.load("ring.vtu", { order = 2 })
check.equal({ quarter.element, quarter.node_count, quarter.cell_count, quarter.notes }, { "Q2", 15, 2, {} })
local ring <const> = dotyk.body{ name = "ring", mesh = quarter, material = material, force = {0, -1} }
local foot <const> = ring:part("foot", function(_, y) return y < 1e-9 end)
foot:fix()
local _ <const>, area <const> = dotyk.solve(dotyk.scene{ ring }):reaction(foot)
local turn <const> = math.pi / 4
check.near(area, 2 * (2^2 - 1^2) * (math.sin(turn) / 2 + 2 / 3 * 2 * math.sin(turn / 2) * (1 - math.cos(turn / 2))), 1e-12)
os.remove "ring.vtu"
