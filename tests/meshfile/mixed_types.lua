-- Quadrilaterals of 4, 8 and 9 nodes side by side in one surface of Gmsh's, and on its lower curve lines of 2 and of 3 nodes:
-- all are to be read, whatever comes first, and where they share a number.
local check <const> = require "check"

-- Cells [0, 1], [1, 2] and [2, 3] × [0, 1]; below the second one's straight side a parabola of height 1/10, area 1/15.
local nodes <const> = {
  {0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 1}, {1, 1}, {2, 1}, {3, 1},
  {1.5, -0.1}, {2, 0.5}, {1.5, 1}, {1, 0.5}, {2.5, 0}, {3, 0.5}, {2.5, 1}, {2.5, 0.5},
}
-- Gmsh's type, dimension, nodes
local elements <const> = {
  { 3, 2, "1 2 6 5" }, { 16, 2, "2 3 7 6 9 10 11 12" }, { 10, 2, "3 4 8 7 13 14 15 10 16" },
  { 1, 1, "1 2" }, { 8, 1, "2 3 9" }, { 8, 1, "3 4 13" },
}
local names <const> = '$PhysicalNames\n2\n1 2 "bottom"\n2 7 "row"\n$EndPhysicalNames\n'

--- In Gmsh's format 2.2, elements in this order with these numbers.
local function text_22(order, number)
  local lines <const> = { "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" .. names .. "$Nodes\n" .. #nodes }
  for i, x in ipairs(nodes) do lines[#lines + 1] = ("%d %g %g 0"):format(i, x[1], x[2]) end
  lines[#lines + 1] = "$EndNodes\n$Elements\n" .. #elements
  for i, which in ipairs(order) do
    local type <const>, dimension <const>, of <const> = table.unpack(elements[which])
    lines[#lines + 1] = ("%d %d 2 %d 1 %s"):format(number(i), type, dimension == 2 and 7 or 2, of)
  end
  return table.concat(lines, "\n") .. "\n$EndElements\n"
end

--- In Gmsh's format 4.1, each element a block.
local function text_41(order, number)
  local lines <const> = { "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" .. names ..
                          "$Entities\n0 1 1 0\n1 0 0 0 3 0 0 1 2 0\n1 0 0 0 3 1 0 1 7 0\n$EndEntities\n" ..
                          ("$Nodes\n1 %d 1 %d\n2 1 0 %d"):format(#nodes, #nodes, #nodes) }
  for i in ipairs(nodes) do lines[#lines + 1] = i end
  for _, x in ipairs(nodes) do lines[#lines + 1] = ("%g %g 0"):format(x[1], x[2]) end
  lines[#lines + 1] = ("$EndNodes\n$Elements\n%d %d 1 %d"):format(#elements, #elements, #elements)
  for i, which in ipairs(order) do
    local type <const>, dimension <const>, of <const> = table.unpack(elements[which])
    lines[#lines + 1] = ("%d 1 %d 1\n%d %s"):format(dimension, type, number(i), of)
  end
  return table.concat(lines, "\n") .. "\n$EndElements\n"
end

local function write(content)
  local f <const> = assert(io.open("mixed.msh", "w"))
  f:write(content)
  f:close()
end
local function loaded(content, order)
  write(content)
  local m <const> = dotyk.mesh.load("mixed.msh", { order = order })
  os.remove "mixed.msh"
  return m
end

--- The area, the reaction to a unit force per area, and the length of the bottom, that to a unit pressure on it.
local function area_and_length(m)
  local function reaction(force, pressure)
    local body <const> = dotyk.body{ name = "row", mesh = m, material = dotyk.material{ E = 1, nu = 0.3 }, force = {0, -force} }
    local top <const> = body:part("top", function(_, y) return y > 1 - 1e-9 end)
    top:fix()
    if pressure > 0 then body:part "bottom":pressure(pressure) end
    local _ <const>, y <const> = dotyk.solve(dotyk.scene{ body }):reaction(top)
    return math.abs(y)
  end
  return { reaction(1, 0), reaction(0, 1) }
end

local function distinct(i) return i end
local function same() return 3 end
for _, text in ipairs{ text_22, text_41 } do
  for _, order in ipairs{ { 1, 2, 3, 4, 5, 6 }, { 6, 5, 4, 3, 2, 1 }, { 5, 2, 4, 1, 6, 3 } } do
    for _, number in ipairs{ distinct, same } do
      local first <const> = loaded(text(order, number), 1)
      check.equal({ first.element, first.cell_count, first.node_count, first.parts, first.regions, #first.notes }, { "Q1", 3, 8, { "bottom" }, { "row" }, 1 })
      check.near(area_and_length(first), { 3, 3 }, 1e-12)
      local second <const> = loaded(text(order, number), 2)
      check.equal({ second.element, second.cell_count, second.node_count, second.parts, #second.notes }, { "Q2", 3, 21, { "bottom" }, 1 })
      check.near(area_and_length(second), { 3 + 1 / 15, 3 }, 1e-12)
    end
  end
end
