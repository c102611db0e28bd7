-- Is a state that a method calls converged a solution? Checks of the scenes of scripts/studies/random_scenes.lua from
-- nodal output, from loads integrated there, and from nodal forces of an assembly of its own (nodes.lua). Loaded by
-- include; returns a table of check(scene, made, solution, before), a list of what is wrong, `before` the solution of
-- the step before in a history; and of rounding(scene, made, solution), what rounding leaves of a nodal force, and the
-- greatest force.
--
-- Tolerances. Methods end at a natural residual of 1e-10 of the greatest force and lose some digits where stiffnesses
-- differ by eight orders: forces count as known to 1e-6 of the greatest pressure, displacements to 1e-6 of the greatest
-- one (`accuracy`: a scene that asks for less says so), but never to more than that part of what the data of the scene
-- allow. Displacements count as known to 1e-14 of the size, which is what rounding leaves of a gap across an inclined
-- plane. A node's force is known to 1e-9 of the greatest stress on the scene's section, which may be much as a pressure
-- where the node's share of the area is small. Rounding of large motions is 1e-12 of the forces that strains of their
-- size would make.

local laws <const>, solids <const> = include "laws.lua", include "solids.lua"
local nodes <const> = include "nodes.lua"

local function dot(a, b)
  local sum = 0
  for k, v in ipairs(a) do sum = sum + v * b[k] end
  return sum
end
local function norm(a) return dot(a, a)^0.5 end
local function point(scene, node) return { node.x, node.y, scene.dimension == 3 and node.z or nil } end

-- 1. Scales: the greatest pressure or traction and the greatest displacement, within what the data of the scene allow:
-- gaps, overlaps and prescribed displacements, loads, and these times stiffnesses and flexibilities, of bending where
-- bodies are thin.
local function allowed(scene)
  local d <const>, size <const> = scene.dimension, scene.size
  local flexible, stiff, soft = 0, 0, math.huge
  local load, length = 0, scene.reach + (scene.curved_parts and size or 0)
  local area <const> = size ^ (d - 1) * scene.small
  local function spring(k) if k > 0 then flexible = flexible + 1 / (k * area) end end
  for _, body in ipairs(scene.bodies) do
    local least, most = math.huge, 0
    for axis = 1, d do
      local extent = body.high[axis] - body.low[axis]
      least, most = math.min(least, extent), math.max(most, extent)
    end
    flexible = flexible + (most / least) ^ 3 / (body.E * least ^ (d - 2))
    stiff = math.max(stiff, body.E * most ^ (d - 1) / least)
    soft = math.min(soft, body.E)
    for _, given in ipairs(body.given) do if given.spring then spring(given.spring) end end
    for _, at in ipairs(body.loads) do load = load + norm(at.force) end
  end
  for _, support in ipairs(scene.supports) do
    for _, law in pairs(support.law or {}) do
      if law.name == "load" then load = load + math.abs(law.numbers[1]) * size ^ (d - 1) end
      if law.kind.k then spring(law.numbers[1]) end
      if law.kind.k2 then spring(law.numbers[2]) end
    end
  end
  local force <const> = 1e3 * (load + stiff * length) / scene.small
  local strained <const> = 1e-3 * soft * scene.reach / size -- what overlaps and prescribed displacements may make at least
  return { load = math.max(load / size ^ (d - 1), strained), force = force, stress = force / area,
           length = 1e3 * (length + load * flexible) }
end

local function scales(scene, contacts, supports, displacement)
  local most <const>, accuracy <const> = allowed(scene), scene.accuracy or 1e-6
  local scale = { stress = most.load, length = math.max(displacement, 1e-8 * scene.size * scene.small), most = most }
  local function see(list)
    for _, node in ipairs(list) do
      scale.stress = math.max(scale.stress, math.abs(node.pressure), norm(node.shear))
      scale.length = math.max(scale.length, norm(node.slip))
    end
  end
  for _, contact in ipairs(contacts) do see(contact.nodes) end
  for _, support in ipairs(supports) do see(support.nodes) end
  scale.length = math.min(scale.length, math.max(most.length, 1e-8 * scene.size))
  if most.force == 0 then scale.stress = 1e-3 * scene.stiffest -- nothing is pressed
  else scale.stress = math.min(scale.stress, most.stress) end
  scale.stress = math.max(scale.stress, 1e-6 * scene.stiffest * scale.length / scene.size)
  scale.accuracy, scale.p, scale.u = accuracy, accuracy * scale.stress, accuracy * scale.length
  scale.force = 1e-3 * accuracy * scale.stress * scene.size ^ (scene.dimension - 1)
  scale.node = scale.force
  return scale
end

local function check_allowed(scale, nodal, wrong)
  if not (nodal.displacement <= scale.most.length + scale.length) then
    wrong("a displacement of %.3g, where the data allow %.3g", nodal.displacement, scale.most.length)
  end
  if scale.most.force > 0 and not (nodal.force <= scale.most.force) then
    wrong("a nodal force of %.3g, where the data allow %.3g", nodal.force, scale.most.force)
  end
end

-- 2. Laws. Friction: at most `bound`; below it no slip, against the slip where there is some. A slip known up to 10 tol.u
-- has a direction known up to that / |slip|.
local function check_friction(at, node, bound, tol, wrong, held)
  local shear, moved = norm(node.shear), rawget(node, "moved") or node.slip
  local slip = norm(moved)
  if shear > bound + tol.p then wrong("shear %.3g beyond its bound %.3g at %s", shear, bound, at) end
  if slip <= tol.u or held then return end
  if bound == math.huge then return wrong("slip %.3g where there is none at %s", slip, at) end
  local off = {}
  for k, s in ipairs(moved) do off[k] = node.shear[k] + bound * s / slip end
  if norm(off) > tol.p + 10 * bound * tol.u / slip then
    wrong("slip %.3g, shear %.6g of %.6g, off by %.3g at %s", slip, shear, bound, norm(off), at)
  end
end

-- A node whose distance is held, by supports on both sides, has no condition of its own: it lies on sides of both bodies that are held (on a
-- disc anywhere). One that is held in a direction inclined to its normal, as on a disc's facets, slips as it approaches: the row of that
-- tangent says what the normal's does, and is left out. So is friction across a plane of symmetry.
local function holds_at(scene, body, x)
  for _, support in ipairs(scene.supports) do
    local law <const> = support.law
    local holds <const> = not law or (law.normal and law.normal.name == "prescribed") or (law.tangential and law.tangential.name == "prescribed")
    if support.body == body.index and holds and (body.disc or solids.on(scene, x, body, support.side)) then return true end
  end
  return false
end

local function is_held(scene, contact, node)
  local x <const> = { node.x, node.y, scene.dimension == 3 and node.z or nil }
  return holds_at(scene, contact.first.body, x) and (not contact.second or holds_at(scene, contact.second.body, x))
end

local function inclined(normal)
  for _, n in ipairs(normal) do if math.abs(n) > 1 - 1e-9 then return false end end
  return true
end

-- At a corner of the part, a node with sides of its own, given friction acts at the nodes beside it.
local function at_corner(scene, nodes, node)
  local sides = 0
  for _, other in ipairs(nodes) do
    if other.x == node.x and other.y == node.y and (scene.dimension == 2 or other.z == node.z) then sides = sides + 1 end
  end
  return sides > 1
end

local function check_contact(scene, contact, result, scale, wrong)
  for k, node in ipairs(result.nodes) do
    local tol = { p = math.max(scale.p, scale.force / node.weight), u = scale.u }
    local at = ("node %d of %s"):format(k, contact.name)
    local p, gap, law = node.pressure, node.gap, contact.friction
    if not (p == p and gap == gap) then wrong("not a number at %s", at) end
    if p < -tol.p then wrong("tension %.3g at %s", p, at) end
    if gap < -tol.u and not (p == 0 and is_held(scene, contact, node)) then wrong("penetration %.3g at %s", -gap, at) end
    if p > tol.p and gap > tol.u then wrong("pressure %.3g across a gap of %.3g at %s", p, gap, at) end
    if node.status == "open" and math.abs(p) > tol.p then wrong("open with pressure %.3g at %s", p, at) end
    if node.status ~= "open" and gap > tol.u then wrong("%s with gap %.3g at %s", node.status, gap, at) end
    if law then
      local along <const> = scene.impossible ~= nil -- supports there prescribe slips, not distances alone
      check_friction(at, node, law.kind == "tresca" and law.value or law.value * math.max(p, 0), tol, wrong,
        law.kind == "tresca" and at_corner(scene, result.nodes, node) or
        is_held(scene, contact, node) and (along or contact.second or contact.first.body.disc or inclined(node.normal)))
    elseif norm(node.shear) > tol.p then wrong("shear without friction at %s", at) end
  end
end

local function check_support(support, result, tol, wrong)
  for k, node in ipairs(result.nodes) do
    local at = ("node %d of %s"):format(k, support.name)
    local normal, tangential = support.law.normal, support.law.tangential
    local function on(law, which, v, r)
      local off = laws.distance(law, v, r, tol.u, tol.p)
      if off > 1 then wrong("%s law %s: v = %.6g, r = %.6g at %s", which, law.name, v, r, at) end
    end
    if normal then on(normal, "normal", node.away, node.pressure)
    elseif math.abs(node.pressure) > tol.p then wrong("pressure without a law at %s", at) end
    if not tangential then
      if norm(node.shear) > tol.p then wrong("shear without a law at %s", at) end
    elseif tangential.name == "friction" then
      check_friction(at, node, tangential.numbers[1], tol, wrong)
    elseif #node.normal == 2 then
      local t = { -node.normal[2], node.normal[1] }
      on(tangential, "tangential", dot(node.slip, t), dot(node.shear, t))
    else
      for i = 1, 3 do on(tangential, "tangential", node.slip[i], node.shear[i]) end
    end
  end
end

-- 3. Equilibrium of bodies, those that are glued together as one: forces, and moments where all forces are known at points
-- (supports by fix, slide, displace and spring tell their sum alone; on curved
-- facets of order 2 the mean in which a node's force acts is not at the node).
local function parts_of_equilibrium(scene)
  local group = {}
  for k in ipairs(scene.bodies) do group[k] = k end
  for _, tie in ipairs(scene.glues) do
    local from, to = group[tie.one], group[tie.other]
    for k, v in ipairs(group) do if v == from then group[k] = to end end
  end
  local sums = {}
  for k in ipairs(scene.bodies) do
    sums[group[k]] = sums[group[k]] or { force = { 0, 0, 0 }, moment = { 0, 0, 0 }, gross = 0, gross_moment = 0, whole = true }
  end
  return sums, group
end

-- Adds `share` times a force at x; moments are about the origin, levers those of the scene's extent.
local function push(sum, x, force, share, extent)
  local f = { share * force[1], share * force[2], share * (force[3] or 0) }
  local r = { x[1], x[2], x[3] or 0 }
  for k = 1, 3 do
    local i, j = k % 3 + 1, (k + 1) % 3 + 1
    sum.force[k] = sum.force[k] + f[k]
    sum.moment[k] = sum.moment[k] + r[i] * f[j] - r[j] * f[i]
  end
  sum.gross = sum.gross + norm(f)
  sum.gross_moment = sum.gross_moment + norm(f) * extent
end

-- Where a node's force acts on the side of a body that is plane: across the gap, along the normal of that side.
local function foot(scene, where, x)
  local plane = scene.plane(where.body, where.side)
  local d = dot(plane.normal, x) - dot(plane.normal, plane.point)
  local y = {}
  for k, v in ipairs(x) do y[k] = v - d * plane.normal[k] end
  return y
end

local function check_equilibrium(scene, made, solution, contacts, supports, tol, wrong)
  local sums, group = parts_of_equilibrium(scene)
  local extent = scene.extent
  for k, body in ipairs(scene.bodies) do
    for _, load in ipairs(body.loads) do push(sums[group[k]], load.x, load.force, scene.factor or 1, extent) end
  end
  for k, contact in ipairs(scene.contacts) do
    for side, share in pairs{ first = 1, second = -1 } do
      local where = contact[side]
      local sum = where and sums[group[where.body.index]]
      if sum and contact.curved and (contact.second or contact.first.body.element:sub(2) == "2") then sum.whole = false end
      for _, node in ipairs(sum and contacts[k].nodes or {}) do
        local x = point(scene, node)
        push(sum, contact.curved and x or foot(scene, where, x), laws.force_at(node), share, extent)
      end
    end
  end
  for k, support in ipairs(scene.supports) do
    local sum = sums[group[support.body]]
    for _, node in ipairs(support.law and supports[k].nodes or {}) do push(sum, point(scene, node), laws.force_at(node), 1, extent) end
    local body = scene.bodies[support.body]
    if not support.law or (body.element:sub(2) == "2" and (body.disc or body.bend ~= 0)) then sum.whole = false end
    if not support.law then
      push(sum, { 0, 0, 0 }, { solution:reaction(made.supports[k]) }, 1, extent)
    end
  end
  tol.gross = 0
  for _, sum in pairs(sums) do tol.gross = tol.gross + sum.gross end
  for k, sum in pairs(sums) do
    -- Beside the accuracy of forces: rounding of inner forces, a body's stiffness times its motion or what rounding of places leaves.
    -- What a loose tolerance leaves is beside all forces, and where nothing is loaded beside 1e-8 of those that gaps would make.
    local rounding = (1e-12 * tol.length + 1e-16 * extent) * scene.stiffest * scene.size^(scene.dimension - 2) + (scene.accuracy or 1e-9) * tol.gross
      + (scene.accuracy or 0) * 1e-8 * scene.stiffest * scene.reach * scene.size^(scene.dimension - 2)
    if not (norm(sum.force) <= tol.accuracy * sum.gross + rounding) then -- also where it is not a number
      wrong("forces on b%d do not balance: %.3g of %.3g", k, norm(sum.force), sum.gross)
    elseif sum.whole and norm(sum.moment) > tol.accuracy * sum.gross_moment + rounding * extent then
      wrong("moments on b%d do not balance: %.3g of %.3g", k, norm(sum.moment), sum.gross_moment)
    end
  end
end

-- How far nodes have slipped in this step.
local function slipped_since(result, before)
  if not before then return end
  for i, node in ipairs(result.nodes) do
    node.moved = {}
    for k, v in ipairs(node.slip) do node.moved[k] = v - before.nodes[i].slip[k] end
  end
end

local checks <const> = {}

function checks.check(scene, made, solution, before)
  local complaints, contacts, supports = {}, {}, {}
  local function wrong(...) table.insert(complaints, (string.format(...))) end
  for k in ipairs(scene.contacts) do
    contacts[k] = solution:contact(made.contacts[k])
    slipped_since(contacts[k], before and before:contact(made.contacts[k]))
  end
  for k, support in ipairs(scene.supports) do supports[k] = support.law and solution:support(made.supports[k]) or { nodes = {} } end
  local nodal = nodes(scene, made, solution, contacts, supports)
  local tol = scales(scene, contacts, supports, nodal.displacement)
  check_allowed(tol, nodal, wrong)
  for k, contact in ipairs(scene.contacts) do check_contact(scene, contact, contacts[k], tol, wrong) end
  for k, support in ipairs(scene.supports) do
    if support.law then check_support(support, supports[k], tol, wrong) end
  end
  check_equilibrium(scene, made, solution, contacts, supports, tol, wrong)
  if scene.accuracy then tol.node = math.max(tol.node, scene.accuracy * tol.gross) end
  local rubbing = 0 -- friction's bounds, of which slips known to 1e-7 make work
  for k, contact in ipairs(scene.contacts) do
    local law = contact.friction and contact.friction.value < math.huge and contact.friction
    for _, node in ipairs(law and contacts[k].nodes or {}) do
      rubbing = rubbing + law.value * node.weight * (law.kind == "tresca" and 1 or math.abs(node.pressure))
    end
  end
  for k, support in ipairs(scene.supports) do
    for _, law in pairs(support.law or {}) do
      local given = law.name == "friction" or law.name == "one_sided_friction"
      for _, node in ipairs(given and supports[k].nodes or {}) do rubbing = rubbing + law.numbers[1] * node.weight end
    end
  end
  -- Where loads meet their reactions at once nothing moves: forces count by what they would move the stiffest body by.
  local moved <const> = math.max(tol.length, tol.stress * scene.size / scene.stiffest)
  tol.energy = tol.accuracy / 1e-6 * (1e-9 * tol.gross + 1e-7 * rubbing) * moved + 1e-12 * nodal.rounding
  -- Gaps are known to 1e-10 of what forces move the softest body by.
  local softest = math.huge
  for _, body in ipairs(scene.bodies) do softest = math.min(softest, body.E) end
  tol.energy = tol.energy + 1e-10 * tol.gross ^ 2 / (softest * scene.size ^ (scene.dimension - 2))
  if scene.accuracy and rubbing > 0 then tol.energy = tol.energy + scene.accuracy / 20 * tol.gross * moved end -- forces off by tol slip
  if tol.gross < 1e-6 * scene.stress * scene.size ^ (scene.dimension - 1) then -- nothing is loaded
    tol.energy = tol.energy + 1e-10 * scene.stiffest * scene.size ^ scene.dimension
  end
  nodal.run(tol, wrong)
  return complaints, tol
end

function checks.rounding(scene, made, solution)
  local nodal <const> = nodes(scene, made, solution)
  return 1e-16 * nodal.stiffest * nodal.displacement, allowed(scene).load * scene.size ^ (scene.dimension - 1)
end

return checks
