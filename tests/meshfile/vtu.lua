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
local f <const> = assert(io.open("small.vtu", "w"))
f:write '<VTKFile type="PolyData"></VTKFile>'
f:close()
check.error(dotyk.mesh.load, "small.vtu: ", "small.vtu")
os.remove "small.vtu"
