-- Maps of contacts in space: lengths, names and numbers of their axes, fields, regions of statuses; what is refused. Reads SVG.
local check <const>, refused <const>, svgs <const> = require "check", require "refused", include "letter_sizes.lua"

-- The map of a contact; low and high: its rim across (1) and up (2) in the numbers of the axes.
local colour <const> = { open = "#56b4e9", closed = "#d55e00", stick = "#cc79a7", slip = "#e69f00" }
local function ink(m, width) return #m == 2 and m.stroke == "#1e1e1e" and math.abs(m.width - width) < 0.006 and m or {} end
local function drawn(s, c, o)
  o.file, o.width, o.size, o.map = "maps.svg", 85, o.size or { 400, 300 }, c
  s:render(o)
  local svg <const> = svgs.read "maps.svg"
  svg.text = svg.text:gsub("|", " ")
  for k = 1, 2 do
    local value <const>, scale <const> = svgs.axis(svg, k)
    svg[k] = { low = math.huge, high = -math.huge, value = value, slack = 0.05 / scale } -- pixels are written to a hundredth, those of ticks too
    for _, m in ipairs(svg.marks) do
      for _, p in ipairs(ink(m, math.max(1.2, svg.em / 18))) do svg[k].low, svg[k].high = math.min(svg[k].low, value(p[k])), math.max(svg[k].high, value(p[k])) end
    end
  end
  return svg
end
local function spans(svg, k, low, high, name)
  check.near({ svg[k].low, svg[k].high }, { low, high }, svg[k].slack, name)
  check.that(svg.text:find(" " .. name .. " ", 1, true), "no axis " .. name .. " in " .. svg.text)
end
-- Scenes: surfaces are sides of boxes, transformed.
local material <const>, rough <const>, bottom <const> = dotyk.material{ E = 100, nu = 0.3 }, dotyk.friction.coulomb(0.3), "bottom"
local bodies = 0
local function body(from, to, cells, transform, keep)
  local mesh <const> = dotyk.mesh.box{ from = from, to = to, cells = cells, element = "Q1" }
  bodies = bodies + 1
  return dotyk.body{ name = "body " .. bodies, mesh = (keep and mesh:keep(keep, "hole") or mesh):transform(transform or function(...) return ... end), material = material }
end
local function solved(scene) local s <const> = dotyk.solve(scene) check.that(s.converged) return s end
-- Squares about 0 onto circles of half their sides.
local function round(u, v)
  local p <const> = math.max(math.abs(u), math.abs(v), 1e-12)
  return u * math.sqrt(1 - (v / p)^2 / 2), v * math.sqrt(1 - (u / p)^2 / 2)
end
-- The map between two layers, 1 to 2 and 2 to 3 along the third coordinate, pressed on each other.
local function joint(low, high, cells, transform)
  local layers <const> = {}
  for r = 1, 2 do layers[r] = body({ low[1], low[2], r }, { high[1], high[2], r + 1 }, { cells[1], cells[2], 1 }, transform) end
  layers[2]:part "top":fix()
  layers[1]:part(bottom):pressure(1)
  local scene <const> = dotyk.scene(layers)
  local contact <const> = scene:contact{ layers[1]:part "top", layers[2]:part(bottom), friction = rough }
  return drawn(solved(scene), contact, { field = "status", units = { length = "mm" } })
end

-- 1. Flat and inclined by 30°: true lengths. A cap of radius 2 and half angle 50°: seen along its mean normal, upright or oblique.
local c <const>, s <const>, half <const> = math.cos(math.rad(30)), math.sin(math.rad(30)), math.rad(50)
local svg = joint({ 0, 0 }, { 3, 1 }, { 6, 3 }, function(x, y, z) return c * x + s * z, y, c * z - s * x end)
spans(svg, 1, 0, 1, "y [mm]")
check.near(svg[2].high - svg[2].low, 3, 2 * svg[2].slack, "length")
for _, axes in ipairs{ { "x", "y", { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { "s", "t", { 0.5^0.5, -0.5^0.5, 0 }, { 6^-0.5, 6^-0.5, -2 * 6^-0.5 }, { 3^-0.5, 3^-0.5, 3^-0.5 } } } do
  svg = joint({ -1, -1 }, { 1, 1 }, { 8, 8 }, function(u, v, r)
    local x <const>, y <const> = round(u, v)
    local way <const>, p <const> = math.max(math.sqrt(x^2 + y^2), 1e-12), {}
    local out <const>, up <const> = r * math.sin(half * way) / way, r * math.cos(half * way)
    for i = 1, 3 do p[i] = out * x * axes[3][i] + out * y * axes[4][i] + up * axes[5][i] end
    return table.unpack(p)
  end)
  for k = 1, 2 do spans(svg, k, -2 * math.sin(half), 2 * math.sin(half), axes[k] .. " [mm]") end
end
-- 2. A part of a cylinder of radius 2 about y. Up to about a half lengths are those of the chords, of more they are R θ.
for _, case in ipairs{ { 90, 3 }, { 90, 10 }, { 60, 2 }, { 150, 2 } } do
  local angle <const>, long <const>, n <const> = math.rad(case[1]), case[2], 12
  svg = joint({ -1, 0 }, { 1, long }, { n, 2 }, function(u, y, r) return r * math.sin(angle * u), y, r * math.cos(angle * u) end)
  local arc <const>, chords <const> = 2 * angle, 2 * n * math.sin(angle / n)
  local along <const>, expected <const> = 2 * arc > long and 1 or 2, case[1] > 90 and arc or chords
  spans(svg, along, -expected, expected, "arc [mm]") -- the longer direction lies across
  check.near(svg[along].high, arc, arc - chords + svg[along].slack, "R θ")
  spans(svg, 3 - along, 0, long, "y [mm]")
end
-- An open arc is whole, wherever it is pressed: it is cut in its opening.
local function bend(u, y, r) return r * math.sin(math.rad(135) * u), y, r * math.cos(math.rad(135) * u) end
local inner <const>, outer <const> = body({ -1, 0, 1 }, { 1, 3, 2 }, { 24, 2, 1 }, bend), body({ -1, 0, 2 }, { 1, 3, 3 }, { 24, 2, 1 }, bend)
outer:part "top":fix()
inner:part("pressed", function(x, y, z) return x^2 + z^2 < 1.1 and x > 0.7 end):pressure(1)
local bush <const> = dotyk.scene{ inner, outer }
local bore <const> = bush:contact{ inner:part "top", outer:part(bottom), friction = rough }
svg = drawn(solved(bush), bore, { field = "status", units = { length = "mm" } })
spans(svg, 1, -1.5 * math.pi, 1.5 * math.pi, "arc [mm]")
-- 3. A pin in a hole: a closed cylinder is cut once, opposite to its pressure. Small pieces cover the map once.
local n <const>, around <const>, long <const> = 4, 4 * math.pi, 3
local function cylinder(u, v, z) local x <const>, y <const> = round(u, v) return 2 * x, 2 * y, z end
local pin <const> = body({ -1, -1, 0 }, { 1, 1, long }, { n, n, 2 }, cylinder)
local plate <const> = body({ -2, -2, 0 }, { 2, 2, long }, { 2 * n, 2 * n, 2 }, cylinder, function(u, v) return math.max(math.abs(u), math.abs(v)) > 1 end)
for _, side in ipairs{ "left", "right", "front", "back" } do plate:part(side):fix() end
for _, b in ipairs{ pin, plate } do b:part(bottom):slide() end
pin:part "top":load{ -0.5, 0, 0 }
local scene <const> = dotyk.scene{ pin, plate }
local rim <const> = scene:contact{ pin:part("rim", function(_, _, _, _, _, z) return math.abs(z) < 0.5 end), plate:part "hole", friction = rough }
svg = drawn(solved(scene), rim, { field = "status" })
check.near(svg[1].high - svg[1].low, around, 2 * svg[1].slack, "around")
spans(svg, 2, 0, long, "z")
local cut <const>, area, widest, off = svg[1].low, 0, 0, 0
for _, m in ipairs(svg.marks) do
  local x <const>, y <const>, twice = {}, {}, 0
  for k, p in ipairs(m) do x[k], y[k] = svg[1].value(p[1]), svg[2].value(p[2]) end
  if m.kind == "polygon" and #m == 4 and m.fill ~= "none" and y[1] > -0.01 then -- legend samples are below
    for k = 1, 4 do twice = twice + x[k] * y[k % 4 + 1] - x[k % 4 + 1] * y[k] end
    area, widest = area + math.abs(twice) / 2, math.max(widest, math.max(table.unpack(x)) - math.min(table.unpack(x)))
    if m.fill == colour.stick or m.fill == colour.slip then off = math.max(off, math.abs(x[1])) end
  end
end
check.near(area, around * long, 0.01 * around * long, "area") -- corners of pieces are written to a hundredth of a pixel
check.that(widest < 2 * around / (4 * n) and off > 0.1 * around and off < 0.4 * around, "a piece as wide as " .. widest .. ", pressure at " .. off) -- half a facet; facets are not even
-- 4. Flat and level: the scene's coordinates. Markers stand at nodes of their status, each region has one; borders lie half way
-- between nodes of different statuses and nowhere else. Nodes are 0.1 apart.
local function place(x, y) return math.floor(20 * x + 0.5) .. "," .. math.floor(20 * y + 0.5) end
local function statuses(nodes)
  local grid <const>, lines <const>, kinds <const>, shape <const> = {}, {}, {}, { open = "circle", closed = "circle", stick = 4, slip = 3 }
  for _, node in ipairs(nodes) do grid[place(node.x, node.y)] = { x = node.x, y = node.y, status = node.status } end
  for i, m in ipairs(svg.marks) do
    local x, y = 0, 0
    for _, p in ipairs(m) do x, y = x + svg[1].value(p[1]) / #m, y + svg[2].value(p[2]) / #m end
    for status, fill in pairs(y > svg[2].low - svg[2].slack and colour or {}) do -- the legend is below
      if m.fill == fill then
        local node <const>, hole <const> = grid[place(x, y)], svg.marks[i + 1] or {}
        check.that(node and node.status == status and math.abs(node.x - x) + math.abs(node.y - y) < 0.02, status .. " where there is none") -- a triangle's mean is near its centre
        check.equal(m.kind == "circle" and m.kind or #m, shape[status], status)
        if m.kind == "circle" then check.equal(hole.kind == "circle" and hole.fill == "#ffffff" and hole.r < m.r and hole[1][1] == m[1][1] and hole[1][2] == m[1][2], status == "open", status) end
        node.marked, kinds[status] = true, true
      end
    end
    for _, p in ipairs(ink(m, math.max(1.4, svg.em / 11))) do lines[place(svg[1].value(p[1]), svg[2].value(p[2]))] = true end
  end
  local function has_marker(node) -- the region that it is of
    local marked = node.marked
    node.seen = true
    for _, d in ipairs{ { 0.1, 0 }, { -0.1, 0 }, { 0, 0.1 }, { 0, -0.1 } } do
      local other <const> = grid[place(node.x + d[1], node.y + d[2])]
      if other then check.equal(lines[place(node.x + d[1] / 2, node.y + d[2] / 2)] or false, other.status ~= node.status, "border") end
      if other and other.status == node.status and not other.seen then marked = has_marker(other) or marked end
    end
    return marked
  end
  for _, node in pairs(grid) do check.that(node.seen or has_marker(node), "a region without a marker: " .. node.status) end
  return kinds
end
local slab <const> = body({ 2, -1, 0 }, { 5, 0, 1 }, { 30, 10, 2 })
slab:part "top":load{ 0.07, 0, -1 }
local function on_floor(gap, friction)
  local flat <const> = dotyk.scene{ slab }
  local contact <const> = flat:contact{ slab:part(bottom), rigid = dotyk.rigid.gap{ normal = { 0, 0, -1 }, gap = gap }, friction = friction }
  local solution <const> = solved(flat)
  svg = drawn(solution, contact, { size = { 800, 500 } })
  spans(svg, 1, 2, 5, "x")
  spans(svg, 2, -1, 0, "y")
  return solution, contact, statuses(solution:contact(contact).nodes)
end
local function at(x, y, px, py) return math.abs(x - px) + math.abs(y - py) < 0.05 end
local slid <const>, floor <const>, kinds <const> = on_floor(function(x, y) return (x > 4.55 or at(x, y, 3, -0.5)) and 0.5 or 0 end,
  dotyk.friction.coulomb(function(x, y) return at(x, y, 4, -0.3) and 5 or 0.1 end))
check.equal(kinds, { open = true, stick = true, slip = true })
-- 5. The bar tells the field, its unit, its least and greatest value. What is open does not slip: no isoline comes near it.
for field, label in pairs{ pressure = "contact pressure [MPa]", gap = "gap [mm]", slip = "slip [mm]", status = "contact pressure, at most" } do
  svg = drawn(slid, floor, { field = field, units = { length = "mm", stress = "MPa" }, isolines = field == "slip", shear = false })
  check.that(svg.text:find(" " .. label .. " ", 1, true) and (field == "status") == not svg.text:find "max", svg.text)
  local least, greatest, lines = math.huge, -math.huge, 0
  for _, node in ipairs(slid:contact(floor).nodes) do
    local value <const> = field == "slip" and node.status ~= "open" and math.sqrt(node.slip[1]^2 + node.slip[2]^2 + node.slip[3]^2) or tonumber(node[field])
    if value then least, greatest = math.min(least, value), math.max(greatest, value) end
  end
  if field ~= "status" then -- numbers have three digits
    check.near(svgs.number(svg.text:match "max (%S+)"), greatest, 0.006 * greatest, field)
    check.near(svgs.number(svg.text:match "min (%S+)"), least, math.max(0.006 * math.abs(least), 1e-12), field)
  end
  for _, m in ipairs(svg.marks) do
    for _, p in ipairs((m.stroke == "#373737" or m.stroke == "#e1e1e1") and m or {}) do
      local x <const>, y <const> = svg[1].value(p[1]), svg[2].value(p[2])
      lines = lines + 1
      check.that(x < 4.5 + svg[1].slack and math.max(math.abs(x - 3), math.abs(y + 0.5)) > 0.1 - svg[1].slack, "an isoline of the slip where it is open")
    end
  end
  check.equal(lines > 0, field == "slip", "isolines")
end
-- 6. Without friction: closed and open.
slab:part "left":fix "x"
check.equal(select(3, on_floor(function(x) return x > 3.35 and x < 3.75 and 0.5 or 0 end)), { open = true, closed = true })
-- 7. What is refused, at its line: what was given, and what may be.
local flat <const> = dotyk.body{ name = "flat", material = material, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 2, 2 }, element = "P2" } }
flat:part "left":fix "x"
local level <const> = dotyk.scene{ flat }
local line <const> = level:contact{ flat:part(bottom), rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }
local lid <const> = body({ 2, -1, 1 }, { 5, 0, 2 }, { 3, 1, 1 })
local glued <const> = dotyk.scene{ slab, lid }:glue{ lid:part(bottom), slab:part "top" }
local alone <const> = dotyk.scene{ lid }
lid:part "left":fix()
-- A ball in a ball with a cavity: closed, and no cylinder.
local function onto_spheres(x, y, z)
  local p <const> = math.max(math.abs(x), math.abs(y), math.abs(z)) / math.max(math.sqrt(x^2 + y^2 + z^2), 1e-12)
  return p * x, p * y, p * z
end
local ball <const>, shell <const> = body({ -1, -1, -1 }, { 1, 1, 1 }, { 2, 2, 2 }, onto_spheres),
  body({ -2, -2, -2 }, { 2, 2, 2 }, { 4, 4, 4 }, onto_spheres, function(x, y, z) return math.max(math.abs(x), math.abs(y), math.abs(z)) > 1 end)
local whole <const> = ball:part("whole", function() return true end)
whole:pressure(1)
shell:part("outside", function(x, y, z) return x^2 + y^2 + z^2 > 3 end):fix()
local round_scene <const> = dotyk.scene{ ball, shell }
local round_all <const> = round_scene:contact{ whole, shell:part "hole", friction = rough }
local many <const> = {}
for k = 1, 300 do many[k] = { at = { 0.5, 0.5 }, text = "a note of some length" } end
local note <const>, two <const>, three <const> = { { at = { 0, 0, 0 }, text = "here" } }, solved(level), slid
for _, case in ipairs{
  { two, { map = line }, "'map' is for contacts in space", "2-D" }, { three, { map = glued }, "'map' is for contacts", "glue" },
  { two, { cut = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } }, "'cut' is for scenes in space", "2-D" },
  { three, { cut = { point = { 0, 0, 0 }, normal = { 0, 0, 0 } } }, "'normal' of 'cut' is zero", "must have a direction" },
  { two, { window = { 0, 0, 1 } }, "window has 3 numbers", "{x0, y0, x1, y1}" }, { three, { map = floor, window = { 0, 0, 0, 1, 1, 1 } }, "window has 6 numbers", "{x0, y0, x1, y1}" },
  { three, { window = { 0, 0, 1, 1 } }, "window has 4 numbers", "{x0, y0, z0, x1, y1, z1}" },
  { three, { map = floor, view = { 1, 0, 0 } }, "'view' is for scenes in space", "2-D" }, { three, { zoom = { 0, 0, 1, 1 } }, "'zoom' is for the plane and for maps", "in space" },
  { two, { zoom = { 0, 0, 1, 1 }, window = { 0, 0, 1, 1 } }, "'zoom' and 'window' are given" }, { three, { isolines = true }, "'isolines' are for the plane and for maps", "in space" },
  { three, { trajectories = true }, "'trajectories' is for scenes in the plane", "in space" }, { three, { explode = -1 }, "explode is -1", "from 0 to 100" }, { three, { explode = 1e9 }, "from 0 to 100" },
  { two, { notes = note }, "'at' of a note has 3 numbers", "2-D" }, { three, { map = floor, notes = note }, "'at' of a note has 3 numbers", "2-D" },
  { three, { notes = { { at = { 0, 0 }, text = "here" } } }, "'at' of a note has 2 numbers", "3-D" }, { two, { field = "error" }, "'flat' is of P2", "cells of order 1" },
  { three, { map = floor, field = "von_mises" }, '"pressure", "gap", "slip" or "status"', "von_mises" }, { two, { field = "gap" }, "for scenes in space", "2-D", "gap" },
  { two, { zoom = { 1, 1, 0, 0 } }, "zoom", "{x0, y0, x1, y1}" }, { two, { range = { 1, 1 } }, "range of the field", "{least, greatest}" },
  { three, { cut = { point = { 0, 0, 1.5 }, normal = { 1e-200, 0, 0 } } }, "'cut' leaves nothing of the bodies", "lie within {" },
  { three, { window = { 9, 0, 0, 10, 1, 1 } }, "window shows no body", "lie within {" }, { three, { field = "gap", contact = false }, '"gap" is one of contacts', "'contact' false" },
  { solved(alone), { field = "slip" }, '"slip" is one of contacts', "this scene has none" }, { solved(round_scene), { map = round_all }, "closed and not a cylinder" },
  { two, { width = 30 }, "refused.svg has no room", "30 mm wide", "mm wide at least" }, { two, { notes = many }, "no room for the note" } } do
  case[2].file = "refused.svg"
  refused(function() case[1]:render(case[2]) end, "render: ", table.unpack(case, 3))
end
check.that(not io.open "refused.svg")
check.near(cut, -around / 2, 0.01, "nodes lie opposite to the pressure, where the cut is")
os.remove "maps.svg"
