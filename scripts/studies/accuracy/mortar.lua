-- Contact of parts whose nodes do not match: mortar with dual multipliers, and node to segment.
--
--   ./dotyk scripts/studies/accuracy/mortar.lua [CELLS]
--
-- 1. The patch test: blocks pressed together carry a uniform pressure. Mortar is exact to rounding, in the plane and in
--    space, for every pair of elements; node to segment is not, however fine the meshes.
-- 2. Hertz's line contact: the error of the pressure beside that of matching nodes.
-- Draws images/mortar.png and images/mortar_hertz.png; fails where mortar's patch test misses 1e-11, or where its error in Hertz's
-- contact exceeds that of matching nodes, as fine as its coarser mesh, by more than 10 %.

local finest <const> = tonumber(arg[1]) or 80 -- cells along an edge in Hertz's contact; 40 or more
local hertz <const> = include "../../lib/hertz_blocks.lua"

-- 1. Two blocks of unlike stiffness and n, m cells along an edge, free to widen, under a pressure.
local p <const> = 10
local below <const>, above <const> = dotyk.material{ E = 1000, nu = 0.3 }, dotyk.material{ E = 3000, nu = 0.2 }

local function blocks(dimension, elements, n, m, pairing)
  local function block(name, base, cells, element, material)
    local mesh = dimension == 2
      and dotyk.mesh.rectangle{ from = {0, base}, to = {1, base + 1}, cells = {cells, cells}, element = element }
      or dotyk.mesh.box{ from = {0, 0, base}, to = {1, 1, base + 1}, cells = {cells, cells, cells}, element = element }
    local body = dotyk.body{ name = name, mesh = mesh, material = material }
    body:part"left":slide()
    if dimension == 3 then body:part"front":slide() end
    return body
  end
  local lower, upper = block("lower", 0, m, elements[2], below), block("upper", 1, n, elements[1], above)
  lower:part"bottom":slide()
  upper:part"top":pressure(p)
  local scene = dotyk.scene{ lower, upper }
  local contact = scene:contact{ upper:part"bottom", lower:part"top", pairing = pairing }
  return dotyk.solve(scene), contact, { lower, upper }
end

-- The greatest error of contact pressure and normal stress, relative, and that of action against reaction.
local function departure(dimension, s, contact, bodies)
  local c, worst = s:contact(contact), 0
  for _, node in ipairs(c.nodes) do worst = math.max(worst, math.abs(node.pressure / p - 1)) end
  for index, body in ipairs(bodies) do
    for k = 1, 9 do
      local t = index - 1 + k / 10
      local stress = dimension == 2 and s:stress(body, 0.37, t) or s:stress(body, 0.37, 0.61, t)
      worst = math.max(worst, math.abs((dimension == 2 and stress.yy or stress.zz) / p + 1))
    end
  end
  local floor = { s:reaction(bodies[1]:part"bottom") }
  return worst, math.abs(c.force[dimension] / floor[dimension] - 1)
end

local passed = true
print "patch test: greatest relative error of pressure and stress\n"
print "        elements    cells    mortar   node to segment   action against reaction"
for _, dimension in ipairs{ 2, 3 } do
  for _, elements in ipairs{ { "P1", "P1" }, { "Q1", "Q1" }, { "P1", "Q1" }, { "Q1", "P1" }, { "P2", "P2" }, { "Q2", "Q2" }, { "P2", "Q1" }, { "P1", "Q2" } } do
    for _, cells in ipairs{ { 2, 3 }, { 5, 7 }, { 7, 5 } } do
      local n <const>, m <const> = cells[1], cells[2]
      local mortar, balance = departure(dimension, blocks(dimension, elements, n, m, "mortar"))
      local feet = departure(dimension, blocks(dimension, elements, n, m, "node_to_segment"))
      print(("  %d-D   %s on %s   %3d:%d   %8.1e   %8.3f          %8.1e"):format(dimension, elements[1], elements[2], n, m, mortar, feet, balance))
      passed = passed and mortar < 1e-11 and balance < 1e-11 and ((elements[1] .. elements[2]):find "2" or feet > 0.01) -- nodes of order 2 stand for means
    end
  end
end

-- 2. Hertz. The error jumps with the distance of the contact's edge from the nearest node: root mean squares over nine depths.
local function error_of(n, m, pairing, element)
  local l2, peak, last = 0, 0, nil
  for k = 0, 8 do
    local scene, contact = hertz.scene(n, m, pairing, element, 0.12 * (1 + 0.1 * k))
    last = hertz.compare(dotyk.solve(scene), contact)
    l2, peak = l2 + last.l2^2 / 9, peak + last.peak^2 / 9
  end
  return math.sqrt(l2), math.sqrt(peak), last
end

print "\nHertz's line contact: error of the pressure in L2 and of its peak, in per cent; cells along the edges of the first block and the second\n"
print "  element   cells      matching          mortar            ratio    node to segment"
local chart = { x = {}, matching = {}, mortar = {}, feet = {} }
local shown
for _, element in ipairs{ "P1", "Q1", "P2", "Q2" } do
  for level = finest < 80 and 1 or 2, 0, -1 do
    local n <const> = finest >> level
    local m <const> = 7 * n // 5
    local matching, peak = error_of(n, n, "matching", element)
    for _, cells in ipairs{ { n, n }, { n, m }, { m, n } } do
      local mortar, mortar_peak, mortar_last = error_of(cells[1], cells[2], "mortar", element)
      local feet, feet_peak, feet_last = error_of(cells[1], cells[2], "node_to_segment", element)
      print(("  %s     %4d:%-4d  %6.3f %6.3f    %6.3f %6.3f    %5.2f    %6.3f %6.3f"):format(
        element, cells[1], cells[2], 100 * matching, 100 * peak, 100 * mortar, 100 * mortar_peak, mortar / matching, 100 * feet, 100 * feet_peak))
      -- On P1's triangles a finer first part would let the pressure waver: its multipliers are then the second's.
      passed = passed and mortar < 1.1 * matching
      if element == "Q1" and cells[1] < cells[2] then
        local i = #chart.x + 1
        chart.x[i], chart.matching[i], chart.mortar[i], chart.feet[i] = n, 100 * matching, 100 * mortar, 100 * feet
        shown = { mortar = mortar_last, feet = feet_last }
      end
    end
  end
end

-- 3. Figures.
local function series(name, nodes, length, scale)
  local x, y = {}, {}
  for _, node in ipairs(nodes) do
    if node.x < 1.3 * length then x[#x + 1], y[#y + 1] = node.x / length, node.pressure / scale end
  end
  return { name = name, x = x, y = y }
end
local hx, hy = {}, {}
for i = 0, 100 do hx[#hx + 1], hy[#hy + 1] = i / 100, math.sqrt(1 - (i / 100)^2) end
local flat, flat_contact = blocks(2, { "Q1", "Q1" }, 7, 5, "mortar")
local uneven, uneven_contact = blocks(2, { "Q1", "Q1" }, 7, 5, "node_to_segment")
dotyk.chart{ file = "images/mortar.png", columns = 3, size = { 2100, 800 }, panels = {
  { title = "Patch test, 7 edges on 5", x = "x", y = "pressure / exact",
    series = { series("mortar", flat:contact(flat_contact).nodes, 1, p),
               series("node to segment", uneven:contact(uneven_contact).nodes, 1, p) } },
  { title = ("Hertz, %d cells on %d"):format(finest, 7 * finest // 5), x = "x / half width", y = "pressure / Hertz's peak",
    series = { { name = "Hertz", x = hx, y = hy, reference = true }, series("mortar", shown.mortar.nodes, shown.mortar.a, shown.mortar.p0),
               series("node to segment", shown.feet.nodes, shown.feet.a, shown.feet.p0) } },
  { title = "Hertz, 5 cells on 7", x = "cells along an edge", y = "error in L² [%]", log = "xy",
    series = { { name = "mortar", x = chart.x, y = chart.mortar }, { name = "node to segment", x = chart.x, y = chart.feet },
               { name = "matching nodes", x = chart.x, y = chart.matching } } } } }
local scene <const> = hertz.scene(40, 56, "mortar", "Q1", 0.2)
dotyk.solve(scene):render{ file = "images/mortar_hertz.png", field = "von_mises", units = { length = "mm", stress = "MPa" }, deform = 1, edges = true, window = {0, -7, 9, 4} }
print "\nimages/mortar.png, images/mortar_hertz.png"
print(passed and "mortar passes the patch test, and is as accurate as matching nodes" or "FAILED")
if not passed then os.exit(1) end
