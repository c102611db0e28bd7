-- Random scenes of elastic bodies for scripts/studies/random_scenes.lua: the source of a script that makes one, and what the checks
-- must know of it. Loaded by include; solves nothing itself.
--
-- Bodies stand in columns, from the ground up, perhaps all turned by one angle. What stands on what, or beside it, is in
-- contact, glued or apart; what is left of their sides is held, loaded or free. In the tables below points are those of the
-- unturned scene; axis 1 is x, the last axis is up.

local dice, laws = include "dice.lua", include "laws.lua"
local solids = {}

local function format(value)
  if type(value) == "number" then return ("%.15g"):format(value) end
  local items = {}
  for k, v in ipairs(value) do items[k] = format(v) end
  return "{" .. table.concat(items, ", ") .. "}"
end

local function say(scene, text, ...)
  local values = { ... }
  for k, v in ipairs(values) do if type(v) ~= "string" then values[k] = format(v) end end
  table.insert(scene.lines, (text:format(table.unpack(values))))
end

-- A direction or a point of the turned scene.
function solids.turn(scene, p)
  local c, s, up = math.cos(scene.angle), math.sin(scene.angle), scene.dimension
  if scene.angle == 0 then return { table.unpack(p) } end
  local q = { table.unpack(p) }
  q[1], q[up] = c * p[1] - s * p[up], s * p[1] + c * p[up]
  return q
end

function solids.say_turn(scene)
  local c, s = format(math.cos(scene.angle)), format(math.sin(scene.angle))
  if scene.dimension == 2 then say(scene, "local function turn(x, y) return %s * x - %s * y, %s * x + %s * y end", c, s, s, c)
  else say(scene, "local function turn(x, y, z) return %s * x - %s * z, y, %s * x + %s * z end", c, s, s, c) end
end

local function side_of(scene, name)
  local up = scene.dimension
  local axis = (name == "left" or name == "right") and 1 or (name == "bottom" or name == "top") and up or 2
  return axis, (name == "left" or name == "bottom" or name == "front") and -1 or 1
end
local side_names = { { "left", "right", "bottom", "top" }, { "left", "right", "front", "back", "bottom", "top" } }

local function normal_of(scene, name)
  local axis, sign = side_of(scene, name)
  local n = scene.dimension == 2 and { 0, 0 } or { 0, 0, 0 }
  n[axis] = sign
  return n
end

-- The box that a side of a body fills, of no extent along one axis. A bent underside leaves the ends of left and right higher.
local function side_box(scene, body, name)
  local axis, sign = side_of(scene, name)
  local low <const>, high <const> = { table.unpack(body.low) }, { table.unpack(body.high) }
  if sign < 0 then high[axis] = low[axis] else low[axis] = high[axis] end
  if axis == 1 and body.bend > 0 then low[scene.dimension] = low[scene.dimension] + body.bend end
  return low, high
end

-- Points and weights by which functions of degree 3 are integrated over a box, and the corners of the box.
local gauss <const>, corner <const> = { 0.5 - 0.5 / 3 ^ 0.5, 0.5 + 0.5 / 3 ^ 0.5 }, { 0, 1 }
local function points_of(box, places)
  local low <const>, high <const> = box[1], box[2]
  local points = { { x = {}, weight = 1 } }
  for axis = 1, #low do
    local length, next_points = high[axis] - low[axis], {}
    for _, p in ipairs(points) do
      for _, s in ipairs(length > 0 and places or { 0 }) do
        local x = { table.unpack(p.x) }
        x[axis] = low[axis] + s * length
        table.insert(next_points, { x = x, weight = p.weight * (length > 0 and length / #places or 1) })
      end
    end
    points = next_points
  end
  return points
end

-- 1. Bodies

local function load_point(scene, body, x, force)
  table.insert(body.loads, { x = solids.turn(scene, x), force = force })
end

-- A force per volume, where the body's volume and its centre are known.
local function body_force(scene, body)
  if body.bend ~= 0 or not dice.chance(body.disc and 0.8 or 0.35) then return "" end
  local force, centre, volume = {}, {}, 1
  for axis = 1, scene.dimension do
    force[axis] = scene.stress * dice.between(-1, 1) * (axis == scene.dimension and 1 or 0.3 * scene.lateral)
    centre[axis] = (body.low[axis] + body.high[axis]) / 2
    volume = volume * (body.high[axis] - body.low[axis])
  end
  if dice.chance(0.93) then force[scene.dimension] = -math.abs(force[scene.dimension]) end
  if scene.level then force = solids.turn(scene, force) end
  body.force = force
  if body.disc then -- a regular polygon, of order 2 with an arc of a parabola on each edge
    local straight, R = body.element:sub(2) == "1", (body.high[1] - body.low[1]) / 2
    local half = math.pi / body.edges
    volume = body.edges * R^2 * math.sin(half) * (math.cos(half) + (straight and 0 or 4 / 3 * (1 - math.cos(half))))
  end
  local total = {}
  for axis = 1, scene.dimension do total[axis] = volume * force[axis] end
  load_point(scene, body, centre, total)
  return (", force = %s"):format(format(force))
end

local function grading(scene, body)
  if not dice.chance(0.2) then return "" end
  local axis, power = dice.pick{ "x", scene.dimension == 2 and "y" or "z" }, dice.between(1, 3)
  body.grading = { axis = axis == "x" and 1 or scene.dimension, power = power }
  return (", grading = { %s = function(s) return s^%s end }"):format(axis, format(power))
end

local function add_disc(scene, body)
  local R = (body.high[1] - body.low[1]) / 2
  local n = dice.whole(body.element == "Q1" and 3 or 2, body.element:sub(2) == "1" and 4 or 2)
  body.rings = n
  body.edges = (body.element:sub(1, 1) == "P" and 6 or 4) * n
  local centre = solids.turn(scene, { body.low[1] + R, body.low[2] + R })
  say(scene, "local %s = dotyk.body{ name = %q, material = %s, mesh = dotyk.mesh.disc{ center = %s, radius = %s, cells = %d, element = %q }%s }",
      body.name, body.name, body.material, centre, R, ("%d"):format(n), body.element, body_force(scene, body))
end

local function add_box(scene, body)
  local cells = {}
  for axis = 1, scene.dimension do
    cells[axis] = dice.whole(1, scene.dimension == 3 and (body.element:sub(2) == "1" and 3 or 2) or body.element:sub(2) == "1" and 6 or 3)
    if body.thin then cells[axis] = axis == scene.dimension and dice.whole(1, 2) or cells[axis] * (scene.dimension == 2 and 3 or 1) end
  end
  body.cells = cells
  local transform = ""
  if body.bend ~= 0 then
    local up, x = scene.dimension, scene.dimension == 2 and "x, y" or "x, y, z"
    local middle, half = (body.low[1] + body.high[1]) / 2, (body.high[1] - body.low[1]) / 2
    transform = (":transform(function(%s) return %s + %s * (((x - %s) / %s)^2 - %d) * (%s - %s) / %s end)"):format(x, x, format(body.bend),
      format(middle), format(half), body.bend < 0 and 1 or 0, format(body.high[up]), up == 2 and "y" or "z", format(body.high[up] - body.low[up]))
  end
  if scene.angle ~= 0 then transform = transform .. ":transform(turn)" end
  say(scene, "local %s = dotyk.body{ name = %q, material = %s, mesh = dotyk.mesh.%s{ from = %s, to = %s, cells = %s, element = %q%s }%s%s }",
      body.name, body.name, body.material, scene.dimension == 2 and "rectangle" or "box", body.low, body.high, cells, body.element,
      grading(scene, body), transform, body_force(scene, body))
end

local function material(scene, body)
  local E, nu = scene.E * dice.power(-scene.contrast, scene.contrast), dice.between(0, 0.45)
  local stress = scene.dimension == 2 and dice.chance(0.3)
  body.E, body.nu, body.plane = E, nu, stress and "stress" or "strain"
  body.material = ("dotyk.material{ E = %s, nu = %s%s }"):format(format(E), format(nu), stress and ', plane = "stress"' or "")
end

-- A body on the ground or on another; `low` its lower left corner, `size` the room that it has; one to be glued has a plane underside.
local function add_body(scene, low, size, glued)
  local body = { name = "b" .. #scene.bodies + 1, low = low, high = {}, loads = {}, given = {}, constraints = {}, supports = {}, taken = {}, bend = 0, held = 0 }
  body.index = #scene.bodies + 1
  material(scene, body)
  body.element = dice.chance(0.6) and scene.element or dice.pick{ "P1", "Q1", "P2", "Q2" }
  body.disc = scene.dimension == 2 and not glued and dice.chance(0.15)
  for axis = 1, scene.dimension do body.high[axis] = low[axis] + size[body.disc and 1 or axis] end
  if scene.thin and not body.disc and dice.chance(0.7) then
    body.high[scene.dimension] = low[scene.dimension] + scene.thin * (body.high[1] - low[1])
    body.thin = true
  end
  if not body.disc and not glued and dice.chance((scene.wide and body.element:sub(2) == "2") and 0.3 or 0.12) then
    body.bend = (body.high[scene.dimension] - low[scene.dimension]) * dice.sign() * dice.power(-3, -0.7)
  end
  table.insert(scene.bodies, body)
  if body.disc then add_disc(scene, body) else add_box(scene, body) end
  return body
end

-- The part of a body that faces along an axis, as source; of a disc its facets there.
local function part(scene, body, name)
  body.taken[name] = true
  if not body.disc then return ("%s:part%q"):format(body.name, name) end
  local n = solids.turn(scene, normal_of(scene, name))
  return ("%s:part(%q, function(x, y, nx, ny) return %s * nx + %s * ny > 0.2 end)"):format(body.name, name, format(n[1]), format(n[2]))
end

-- 2. What joins them

local function friction(scene)
  local kind = scene.friction
  if kind == "none" or dice.chance(0.25) then return nil, "" end
  local value = kind == "coulomb" and dice.between(0, dice.pick{ 0.3, 1, 3 }) or scene.stress * dice.power(-2, 1)
  if dice.chance(0.05) then value = kind == "tresca" and dice.chance(0.7) and math.huge or 0 end
  return { kind = kind, value = value }, (", friction = dotyk.friction.%s(%s)"):format(kind, value == math.huge and "math.huge" or format(value))
end

local function add_contact(scene, text, contact)
  local law, friction_text = friction(scene)
  contact.friction = law
  table.insert(scene.contacts, contact)
  contact.name = "c" .. #scene.contacts
  scene.coulomb = scene.coulomb or (law and law.kind == "coulomb" and law.value > 0)
  say(scene, "local %s = scene:contact{ %s%s%s }", contact.name, text, friction_text, contact.overlap and ", interference = true" or "")
end

-- Contact of two bodies whose sides face each other.
local function join(scene, one, other, one_side, gap)
  local opposite = { left = "right", bottom = "top" }
  local a, b = { body = one, side = one_side }, { body = other, side = opposite[one_side] }
  if dice.chance(0.5) then a, b = b, a end
  -- Does b's side cover all of a's? Else no node of a may have a foot on it, or of order 2 no facet feet of all its nodes.
  local covered = not b.body.disc and b.body.bend == 0 and not ((a.body.disc or a.body.bend ~= 0) and a.body.element:sub(2) == "2")
  for axis = 1, scene.dimension do
    local along = axis ~= side_of(scene, one_side)
    if along and (a.body.low[axis] < b.body.low[axis] or a.body.high[axis] > b.body.high[axis]) then covered = false end
  end
  local overlap = gap < -1e-9 * scene.size
  one.overlaps, other.overlaps = one.overlaps or overlap, other.overlaps or overlap
  local text = part(scene, a.body, a.side) .. ", " .. part(scene, b.body, b.side)
  local pairing = dice.weighted{ "", 6, "mortar", 2, covered and "node_to_segment" or "", 2 }
  if pairing ~= "" then text = text .. (", pairing = %q"):format(pairing) end
  if dice.chance(0.1) then
    local more = scene.size * scene.small * dice.power(-4, -2)
    scene.reach, text = scene.reach + more, text .. ", gap = " .. format(more)
  end
  scene.reach = scene.reach + math.abs(gap)
  add_contact(scene, text, { first = a, second = b, overlap = overlap, inside = overlap, curved = one.disc or other.disc or one.bend ~= 0 })
end

-- `another`: beside one of the same part.
local function obstacle(scene, body, name, another)
  local n = solids.turn(scene, normal_of(scene, name))
  local gap = not another and dice.chance(0.5) and 0 or scene.size * scene.small * dice.power(-4, -1.3) * (body.held == 0 and dice.chance(0.2) and -1 or 1)
  local against, inwards, centre, axis, sign = {}, {}, {}, side_of(scene, name)
  for k = 1, scene.dimension do
    centre[k] = k == axis and (sign > 0 and body.high[k] or body.low[k]) + sign * gap or (body.low[k] + body.high[k]) / 2
    inwards[k] = -n[k]
  end
  scene.reach = scene.reach + math.abs(gap)
  local kind = body.disc and "plane" or dice.weighted{ "plane", 6, "gap", 2, "ball", 2 }
  body.overlaps = body.overlaps or gap < 0
  local overlap = gap < 0
  if kind == "plane" then
    against = ("dotyk.rigid.plane{ point = %s, normal = %s }"):format(format(solids.turn(scene, centre)), format(inwards))
  elseif kind == "gap" then
    against, overlap = ("dotyk.rigid.gap{ normal = %s, gap = %s }"):format(format(n), format(gap)), false
  else
    local R = scene.size * dice.power(0, 1)
    centre[axis] = centre[axis] + sign * R
    against = ("dotyk.rigid.ball{ center = %s, radius = %s }"):format(format(solids.turn(scene, centre)), format(R))
  end
  add_contact(scene, part(scene, body, name) .. ", rigid = " .. against,
    { first = { body = body, side = name }, overlap = overlap, inside = gap < 0, ball = kind == "ball", curved = body.disc or body.bend ~= 0 })
end

local function glue(scene, one, other)
  say(scene, "scene:glue{ %s, %s }", part(scene, one, "bottom"), part(scene, other, "top"))
  local tie = { one = one.index, other = other.index, points = {} }
  for _, p in ipairs(points_of({ side_box(scene, one, "bottom") }, corner)) do table.insert(tie.points, solids.turn(scene, p.x)) end
  table.insert(scene.glues, tie)
end

-- Do supports hold the normal displacement of a side at x, so that there is no condition and no friction?
local function rests(scene, where, x)
  local normal = solids.turn(scene, normal_of(scene, where.side))
  for _, held in ipairs(where.body.holding or {}) do
    local n, p = solids.turn(scene, normal_of(scene, held.side)), solids.turn(scene, (side_box(scene, where.body, held.side)))
    local distance, along = 0, 0
    for k in ipairs(x) do
      distance = distance + n[k] * (x[k] - p[k])
      along = along + held.directions[1][k] * normal[k]
    end
    if math.abs(distance) < 1e-9 * scene.size and (#held.directions > 1 or math.abs(along) > 1 - 1e-9) then return true end
  end
  return false
end

-- Is the point x on a side of a body, which a bend may have moved?
function solids.on(scene, x, body, side)
  local n, p, distance = solids.turn(scene, normal_of(scene, side)), solids.turn(scene, (side_box(scene, body, side))), 0
  for k in ipairs(x) do distance = distance + n[k] * (x[k] - p[k]) end
  return math.abs(distance) < 1e-4 * scene.size + math.abs(body.bend or 0)
end

-- Is a node's normal that of its side? Given friction then acts also where supports hold the node along it.
local function across(scene, contact, normal)
  local n, along = solids.turn(scene, normal_of(scene, contact.first.side)), 0
  for k, v in ipairs(normal) do along = along + v * n[k] end
  return math.abs(along) > 1 - 1e-9
end

-- What checks ask of the geometry of a scene that is whole.
function solids.finish(scene)
  local up = scene.dimension
  scene.turn = function(x) return solids.turn(scene, x) end
  scene.plane = function(body, side) return { normal = scene.turn(normal_of(scene, side)), point = scene.turn((side_box(scene, body, side))) } end
  scene.extent, scene.stiffest = scene.size, 0
  for _, body in ipairs(scene.bodies) do
    scene.stiffest, scene.bent = math.max(scene.stiffest, body.E), scene.bent or body.bend ~= 0
    for k = 1, up do scene.extent = math.max(scene.extent, math.abs(body.high[k]), math.abs(body.low[k])) end
  end
  -- On curved parts conditions are means of places beside the node: what they measure of rigid motions is asked for (probe.lua) where
  -- contacts have them. Of supports by laws it is not told exactly.
  for _, contact in ipairs(scene.contacts) do
    scene.curved_parts = scene.curved_parts or contact.curved or contact.ball
    scene.curved = scene.curved or (contact.curved and (contact.second or contact.first.body.element:sub(2) == "2"))
  end
  for _, support in ipairs(scene.supports) do
    local body = scene.bodies[support.body]
    scene.inexact = scene.inexact or (support.law and body.element:sub(2) == "2" and (body.disc or body.bend ~= 0))
  end
  scene.across = function(contact, normal) return across(scene, contact, normal) end
  scene.rests = function(contact, x) return rests(scene, contact.first, x) and (not contact.second or rests(scene, contact.second, x)) end
  -- The middle of a body and, where it is a box, places next to its sides to the left and right.
  scene.samples = function(body)
    local points = {}
    for _, s in ipairs(body.disc and { 0.5 } or { 0.01, 0.5, 0.99 }) do
      local x = {}
      for k = 1, up do x[k] = body.low[k] + (k == 1 and s or 0.5) * (body.high[k] - body.low[k]) end
      table.insert(points, scene.turn(x))
    end
    return points
  end
  return scene
end

solids.geometry = { format = format, say = say, side_of = side_of, side_box = side_box, normal_of = normal_of, points_of = points_of,
                 gauss = gauss, corner = corner, part = part, load_point = load_point, side_names = side_names }
solids.join, solids.obstacle, solids.glue, solids.add_body = join, obstacle, glue, add_body
return solids
