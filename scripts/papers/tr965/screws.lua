-- Magnetic screws placed wrong on purpose: where they go, and what they cost.
--
--   ./dotyk scripts/papers/tr965/screws.lua [CELLS]
--
-- The semicoercive cases of TR965 1.2.2 in the plane and in space: the lower body is fixed, the upper one is
-- held by contact and by one side that slides along the wall. A screw is a contact node taken as closed; as
-- many as there are rigid motions that contact notices hold the body (lemmas 1.10 to 1.12). A plane contact
-- does not notice the translation in it, nor a cylindrical one the turn about its axis: there two screws and
-- one linear condition take the place of three (remark 1.6, whose determinant is watched; it is small, not
-- zero, where the contact is almost a cylinder, as that of its facets is). The load opens one side of the contact and the screws start
-- there: they pull, move to nodes that press, the nearest first as the rigid motions see it (along the lines
-- of a cylinder all are alike), and end at the solution of the exact kernel.
-- Prints a table and draws images/screws.png.

local n <const> = tonumber(arg[1]) or 8

-- 1. The cases: the contact surface x_d = bend(x1, x2), the points where the screws start.
local function flat() return 0 end
local function bowl(x) return 0.3 * (x - 0.4)^2 end
local function groove(x, y) return math.abs(x - 0.5) * (0.6 + 0.1 * y) end
local function cylinder(x) return 2 - math.sqrt(4 - (x - 0.5)^2) end -- its axis x1 = 1/2, x3 = 2
local function almost(x, y) return cylinder(x) + 0.01 * math.sin(3 * x + 1) end
local cases <const> = {
  { name = "plane, flat", dim = 2, bend = flat, starts = { { {0.9} }, { {1} } } },
  { name = "plane, curved", dim = 2, bend = bowl, starts = { { {0.9} }, { {1} } } },
  { name = "space, planar contact", dim = 3, bend = flat, starts = { { {0, 1}, {1, 0.9} }, { {0.5, 1}, {1, 0.8} } } },
  { name = "space, a groove", dim = 3, bend = groove, starts = { { {0.2, 1}, {0.8, 1}, {1, 0.8} }, { {0, 0.8}, {0.4, 1}, {1, 1} } } },
  { name = "space, a cylinder's facets", dim = 3, bend = cylinder, starts = { { {0, 1}, {1, 1}, {0.6, 0.8} }, { {0, 0.8}, {0.4, 1}, {1, 1} } } },
  { name = "space, almost a cylinder", dim = 3, bend = almost, starts = { { {0.2, 1}, {0.8, 1}, {1, 0.8} }, { {0, 0.8}, {0.4, 1}, {1, 1} } } },
}

-- 2. Two bodies with the same bent surface between them, pressed from above and lifted at one side.
local function two_bodies(case)
  local d <const>, cells <const> = case.dim, n
  local function body(name, bottom, E)
    local mesh = d == 2 and dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2 * cells, 2 * cells}, element = "Q1" }
                         or dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {cells, cells, cells}, element = "Q1" }
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3 }, mesh = mesh:transform(function(x, y, z)
      if d == 2 then return x, y + bottom + case.bend(x) end
      return x, y, z + bottom + case.bend(x, y)
    end) }
  end
  local lower, upper = body("lower", -1, 200), body("upper", 0, 700)
  lower:part"bottom":fix()
  upper:part(d == 2 and "left" or "front"):slide() -- in space the body may still move and turn in the x1 x3 plane
  local away = d == 2 and "right" or "back" -- the side opposite to the one that slides
  if d == 2 then upper:part"top":load{ 0, -3 } else upper:part"top":load{ 0, 0, -3 } end
  if d == 2 then upper:part(away):load{ 0, 2 } else upper:part(away):load{ 0, 0, 2 } end
  local scene = dotyk.scene{ lower, upper }
  return scene, scene:contact{ upper:part"bottom", lower:part"top" }, upper
end

local function nearest(nodes, point)
  local best, least = nil, math.huge
  for k, node in ipairs(nodes) do
    local far = (node.x - point[1])^2 + (point[2] and (node.y - point[2])^2 or 0)
    if far < least then best, least = k, far end
  end
  return best
end

local function places(nodes, rows, dim)
  local out = {}
  for k, row in ipairs(rows) do
    local node = nodes[row]
    out[k] = dim == 2 and ("%.2f"):format(node.x) or ("(%.2f, %.2f)"):format(node.x, node.y)
  end
  return table.concat(out, " ")
end

-- 3. Exact kernel against screws.
print "case                       kernel  screws  start                                  open  moves  iterations  regularity  least det  difference"
local worst, moved, drawn = 0, 0, {}
for _, case in ipairs(cases) do
  local scene, contact, upper = two_bodies(case)
  local exact = dotyk.solver.pdas{}:solve(scene)
  local nodes = exact:contact(contact).nodes
  local size = 0 -- of the displacement
  for _, at in ipairs{ 0.1, 0.5, 0.9 } do
    local u = { exact:displacement(upper, at, case.dim == 2 and 0.9 or at, case.dim == 3 and 0.9 or nil) }
    for _, v in ipairs(u) do size = math.max(size, math.abs(v)) end
  end
  local most -- moves
  for _, points in ipairs(case.starts) do
    local rows, open = {}, 0
    for k, point in ipairs(points) do rows[k] = nearest(nodes, point) end
    for _, row in ipairs(rows) do open = open + (nodes[row].status == "open" and 1 or 0) end
    local s = dotyk.solver.pdas{ kernel = "screws", screws = rows }:solve(scene)
    assert(s.converged, s.reason)
    -- The difference: contact forces over the greatest of them, and gaps over the displacement.
    local force, gap, largest = 0, 0, 0
    for k, node in ipairs(s:contact(contact).nodes) do
      force, gap = math.max(force, math.abs(node.force - nodes[k].force)), math.max(gap, math.abs(node.gap - nodes[k].gap))
      largest = math.max(largest, nodes[k].force)
    end
    local difference = math.max(force / largest, gap / size)
    local regular, det = math.huge, math.huge
    for _, placed in ipairs(s.screws) do
      regular, det = math.min(regular, placed.regularity), math.min(det, placed.determinant)
    end
    worst, moved = math.max(worst, difference), moved + s.screw_moves
    print(("%-26s %6d  %6d  %-37s  %d/%d  %5d  %10d  %10.1e  %9.1e  %10.1e"):format(case.name, s.kernel, #rows,
      places(nodes, rows, case.dim), open, #rows, s.screw_moves, s.iterations, regular, det, difference))
    if not most or s.screw_moves > most.screw_moves then most = s end
  end
  if case.dim == 3 then drawn[#drawn + 1] = { case = case, nodes = nodes, screws = most.screws } end
end
print(("greatest difference %.1e; %d moves in all"):format(worst, moved))

-- 4. The figure: the contact seen from above, case by case; every screw from where it was to where it went.
local panels <const> = {}
for k, d in ipairs(drawn) do
  local series = {}
  local function curve(name, options)
    local it = { name = k <= 2 and name or "", x = {}, y = {}, style = "points" } -- a legend for each column
    for key, value in pairs(options) do it[key] = value end
    series[#series + 1] = it
    return it
  end
  local function add(to, node) to.x[#to.x + 1], to.y[#to.y + 1] = node.x, node.y end
  local open, closed = curve("open", { status = "open" }), curve("closed", { status = "closed" })
  for _, node in ipairs(d.nodes) do add(node.status == "open" and open or closed, node) end
  local first, last = curve("screws, first", {}), curve("screws, at the end", {})
  for m = 1, #d.screws[1].rows do
    add(first, d.nodes[d.screws[1].rows[m]])
    add(last, d.nodes[d.screws[#d.screws].rows[m]])
    local moves, before = curve(m == 1 and "their moves" or "", { style = "line", twin = true }), nil -- in the colour of the screws at the end
    for _, placed in ipairs(d.screws) do
      local node = d.nodes[placed.rows[m]]
      if node ~= before then add(moves, node) end
      before = node
    end
  end
  panels[k] = { title = d.case.name:gsub("space, ", ""):gsub("^%l", string.upper), y = "x₂", series = series,
                x_range = { -0.1, 1.1 }, y_range = { -0.1, 1.1 } }
end
dotyk.chart{ file = "images/screws.png", x = "x₁", panels = panels, columns = 2, size = { 1100, 1150 } }
print "images/screws.png"
if worst > 1e-8 then error "screws end elsewhere than the exact kernel" end
if moved == 0 then error "no screw was placed wrong" end
