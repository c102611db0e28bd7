-- Is a state in equilibrium node by node? Nodal forces K u are assembled by lib/finite_elements.lua from displacements
-- at the nodes, and compared with loads, springs, contact forces, laws of supports and reactions; the energy likewise.
-- Loaded by include; returns nodes(scene, made, solution, contacts, supports), of these the program's own results (nil:
-- sizes alone are asked for): sizes, and run(tol, wrong), which checks.

local fem <const>, meshes <const>, laws <const> = include "../../lib/finite_elements.lua", include "meshes.lua", include "laws.lua"

local function dot(a, b)
  local sum = 0
  for k, v in ipairs(a) do sum = sum + v * b[k] end
  return sum
end
local function norm(a) return dot(a, a) ^ 0.5 end
local function add(a, s, b) for k, v in ipairs(b) do a[k] = a[k] + s * v end end

-- 1. Bodies: mesh, displacements, what is left of K u beside known loads

-- The nodes of facets, in no order; or their corners alone.
local function nodes_of(facets, mesh, corners)
  local all, seen = {}, {}
  for _, facet in ipairs(facets) do
    for k, node in ipairs(facet) do
      local whole = not corners or mesh.order == 1
      if mesh and corners and mesh.order == 2 then
        if mesh.simplex then whole = k <= mesh.dimension
        else whole = k % 2 == 1 and (mesh.dimension == 2 or k ~= 5) end
      end
      if whole and not seen[node] then table.insert(all, node) end
      seen[node] = seen[node] or whole
    end
  end
  return all
end

-- Facets of the part that faces along a side; of a disc those whose normal is within 0.2, as the generator says.
local function part_facets(scene, body, side)
  if not body.disc then return body.elements.sides[side] end
  local n <const>, facets, middle = scene.plane(body, side).normal, {}, { 0, 0 }
  for _, facet in ipairs(body.elements.facets) do
    for _, node in ipairs(facet) do add(middle, 1 / (#facet * #body.elements.facets), body.elements.points[node]) end
  end
  for _, facet in ipairs(body.elements.facets) do
    local a, b = body.elements.points[facet[1]], body.elements.points[facet[#facet]]
    if body.elements.simplex then b = body.elements.points[facet[2]] end
    local out = { (a[1] + b[1]) / 2 - middle[1], (a[2] + b[2]) / 2 - middle[2] }
    if dot(out, n) > 0.2 * norm(out) then table.insert(facets, facet) end
  end
  return facets
end

local function assemble(scene, body, made, solution, factor)
  body.elements = body.elements or meshes.of(scene, body)
  local mesh, u, most = body.elements, {}, 0
  for node, x in ipairs(mesh.points) do
    u[node] = { solution:displacement(made, table.unpack(x)) }
    most = math.max(most, norm(u[node]))
  end
  local lambda, mu = fem.lame(body.E, body.nu, body.plane)
  local state = { body = body, mesh = mesh, u = u, most = most }
  state.left, state.energy, state.stiffness = fem.inner_forces(mesh, lambda, mu, u)
  local loads = fem.zeros(mesh)
  if body.force then fem.add_load(mesh, mesh.cells, function() return body.force end, loads) end
  for _, given in ipairs(body.given) do
    local facets = given.side and part_facets(scene, body, given.side)
    if given.traction then
      fem.add_load(mesh, facets, function(x)
        local t = {}
        for k, v in ipairs(given.traction) do t[k] = v * (1 + given.slope * x[1]) end
        return t
      end, loads)
    else
      local springs = fem.add_load(mesh, facets, function(_, N, facet)
        local v = fem.value(u, facet, N)
        for k in ipairs(v) do v[k] = given.spring * v[k] end
        return v
      end, fem.zeros(mesh))
      -- Springs on curved facets of order 2 are integrated by no rule exactly.
      if mesh.order == 2 and (body.disc or (body.bend ~= 0 and (given.side == "front" or given.side == "back"))) then
        state.inexact = facets
      end
      for node, force in ipairs(springs) do
        add(state.left[node], 1, force)
        state.energy = state.energy + dot(force, u[node]) / 2
        state.stiffness[node] = state.stiffness[node] + given.spring * scene.size ^ (scene.dimension - 1)
      end
    end
  end
  for node, force in ipairs(loads) do
    add(state.left[node], -factor, force)
    state.energy = state.energy - factor * dot(force, u[node])
  end
  return state
end

-- 2. What bears forces at a node: unknown ones along `directions` (nil: any), or a known one.

-- The corners of a part's facets at the places of a result's nodes, or nil where there is none for one of them.
local function found(scene, state, side, list)
  local all = {}
  for _, node in ipairs(nodes_of(part_facets(scene, state.body, side), state.mesh, true)) do
    for k, at in ipairs(list) do
      local x <const>, distance = { at.x, at.y, scene.dimension == 3 and at.z or nil }, 0
      for i, v in ipairs(x) do distance = distance + math.abs(v - state.mesh.points[node][i]) end
      if distance < 1e-9 * scene.extent then all[k] = node end
    end
  end
  for k in ipairs(list) do if not all[k] then return nil end end
  return all
end

local function bear(state, node, what)
  state.bearers = state.bearers or {}
  state.bearers[node] = state.bearers[node] or {}
  table.insert(state.bearers[node], what)
end

local function bear_unknown(scene, state, side, directions, facets)
  facets = facets or part_facets(scene, state.body, side)
  for _, node in ipairs(nodes_of(facets)) do bear(state, node, { directions = directions }) end
end

local function bear_known(state, nodes, list, sign)
  for k, node in ipairs(nodes) do
    local f = laws.force_at(list[k])
    for i in ipairs(f) do f[i] = sign * f[i] end
    bear(state, node, { force = f })
  end
end

-- Conditions at nodes of cells of order 1 act there alone; on the other part their shares are those of the pairing,
-- known where nodes match.
local function add_contact(scene, states, contact, result)
  local smooth <const> = not contact.curved and not contact.ball and (not contact.friction or contact.friction.value == 0)
  local sides, rows = {}, {}
  for side, sign in pairs{ first = 1, second = -1 } do
    local where = contact[side]
    if where then
      sides[side] = { state = states[where.body.index], where = where, sign = sign, order = where.body.element:sub(2) }
      rows[side] = found(scene, sides[side].state, where.side, result.nodes)
    end
  end
  local both <const> = rows.first and rows.second
  local matching <const> = both and sides.first.order == "1" and sides.second.order == "1" and not contact.mortar
    and #nodes_of(part_facets(scene, sides.first.where.body, sides.first.where.side)) == #result.nodes
    and #nodes_of(part_facets(scene, sides.second.where.body, sides.second.where.side)) == #result.nodes
  for side, s in pairs(sides) do
    if rows[side] and s.order == "1" and (not both or matching) then bear_known(s.state, rows[side], result.nodes, s.sign)
    else bear_unknown(scene, s.state, s.where.side, smooth and { scene.plane(s.where.body, s.where.side).normal } or nil) end
  end
end

local function add_support(scene, states, support, result)
  local state = states[support.body]
  if not support.law then return end -- `holding` says where and how
  local body <const> = state.body
  local nodes = body.element:sub(2) == "1" and found(scene, state, support.side, result.nodes)
  if nodes then return bear_known(state, nodes, result.nodes, 1) end
  local plane <const> = not body.disc and body.bend == 0 and not support.law.tangential
  bear_unknown(scene, state, support.side, plane and { scene.plane(body, support.side).normal } or nil)
end

-- What is left of a force beside the directions; nothing where any is borne.
local function remove(force, bearers)
  local basis = {}
  for _, what in ipairs(bearers or {}) do
    if what.force then add(force, -1, what.force)
    elseif not what.directions then return nil
    else
      for _, n in ipairs(what.directions) do
        local v = { table.unpack(n) }
        for _, q in ipairs(basis) do add(v, -dot(v, q), q) end
        local size = norm(v)
        if size > 1e-6 then
          for k in ipairs(v) do v[k] = v[k] / size end
          table.insert(basis, v)
        end
      end
    end
  end
  for _, q in ipairs(basis) do add(force, -dot(force, q), q) end
  return force
end

local function check_nodes(state, tol, wrong)
  for node, left in ipairs(state.left) do
    local rest = remove({ table.unpack(left) }, state.bearers and state.bearers[node])
    local allowed = tol.node + 1e-12 * state.stiffness[node] * tol.length
    if rest and not (norm(rest) <= allowed) then
      wrong("a force of %.3g is left over (%.3g allowed) at node %d of %s at (%s)", norm(rest), allowed, node, state.body.name,
        table.concat(state.mesh.points[node], ", "))
    end
  end
end

-- 3. The energy of laws and what friction dissipates in this step
local function energy_of_laws(scene, contacts, supports)
  local sum = 0
  for k in ipairs(scene.contacts) do
    for _, node in ipairs(contacts[k].nodes) do
      for c, slip in ipairs(rawget(node, "moved") or node.slip) do sum = sum - node.weight * node.shear[c] * slip end
    end
  end
  for k, support in ipairs(scene.supports) do
    local normal, tangential = table.unpack(support.law and { support.law.normal or false, support.law.tangential } or {})
    for _, node in ipairs(supports[k].nodes) do
      local n <const>, along = node.normal, {}
      if normal then sum = sum + node.weight * laws.energy(normal, node.away) end
      if tangential then
        if #n == 2 then along = { dot(node.slip, { -n[2], n[1] }) }
        elseif tangential.name == "friction" then along = { norm(node.slip) }
        else along = node.slip end
      end
      for _, v in ipairs(along) do sum = sum + node.weight * laws.energy(tangential, v) end
    end
  end
  return sum
end

-- 4. The whole

return function(scene, made, solution, contacts, supports)
  local states, check = {}, { displacement = 0, rounding = 0, force = 0, stiffest = 0 }
  check.energy = contacts and energy_of_laws(scene, contacts, supports) or 0
  for k, body in ipairs(scene.bodies) do
    local state = assemble(scene, body, made.bodies[k], solution, scene.factor or 1)
    states[k], check.inexact = state, check.inexact or state.inexact
    check.displacement, check.energy = math.max(check.displacement, state.most), check.energy + state.energy
    for node, stiffness in ipairs(state.stiffness) do
      check.rounding = check.rounding + stiffness * norm(state.u[node]) * state.most
      check.stiffest = math.max(check.stiffest, stiffness)
      check.force = math.max(check.force, norm(state.left[node]))
    end
  end
  if not contacts then return check end
  for k, contact in ipairs(scene.contacts) do add_contact(scene, states, contact, contacts[k]) end
  for k, support in ipairs(scene.supports) do add_support(scene, states, support, supports[k]) end
  for _, state in ipairs(states) do
    if state.inexact then bear_unknown(scene, state, nil, nil, state.inexact) end
    for _, held in ipairs(state.body.holding or {}) do bear_unknown(scene, state, held.side, held.directions) end
  end
  for _, tie in ipairs(scene.glues) do
    bear_unknown(scene, states[tie.one], "bottom")
    bear_unknown(scene, states[tie.other], "top")
  end
  function check.run(tol, wrong)
    for _, state in ipairs(states) do check_nodes(state, tol, wrong) end
    local energy <const> = solution.energy + solution.friction_energy
    if not check.inexact and not (math.abs(check.energy - energy) <= tol.energy + 1e-12 * check.rounding) then
      wrong("energy and friction %.12g, by an assembly of its own %.12g", energy, check.energy)
    end
  end
  return check
end
