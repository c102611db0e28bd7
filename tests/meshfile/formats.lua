-- Every version, encoding and order of Gmsh's format gives the same body: [0, 2] × [0, 1] (× [1/4, 5/4]) in two regions.
-- A patch test with contact says whether its cells, parts and coordinates are right: pressed onto a rigid floor it has
-- uniform stress, which elements of either order represent exactly.
local check <const> = require "check"
local folder <const> = debug.getinfo(1, "S").source:match "^@(.*)/" .. "/files/"

local E <const>, nu <const>, p <const> = 3, 0.3, 0.06
local material <const> = dotyk.material{ E = E, nu = nu }

local function pressed(m)
  local body <const> = dotyk.body{ name = "body", mesh = m, material = material }
  local scene <const> = dotyk.scene{ body }
  if m.dimension == 2 then
    scene:contact{ body:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
    body:part "left":slide()
  else
    scene:contact{ body:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0, 0.25}, normal = {0, 0, 1} } }
    body:part "77":slide()
    body:part("front", function(x, y) return y < 1e-9 end):slide()
  end
  body:part "top":pressure(p)
  return dotyk.solve(scene), body
end

local function patch(m, about)
  local s <const>, body <const> = pressed(m)
  check.that(s.converged, about)
  if m.dimension == 2 then
    local ux <const>, uy <const> = s:displacement(body, 1.3, 0.7)
    check.near({ ux, uy }, { 1.3 * p * nu * (1 + nu) / E, -0.7 * p * (1 - nu^2) / E }, 1e-13, about)
  else
    local ux <const>, uy <const>, uz <const> = s:displacement(body, 1.3, 0.7, 0.5)
    check.near({ ux, uy, uz }, { 1.3 * nu * p / E, 0.7 * nu * p / E, -0.25 * p / E }, 1e-13, about)
  end
end

-- dimension, element, nodes and cells of all and of one region
local expected <const> = {
  triangles = { 2, "P1", 15, 16, 9, 8 },
  quadrilaterals = { 2, "Q1", 15, 8, 9, 4 },
  tetrahedra = { 3, "P1", 12, 12, 8, 6 },
  hexahedra = { 3, "Q1", 12, 2, 8, 1 },
}

-- element, nodes of all and of one region: 4 × 2 and 2 × 2 squares and what halves them; 2 cubes and 1. Tetrahedra of
-- order 2 have as many nodes as corners and edges, 12 + 33 and 8 + 19: 20 edges of the cubes, 11 diagonals of faces and 2 of cubes.
local expected_second <const> = {
  triangles = { "P2", 45, 25 },
  quadrilaterals = { "Q2", 45, 25 },
  tetrahedra = { "P2", 45, 27 },
  hexahedra = { "Q2", 45, 27 },
}

for _, name in ipairs{
  "triangles_22", "triangles_22_binary", "triangles_40", "triangles_41", "triangles_41_binary", "triangles_second_order_41",
  "quadrilaterals_one_half_clockwise_22", "quadrilaterals_second_order_22",
  "tetrahedra_22", "tetrahedra_41_binary", "tetrahedra_second_order_41",
  "hexahedra_22_binary", "hexahedra_41", "hexahedra_second_order_41_binary",
} do
  local m <const> = dotyk.mesh.load(folder .. name .. ".msh")
  local half <const> = dotyk.mesh.load(folder .. name .. ".msh", { region = "left half" })
  check.equal({ m.dimension, m.element, m.node_count, m.cell_count, half.node_count, half.cell_count }, expected[name:match "^%a+"], name)
  check.equal(m.regions, { "left half", "right half" }, name)
  check.equal(m.parts, m.dimension == 2 and { "77", "bottom", "left", "top" } or { "77", "bottom", "top" }, name)
  local order <const> = "its elements are of order 2; only their corners are used, so that curved sides become straight (order = 2 takes them as they are)"
  check.equal(m.notes[1] == order, name:find "second_order" ~= nil, name)
  check.equal(#m:pieces(), 1, name)
  patch(m, name)
  -- A region alone: the part between the two is on its boundary now, that of the other is not.
  check.equal(half.regions, { "left half" }, name)
  check.equal(half.parts, m.dimension == 2 and { "bottom", "left", "middle", "top" } or { "77", "bottom", "top" }, name)
  local both <const> = dotyk.mesh.load(folder .. name .. ".msh", { region = { "right half", "left half" } })
  check.equal({ both.node_count, both.cell_count }, { m.node_count, m.cell_count }, name)

  -- With order = 2 every one of them is of second order: by its own nodes, or with nodes in the middle of what is straight.
  local second <const> = dotyk.mesh.load(folder .. name .. ".msh", { order = 2 })
  local of_second <const> = expected_second[name:match "^%a+"]
  check.equal({ second.element, second.node_count, second.cell_count }, { of_second[1], of_second[2], m.cell_count }, name)
  check.equal(second.parts, m.parts, name)
  local added <const> = "its elements are of order 1; nodes are put in the middle of their straight sides"
  check.equal(second.notes[1] == added, not name:find "second_order", name)
  patch(second, name .. " of order 2")
  local half_of_second <const> = dotyk.mesh.load(folder .. name .. ".msh", { region = "left half", order = 2 })
  check.equal({ half_of_second.parts, half_of_second.node_count, half_of_second.cell_count }, { half.parts, of_second[3], half.cell_count }, name)
end

local plain <const> = dotyk.mesh.load(folder .. "quadrilaterals_without_groups_41.msh")
check.equal(plain.parts, {})
check.equal(plain.regions, {})
check.equal(plain.cell_count, 8)
check.equal(tostring(plain), "mesh: Q1 quadrilaterals, 15 nodes, 8 cells, parts none")
