-- Random scenes in which what is prescribed at a corner contradicts itself, or just does not: displacements, slides and
-- walls that meet at the nodes of an edge, two bodies prescribed into each other. And what a refusal says of
-- contradictions in other scenes. Loaded by include.
--
-- A scene here says whether it is possible: its conditions at one point are a few equations n·u = b and inequalities n·u
-- <= b. Nodes of order 2 have contact conditions in the mean only, so that there all conditions are of one side, or
-- equations.

local dice <const>, solids <const> = include "dice.lua", include "solids.lua"
local g <const> = solids.geometry
local format <const>, say <const> = g.format, g.say
local contradictions <const> = {}

-- How far the best point is from all conditions: the root of the sum of squares of what is violated. Of each choice of
-- inequalities that count as equations the least squares are solved; the best of these is the best of all.
local function least_squares(rows, d)
  local M, r = {}, {}
  for i = 1, d do
    M[i], r[i] = {}, 0
    for k = 1, d do M[i][k] = i == k and 1e-13 or 0 end
  end
  for _, row in ipairs(rows) do
    for i = 1, d do
      r[i] = r[i] + row.n[i] * row.b
      for k = 1, d do M[i][k] = M[i][k] + row.n[i] * row.n[k] end
    end
  end
  for i = 1, d do -- M is positive definite
    for j = i + 1, d do
      local f = M[j][i] / M[i][i]
      for k = i, d do M[j][k] = M[j][k] - f * M[i][k] end
      r[j] = r[j] - f * r[i]
    end
  end
  local u = {}
  for i = d, 1, -1 do
    u[i] = r[i]
    for k = i + 1, d do u[i] = u[i] - M[i][k] * u[k] end
    u[i] = u[i] / M[i][i]
  end
  return u
end

local function violation(equations, inequalities, d)
  local best = math.huge
  for choice = 0, 2 ^ #inequalities - 1 do
    local rows, sum = { table.unpack(equations) }, 0
    for k, row in ipairs(inequalities) do if choice // 2 ^ (k - 1) % 2 == 1 then table.insert(rows, row) end end
    local u = least_squares(rows, d)
    local function off(row)
      local v = -row.b
      for k, n in ipairs(row.n) do v = v + n * u[k] end
      return v
    end
    for _, row in ipairs(equations) do sum = sum + off(row) ^ 2 end
    for _, row in ipairs(inequalities) do sum = sum + math.max(0, off(row)) ^ 2 end
    best = math.min(best, sum ^ 0.5)
  end
  return best
end

local function axis(k, d) local n = d == 2 and { 0, 0 } or { 0, 0, 0 }; n[k] = 1; return n end

local function friction(scene)
  if dice.chance(0.5) then return nil, "" end
  scene.coulomb = true
  local mu = dice.between(0.05, 0.6)
  return { kind = "coulomb", value = mu }, (", friction = dotyk.friction.coulomb(%s)"):format(format(mu))
end

local function hold(scene, body, name, components, text)
  local side <const> = { side = name, directions = components }
  body.holding, body.held = body.holding or {}, 1
  table.insert(body.holding, side)
  table.insert(scene.supports, { body = body.index, side = name, name = "p" .. #scene.supports + 1 })
  say(scene, "local p%s = %s:part%q:%s", tostring(#scene.supports), body.name, name, text)
end

local letters <const> = { "x", "y", "z" }

-- Displacements along some axes, zero (fix) or not.
local function prescribe(scene, body, name, how_many, size)
  local d, items, directions, rows = scene.dimension, {}, {}, {}
  local axes = d == 2 and { 1, 2 } or { 1, 2, 3 }
  for _ = 1, d - how_many do table.remove(axes, dice.whole(1, #axes)) end
  local still <const> = dice.chance(0.4)
  for k, a in ipairs(axes) do
    local v = still and 0 or size * dice.between(-1, 1)
    scene.reach = scene.reach + math.abs(v)
    items[k], directions[k] = ("%s = %s"):format(letters[a], format(v)), axis(a, d)
    rows[k] = { n = directions[k], b = v }
  end
  hold(scene, body, name, directions, ("displace{ %s }"):format(table.concat(items, ", ")))
  return rows
end

local function slide(scene, body, name)
  local n = solids.turn(scene, g.normal_of(scene, name))
  hold(scene, body, name, { n }, "slide()")
  return { n = n, b = 0 }
end

local function wall(scene, body, name, gap)
  local n = solids.turn(scene, g.normal_of(scene, name))
  local law, text = friction(scene)
  local contact <const> = { first = { body = body, side = name }, friction = law, name = "c" .. #scene.contacts + 1 }
  table.insert(scene.contacts, contact)
  scene.reach = scene.reach + math.abs(gap)
  say(scene, "local %s = scene:contact{ %s:part%q, rigid = dotyk.rigid.gap{ normal = %s, gap = %s }%s }", contact.name,
    body.name, name, n, gap, text)
  return { n = n, b = gap }
end

-- One body; conditions meet at the edge of left and bottom, in space perhaps also front.
local function at_an_edge(scene)
  local d <const>, size <const> = scene.dimension, { dice.between(0.5, 2), dice.between(0.5, 2), dice.between(0.5, 2) }
  local body = solids.add_body(scene, d == 2 and { 0, 0 } or { 0, 0, 0 }, size, true)
  say(scene, "local scene = dotyk.scene{ %s }", body.name)
  local depth <const>, equations, inequalities = dice.power(-5, -2), {}, {}
  local order <const> = tonumber(body.element:sub(2))
  for _, row in ipairs(prescribe(scene, body, "left", dice.whole(1, d), depth)) do table.insert(equations, row) end
  local sliding <const> = dice.chance(0.5)
  if sliding then table.insert(equations, slide(scene, body, d == 3 and dice.chance(0.5) and "front" or "bottom")) end
  local function obstacle(name) table.insert(inequalities, wall(scene, body, name, depth * dice.between(-1, 1))) end
  if not (sliding and order == 2) and dice.chance(0.8) then obstacle "left" end
  if order == 1 and not sliding and dice.chance(0.8) then obstacle "bottom" end
  local k <const> = format(body.E * dice.between(0.1, 1))
  table.insert(body.given, { side = "right", spring = tonumber(k) })
  table.insert(scene.supports, { body = body.index, side = "right", name = "p" .. #scene.supports + 1 })
  say(scene, "local p%s = %s:part\"right\":spring{ x = %s, y = %s%s }", tostring(#scene.supports), body.name, k, k,
    d == 3 and ", z = " .. k or "")
  return violation(equations, inequalities, d), depth
end

-- Two bodies, one on the other: their common sides prescribed into each other or apart.
local function between_bodies(scene)
  local d <const>, up <const> = scene.dimension, scene.dimension
  local size <const> = { dice.between(0.5, 2), dice.between(0.3, 1), dice.between(0.3, 1) }
  local low = d == 2 and { 0, 0 } or { 0, 0, 0 }
  local lower = solids.add_body(scene, { table.unpack(low) }, size, true)
  low[up] = lower.high[up]
  local upper = solids.add_body(scene, low, size, true)
  say(scene, "local scene = dotyk.scene{ %s, %s }", lower.name, upper.name)
  local depth <const>, n <const> = dice.power(-5, -2), solids.turn(scene, g.normal_of(scene, "top"))
  local equations, inequalities = {}, {}
  local rows = { prescribe(scene, lower, "top", d, depth), prescribe(scene, upper, "bottom", d, depth) }
  local jump = 0
  for k = 1, d do jump = jump + n[k] * (rows[1][k].b - rows[2][k].b) end
  local law, text = friction(scene)
  scene.contacts[1] = { first = { body = lower, side = "top" }, second = { body = upper, side = "bottom" }, friction = law,
                        name = "c1" }
  say(scene, "local c1 = scene:contact{ %s:part\"top\", %s:part\"bottom\"%s }", lower.name, upper.name, text)
  for k = 1, d do equations[k] = { n = axis(k, d), b = n[k] * jump } end -- the jump along n alone
  table.insert(inequalities, { n = n, b = 0 })
  return violation(equations, inequalities, d), depth
end

-- A scene that is clearly possible, or clearly `impossible`.
function contradictions.random(dimension)
  while true do
    local scene = { dimension = dimension, lines = {}, bodies = {}, contacts = {}, glues = {}, supports = {},
                    wide = true, small = 1, reach = 0, size = 1, E = dice.power(0, 6), contrast = 0.5, friction = "none" }
    scene.angle, scene.stress, scene.lateral = dice.chance(0.7) and dice.between(-1.5, 1.5) or 0, scene.E * 1e-3, 0
    scene.element = dice.pick{ "P1", "Q1", "P2", "Q2" }
    if scene.angle ~= 0 then solids.say_turn(scene) end
    local off, depth = (dice.chance(0.7) and at_an_edge or between_bodies)(scene)
    if (off > 0.01 * depth or off < 1e-9 * depth) and (#scene.contacts > 0 or #scene.supports > 2) then
      scene.impossible = off > 0.01 * depth
      if scene.coulomb then scene.friction = "coulomb" end
      return solids.finish(scene)
    end
  end
end

-- Is the node that a message names on a side that overlaps what it touches, and do laws of supports prescribe where the
-- node is along the normal there? Sides are parallel or perpendicular to one another; on a ball the normal at a node has
-- both directions.
function contradictions.told(scene, message)
  local x, name = {}, message:match "node %d+ of '(.-)'" or message:match "contact of '(.-)'"
  for number in (message:match "at %((.-)%)" or ""):gmatch "[^, ]+" do table.insert(x, tonumber(number)) end
  local function on(body, side) return solids.on(scene, x, body, side) end
  local function prescribed(contact, where)
    for _, support in ipairs(scene.supports) do
      local law = support.law
      if law and support.body == where.body.index and on(where.body, support.side) then
        local normal, tangential = law.normal and law.normal.name == "prescribed", law.tangential and law.tangential.name == "prescribed"
        local parallel = g.side_of(scene, support.side) == g.side_of(scene, where.side)
        if (normal and tangential) or (not contact.ball and (parallel and normal or not parallel and tangential)) then return true end
      end
    end
  end
  local function stuck(contact, where) -- by friction that nothing overcomes, on another side
    for _, other in ipairs(scene.contacts) do
      for _, side in pairs{ other.first, other.second } do
        local huge = other ~= contact and other.friction and other.friction.value == math.huge
        local across <const> = g.side_of(scene, side.side) ~= g.side_of(scene, where.side)
        if huge and across and side.body == where.body and on(side.body, side.side) then return true end
      end
    end
  end
  local function glued(where) -- to a body that supports hold there
    local normal <const> = scene.turn(g.normal_of(scene, where.side))
    for _, tie in ipairs(scene.glues) do
      local other = tie.one == where.body.index and tie.other or tie.other == where.body.index and tie.one
      for _, held in ipairs(other and scene.bodies[other].holding or {}) do
        local along = 0
        for k, n in ipairs(normal) do along = along + n * held.directions[1][k] end
        if on(scene.bodies[other], held.side) and (#held.directions > 1 or math.abs(along) > 1 - 1e-9) then return true end
      end
    end
  end
  for _, contact in ipairs(scene.contacts) do
    for _, where in pairs{ contact.first, contact.second } do
      local named <const> = contact.inside and where.body.name == name and on(where.body, where.side)
      if named and (stuck(contact, where) or prescribed(contact, where) or glued(where)) then return true end
    end
  end
  return false
end

return contradictions
