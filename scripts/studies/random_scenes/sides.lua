-- What stands on the ground, leans on walls, is held, loaded or joined in the random scenes of scripts/studies/random_scenes.lua.
-- Loaded by include; returns the function that makes a scene.

local dice, laws, solids = include "dice.lua", include "laws.lua", include "solids.lua"
local g <const> = solids.geometry
local format, say, part = g.format, g.say, g.part

-- 1. Sides that nothing else stands on. Each function adds to the source, and to what the checks know: supports (their parts are
-- asked for reactions), constraints on rigid motions (a direction in which a point cannot move), loads (forces at points).

local function support(scene, body, name, text, law)
  table.insert(scene.supports, { body = body.index, side = name, law = law, name = "p" .. #scene.supports + 1 })
  say(scene, "local p%s = %s%s", tostring(#scene.supports), part(scene, body, name), text)
end

-- No point of the side moves along these directions.
local function constrain(scene, body, name, directions, springs, weak)
  if not springs then body.holding = body.holding or {}; table.insert(body.holding, { side = name, directions = directions }) end
  for _, p in ipairs(g.points_of({ g.side_box(scene, body, name) }, g.corner)) do
    for _, n in ipairs(directions) do table.insert(body.constraints, { x = solids.turn(scene, p.x), n = n, weak = weak }) end
  end
end

local function axes(scene)
  local all = {}
  for k = 1, scene.dimension do
    all[k] = {}
    for i = 1, scene.dimension do all[k][i] = i == k and 1 or 0 end
  end
  return all
end

local act = {}

function act.fix(scene, body, name)
  body.held = body.held + 1
  if scene.angle == 0 and dice.chance(0.3) then
    local k = dice.whole(1, scene.dimension)
    constrain(scene, body, name, { axes(scene)[k] })
    return support(scene, body, name, (":fix %q"):format(("xyz"):sub(k, k)))
  end
  constrain(scene, body, name, axes(scene))
  support(scene, body, name, ":fix()")
end

function act.slide(scene, body, name)
  if body.bend ~= 0 then return act.fix(scene, body, name) end
  body.held = body.held + 1
  constrain(scene, body, name, { solids.turn(scene, g.normal_of(scene, name)) })
  support(scene, body, name, ":slide()")
end

-- Nothing else may hold the body, or stop it on its way: there would be nothing to choose.
function act.displace(scene, body, name)
  if body.held > 0 or body.laws or body.taken.left or body.taken.right then return end
  body.held, body.displaced = 1, true
  local u = scene.size * scene.small * dice.power(-4, -2)
  scene.reach = scene.reach + u
  local components = scene.dimension == 2 and { "x", "y" } or { "x", "y", "z" }
  local direction = { 0, scene.dimension == 2 and -u or 0, -u }
  direction[1] = dice.chance(0.5) and 0 or u * dice.between(-1, 1)
  local items = {}
  for k, v in ipairs(solids.turn(scene, { table.unpack(direction, 1, scene.dimension) })) do items[k] = components[k] .. " = " .. format(v) end
  constrain(scene, body, name, axes(scene))
  support(scene, body, name, (":displace{ %s }"):format(table.concat(items, ", ")))
end

function act.spring(scene, body, name)
  local stiffness = body.E / scene.size * (scene.weak and dice.power(-16, -6) or dice.power(-3, 1))
  local k = format(stiffness)
  table.insert(body.given, { side = name, spring = stiffness })
  body.sprung = true
  if scene.weak then scene.weakest = math.min(scene.weakest or 1, stiffness * scene.size / body.E) end
  constrain(scene, body, name, axes(scene), true, scene.weak)
  support(scene, body, name, (":spring{ x = %s, y = %s%s }"):format(k, k, scene.dimension == 3 and ", z = " .. k or ""))
end

local along <const> = { "prescribed", 1, "elastic", 2, "one_sided_elastic", 3, "unequal_elastic", 1, "signorini", 4, "friction", 1,
                        "one_sided_friction", 1, "capped_elastic", 1, "load", 1 }
local across <const> = { { "prescribed", 1, "elastic", 2, "friction", 3, "capped_elastic", 1, "load", 1 },
                         { "prescribed", 1, "elastic", 2, "friction", 3 } }

function act.law(scene, body, name)
  if body.held > 0 then return end
  body.laws = true
  local stiffness, text, law = body.E / scene.size, {}, {}
  if dice.chance(0.9) then law.normal = laws.random(along, stiffness, scene.stress) end
  if not law.normal or dice.chance(0.4) then law.tangential = laws.random(across[scene.dimension - 1], stiffness, scene.stress) end
  for _, which in ipairs{ "normal", "tangential" } do
    if law[which] then table.insert(text, which .. " = " .. law[which].text) end
    if law[which] and law[which].name == "prescribed" then body.prescribed = true end
  end
  support(scene, body, name, (":support{ %s }"):format(table.concat(text, ", ")), law)
end

-- A traction, in space constant or linear along x.
function act.load(scene, body, name)
  local t, slope = {}, dice.chance(0.3) and dice.between(-1, 1) / scene.size or 0
  for k = 1, scene.dimension do t[k] = scene.stress * dice.between(-1, 1) * (k < scene.dimension and scene.lateral or 1) end
  if dice.chance(0.93) then t[scene.dimension] = -math.abs(t[scene.dimension]) end
  if scene.level then t = solids.turn(scene, t) end
  for _, p in ipairs(g.points_of({ g.side_box(scene, body, name) }, g.gauss)) do
    local x, force = solids.turn(scene, p.x), {}
    for k = 1, scene.dimension do force[k] = p.weight * t[k] * (1 + slope * x[1]) end
    table.insert(body.loads, { x = x, force = force })
  end
  table.insert(body.given, { side = name, traction = { table.unpack(t) }, slope = slope })
  part(scene, body, name)
  if slope == 0 then return say(scene, "%s:part%q:load(%s)", body.name, name, t) end
  for k, v in ipairs(t) do t[k] = ("%s * (1 + %s * x)"):format(format(v), format(slope)) end
  say(scene, "%s:part%q:load(function(x) return %s end)", body.name, name, table.concat(t, ", "))
end

function act.pressure(scene, body, name)
  local value, n = scene.stress * dice.between(-0.2, 1), solids.turn(scene, g.normal_of(scene, name))
  for _, p in ipairs(g.points_of({ g.side_box(scene, body, name) }, g.gauss)) do
    local force = {}
    for k = 1, scene.dimension do force[k] = -p.weight * value * n[k] end
    table.insert(body.loads, { x = solids.turn(scene, p.x), force = force })
  end
  for k = 1, scene.dimension do n[k] = -value * n[k] end
  table.insert(body.given, { side = name, traction = n, slope = 0 })
  part(scene, body, name)
  say(scene, "%s:part%q:pressure(%s)", body.name, name, value)
end

function act.obstacle(scene, body, name)
  if body.displaced then return end
  solids.obstacle(scene, body, name)
  if scene.wide and dice.chance(0.15) then solids.obstacle(scene, body, name, true) end
end

function act.nothing() end

local usual <const> = {
  ground = { "obstacle", 5, "fix", 4, "slide", 0.5, "law", 3, "spring", 2, "nothing", 0.1 },
  bottom = { "nothing", 1 },
  top = { "load", 6, "pressure", 2, "displace", 1.5, "nothing", 2, "law", 0.3, "obstacle", 0.3 },
  lateral = { "nothing", 7, "load", 0.7, "pressure", 0.3, "slide", 1, "fix", 0.6, "law", 0.7, "spring", 0.5, "obstacle", 0.7 },
  disc_ground = { "obstacle", 6, "spring", 1, "law", 1, "nothing", 1 },
  disc = { "nothing", 6, "obstacle", 1, "spring", 2 },
}
-- Sides of a bent body whose extent is not a box's are only held, loaded or left where that needs no more than their nodes.
local bent <const> = { bottom = { "obstacle", 4, "fix", 3, "law", 2 }, front = { "nothing", 1 }, back = { "nothing", 1 } }

local function finish_side(scene, body, name)
  if body.taken[name] then return end
  local ground = name == "bottom" and body.row == 1
  local list = body.disc and (ground and usual.disc_ground or usual.disc) or usual[name] or usual.lateral
  if ground and not body.disc then list = usual.ground end
  if body.bend ~= 0 and (ground or name == "front" or name == "back") then list = bent[name] end
  local what = dice.weighted(list)
  local lateral = name ~= "bottom" and name ~= "top" and not body.disc
  if lateral and body.steady and body.held == 0 and not body.sprung and not body.displaced and what == "nothing" then what = "spring" end
  if (what == "fix" or what == "slide") and (body.overlaps or body.displaced or (body.laws and body.held > 0)) then what = "nothing" end
  if (what == "law" or what == "displace") and (body.overlaps or body.displaced) then what = "nothing" end
  act[what](scene, body, name)
end

-- 2. Bodies in columns

local function columns(scene, count)
  local up, left, rows = scene.dimension, 0, math.max(1, math.ceil(count / dice.pick{ 1, 1, 2, 3 }))
  while #scene.bodies < count do
    local width, top, below = scene.size * dice.between(0.4, 1.5), 0, nil
    local gap_between = dice.chance(0.6) and 0 or scene.size * scene.small * dice.power(-4, -2) * dice.pick{ -1, 1, 1 }
    local column = {}
    for row = 1, math.min(rows, count - #scene.bodies) do
      local gap = row == 1 and 0 or dice.chance(0.6) and 0 or scene.size * scene.small * dice.power(-4, -2) * dice.pick{ -1, 1, 1 }
      local glued = row > 1 and not below.disc and dice.chance(0.12)
      local narrow = dice.chance(0.7) and 0 or width * dice.between(0, 0.3)
      local low, size = { left + narrow, 0 }, { width - 2 * narrow, scene.size * dice.between(0.2, 1), scene.size * dice.between(0.2, 1) }
      if glued then -- all of one side on all of the other
        low[1], size[1] = below.low[1], below.high[1] - below.low[1]
        if up == 3 then size[2] = below.high[2] end
      end
      low[up] = top + (glued and 0 or gap)
      local body = solids.add_body(scene, low, size, glued)
      body.row, body.below, body.glued, body.gap = row, below, glued, gap
      column[row], below, top = body, body, body.high[up]
    end
    table.insert(scene.columns, column)
    column.gap = gap_between
    left = left + width + gap_between
  end
end

local function touch(scene)
  for k, column in ipairs(scene.columns) do
    for row, body in ipairs(column) do
      if body.glued then solids.glue(scene, body, body.below)
      elseif body.below and dice.chance(0.93) then solids.join(scene, body, body.below, "bottom", body.gap) end
      local left = k > 1 and scene.columns[k - 1][row]
      if left and dice.chance(0.5) then
        local up <const> = scene.dimension
        local common <const> = math.min(left.high[up], body.high[up]) - math.max(left.low[up], body.low[up])
        local apart <const> = body.low[1] - left.high[1]
        local faces <const> = not (left.disc or body.disc) -- a disc has no facet across but about its middle, nor far away
          or (math.abs(left.low[up] + left.high[up] - body.low[up] - body.high[up]) < common and apart < 0.5 * common)
        if common > 0.1 * scene.size * scene.small and faces then solids.join(scene, body, left, "left", apart) end
      end
    end
  end
end

-- What is rare: thin bodies, springs so weak that they hold nothing, materials over eight orders, order 2 on turned
-- bodies.
local function widen(scene)
  scene.contrast = dice.pick{ 0.5, 3, 4 }
  if dice.chance(0.15) then scene.thin = dice.power(-3, -1) end
  scene.small = scene.thin or 1
  scene.weak = dice.chance(0.15)
  if scene.element:sub(2) == "2" and scene.angle == 0 and dice.chance(0.4) then scene.angle = dice.between(-1.5, 1.5) end
end

-- Loads in steps, the last often without any. Laws of supports are left out: some have loads of their own.
local function steps(scene)
  for _, support in ipairs(scene.supports) do if support.law then return end end
  if not dice.chance(0.12) then return end
  scene.steps = {}
  for k = 1, dice.whole(1, 3) do scene.steps[k] = dice.pick{ 1, dice.between(0, 1) } end
  table.insert(scene.steps, dice.pick{ 0, 0, 1e-9, 1e-3 })
end

local function random_scene(dimension, wide)
  local scene = { dimension = dimension, lines = {}, bodies = {}, contacts = {}, glues = {}, supports = {}, columns = {},
                  wide = wide, small = 1, reach = 0 }
  scene.angle = dice.chance(0.25) and dice.between(-1.5, 1.5) or 0
  scene.size, scene.E, scene.contrast = dice.chance(0.7) and 1 or dice.power(-3, 3), dice.power(0, 6), dice.chance(0.5) and 0.5 or 3
  scene.stress = scene.E * dice.power(-4, -2)
  scene.lateral = dice.pick{ 0, 0, 0.1, 1 } -- loads along other axes than the last, as a part of those
  scene.level = dice.chance(0.8) -- are loads turned with the scene?
  scene.friction = dice.weighted{ "none", 4, "tresca", 3, "coulomb", 4 }
  scene.element = dice.pick{ "P1", "Q1", "P2", "Q2" }
  if wide then widen(scene) end
  if scene.angle ~= 0 then solids.say_turn(scene) end
  columns(scene, dice.weighted(dimension == 2 and { 1, 4, 2, 5, 3, 3, 4, 2, 5, 1, 6, 1 } or { 1, 4, 2, 3, 3, 1 }))
  local names = {}
  for k, body in ipairs(scene.bodies) do names[k] = body.name end
  say(scene, "local scene = dotyk.scene{ %s }", table.concat(names, ", "))
  touch(scene)
  for _, body in ipairs(scene.bodies) do
    body.steady = dice.chance(0.75)
    for _, name in ipairs(g.side_names[dimension - 1]) do finish_side(scene, body, name) end
  end
  return scene
end

-- Scenes in which nothing happens are few.
return function(dimension, wide)
  while true do
    local scene = random_scene(dimension, wide)
    if wide then steps(scene) end
    local happens = dice.chance(0.02)
    for _, body in ipairs(scene.bodies) do happens = happens or #body.loads > 0 or body.displaced or body.overlaps end
    if happens then return solids.finish(scene) end
  end
end
