-- Has a scene of the generator a solution? Answered from rigid motions alone, independently of the program's own balance, by a
-- motion along which the load does more work than all that resists it. Loaded by include; used by scripts/studies/random_scenes.lua
-- where a scene is refused.
--
-- Supports, contacts, friction and springs resist a motion v of the bodies as rigid ones by p(v), the greatest work of their forces
-- against it: infinite on springs and supports, 0 or infinite at contacts, g |v_t| for given friction. The energy has a minimum if
-- and only if the load's work f·v is at most p(v) for all v. The v that makes ½|v - f|² + p(v) least is 0 exactly then, and else such a motion:
-- f·v - p(v) = |v|². It is found by dotyk.qp; its numbers are looked at here.
-- Of Coulomb friction all forces in the cones count: v is then a proof that there is no equilibrium; without one there may be none still.

local laws = include "laws.lua"
local balance = {}
local directions <const> = 16 -- of a disc of friction in space
local larger <const> = 1 / math.cos(math.pi / directions)

-- The work of the force `n` at x on the motions of a body, which has its own amounts of them: translations, and rotations
-- about its middle divided by the scene's size, so that all are lengths.
local function row_of(problem, body, x, n, row)
  local d, c, first = problem.dimension, problem.centre[body], problem.first[body]
  for k = 1, d do row[first + k] = (row[first + k] or 0) + n[k] end
  local r = {}
  for k = 1, d do r[k] = (x[k] - c[k]) / problem.size end
  if d == 2 then
    row[first + 3] = (row[first + 3] or 0) + r[1] * n[2] - r[2] * n[1]
  else
    for k = 1, 3 do
      local i, j = k % 3 + 1, (k + 1) % 3 + 1
      row[first + 3 + k] = (row[first + 3 + k] or 0) + r[i] * n[j] - r[j] * n[i]
    end
  end
  return row
end

-- Two unit vectors (in the plane one) perpendicular to n.
local function tangents(n)
  if #n == 2 then return { { -n[2], n[1] } } end
  local least = 1
  for k = 2, 3 do if math.abs(n[k]) < math.abs(n[least]) then least = k end end
  local t, size = {}, 0
  for k = 1, 3 do t[k] = (k == least and 1 or 0) - n[least] * n[k]; size = size + t[k]^2 end
  for k = 1, 3 do t[k] = t[k] / size^0.5 end
  return { t, { n[2] * t[3] - n[3] * t[2], n[3] * t[1] - n[1] * t[3], n[1] * t[2] - n[2] * t[1] } }
end

-- The row of the slip along t.
local function along(slip, t)
  local row = {}
  for c, component in ipairs(slip) do
    for mode, v in pairs(component) do row[mode] = (row[mode] or 0) + t[c] * v end
  end
  return row
end

-- The forces that resist: `fixed` (of any size), others an amount of `rows[1]` from `low` to `high`, a vector of amounts
-- of all rows of length up to `radius`, or one in Coulomb's cone, the normal force first. `probed`: rows of the contacts
-- where curved ones are (probe.lua); `without`: "friction" of contacts, or "weak" springs.
local function collect(scene, held, probed, without)
  local problem = { dimension = scene.dimension, size = scene.size, first = {}, centre = {}, modes = 0,
                    fixed = {}, forces = {}, load = {} }
  for b, body in ipairs(scene.bodies) do
    local middle = {}
    for k = 1, scene.dimension do middle[k] = (body.low[k] + body.high[k]) / 2 end
    problem.centre[b], problem.first[b] = scene.turn(middle), problem.modes
    problem.modes = problem.modes + (scene.dimension == 2 and 3 or 6)
    for _, load in ipairs(body.loads) do row_of(problem, b, load.x, load.force, problem.load) end
    for _, at in ipairs(body.constraints) do
      if not (at.weak and without == "weak") then table.insert(problem.fixed, row_of(problem, b, at.x, at.n, {})) end
    end
  end
  local function jump(contact, x, n)
    local row, back = row_of(problem, contact.first.body.index, x, n, {}), {}
    for k, v in ipairs(n) do back[k] = -v end
    return contact.second and row_of(problem, contact.second.body.index, x, back, row) or row
  end
  for k, contact in ipairs(scene.contacts) do
    for i, node in ipairs(held.solution:contact(held.contacts[k]).nodes) do
      local x, rows = { node.x, node.y, scene.dimension == 3 and node.z or nil }, {}
      local normal = probed and probed[k][i].normal or jump(contact, x, node.normal)
      local law = without ~= "friction" and contact.friction
      local free <const> = law and (not scene.rests(contact, x) or (law.kind == "tresca" and scene.across(contact, node.normal)))
      for _, t in ipairs(free and tangents(node.normal) or {}) do
        table.insert(rows, probed and along(probed[k][i].slip, t) or jump(contact, x, t))
      end
      if #rows == 0 then law = nil end
      if law and law.kind == "coulomb" then
        table.insert(problem.forces, { rows = { normal, table.unpack(rows) }, mu = law.value })
      else
        table.insert(problem.forces, { rows = { normal }, low = 0, high = math.huge })
        if law then table.insert(problem.forces, { rows = rows, radius = law.value * node.weight }) end
      end
    end
  end
  for _, tie in ipairs(scene.glues) do
    local pair = { first = { body = { index = tie.one } }, second = { body = { index = tie.other } } }
    for _, x in ipairs(tie.points) do
      for k = 1, scene.dimension do
        local n = { 0, 0, scene.dimension == 3 and 0 or nil }
        n[k] = 1
        table.insert(problem.fixed, jump(pair, x, n))
      end
    end
  end
  return problem
end

-- A law of a support along one direction: r between its bounds, times the node's share.
local function add_law(problem, row, law, weight)
  if law.name == "load" then
    for k, v in pairs(row) do problem.load[k] = (problem.load[k] or 0) + weight * law.numbers[1] * v end
    return
  end
  local low, high = laws.bounds(law) -- of the reaction, against which the amounts count
  table.insert(problem.forces, { rows = { row }, low = -high * weight, high = -low * weight })
end

local function add_supports(scene, held, problem)
  for k, support in ipairs(scene.supports) do
    local law = support.law
    for _, node in ipairs(law and held.solution:support(held.supports[k]).nodes or {}) do
      local x, into = { node.x, node.y, scene.dimension == 3 and node.z or nil }, {}
      for i, v in ipairs(node.normal) do into[i] = -v end
      if law.normal then add_law(problem, row_of(problem, support.body, x, into, {}), law.normal, node.weight) end
      if law.tangential then
        local rows = {}
        for i, t in ipairs(tangents(node.normal)) do rows[i] = row_of(problem, support.body, x, t, {}) end
        if law.tangential.name == "friction" then table.insert(problem.forces, { rows = rows, radius = law.tangential.numbers[1] * node.weight })
        else for _, row in ipairs(rows) do add_law(problem, row, law.tangential, node.weight) end end
      end
    end
  end
end

-- Vectors of amounts of all motions.
local function dense(problem, row)
  local v = {}
  for k = 1, problem.modes do v[k] = row[k] or 0 end
  return v
end
local function dot(a, b)
  local sum = 0
  for k, v in ipairs(a) do sum = sum + v * b[k] end
  return sum
end
local function add(a, s, b) for k, v in ipairs(b) do a[k] = a[k] + s * v end end

-- What is left of v beside the fixed directions, which are made orthonormal first.
local function remover(problem)
  local basis = {}
  local function remove(v)
    for _ = 1, 2 do for _, q in ipairs(basis) do add(v, -dot(q, v), q) end end
    return v
  end
  for _, row in ipairs(problem.fixed) do
    local v = dense(problem, row)
    local before = dot(v, v)
    remove(v)
    local size = dot(v, v)
    if size > 1e-18 * before then
      for k in ipairs(v) do v[k] = v[k] / size^0.5 end
      table.insert(basis, v)
    end
  end
  return remove
end

-- Rows of the directions in which a disc is looked at, times `factor`: from 1 / cos(half the angle between them) on the polygon
-- around all of them holds the disc.
local function around(rows, factor)
  local all = {}
  for k = 1, #rows == 1 and 2 or directions do
    local angle, row = 2 * math.pi * k / (#rows == 1 and 2 or directions), {}
    for i in ipairs(rows[1]) do
      row[i] = #rows == 1 and math.cos(angle) * rows[1][i] or factor * (math.cos(angle) * rows[1][i] + math.sin(angle) * rows[2][i])
    end
    all[k] = row
  end
  return all
end

-- The motion v nearest to the load in the sense of ½|v - load|² + p(v), by dotyk.qp: the unknowns are v and a bound of each finite
-- resistance, as a part of the load's size.
local function nearest_motion(load, size, forces, factor)
  local modes, i, j, value, count, linear = #load, {}, {}, {}, 0, {}
  for k, amount in ipairs(load) do linear[k] = amount / size end
  local function below(row, unknown) -- row·v <= the unknown, or 0
    count = count + 1
    for k, amount in ipairs(row) do table.insert(i, count); table.insert(j, k); table.insert(value, amount) end
    if unknown then table.insert(i, count); table.insert(j, unknown); table.insert(value, -1) end
  end
  local function resist(rows, bound)
    if bound == 0 then return end
    if bound < math.huge then table.insert(linear, -bound / size) end
    for _, row in ipairs(rows) do below(row, bound < math.huge and #linear) end
  end
  for _, force in ipairs(forces) do
    local normal = force.dense[1]
    if force.radius then resist(around(force.dense, factor), force.radius)
    elseif force.mu then
      below(normal)
      for _, row in ipairs(around({ table.unpack(force.dense, 2) }, factor)) do
        for k, amount in ipairs(row) do row[k] = normal[k] + force.mu * amount end
        below(row)
      end
    else
      local back = {}
      for k, amount in ipairs(normal) do back[k] = -amount end
      resist({ normal }, force.high)
      resist({ back }, -force.low)
    end
  end
  local diagonal, ones, least = {}, {}, {}
  for k = 1, #linear do least[k] = k <= modes and -math.huge or 0 end
  for k = 1, modes do diagonal[k], ones[k] = k, 1 end
  local rows = count > 0 and { i = i, j = j, value = value } or nil
  local result = dotyk.qp{ B = { i = diagonal, j = diagonal, value = ones }, c = linear, A = rows, high = rows and 0, x_low = least,
                           method = "active_set" }
  return { table.unpack(result.x, 1, modes) }
end

-- Work of the forces against the motion, at most, and how much those without bound are moved the wrong way.
local function resistance(forces, v)
  local work, wrong = 0, 0
  for _, force in ipairs(forces) do
    local along, length = dot(force.dense[1], v), 0
    if force.low then
      local bound = along > 0 and force.high or -force.low
      if bound == math.huge then wrong = math.max(wrong, math.abs(along)) else work = work + bound * math.abs(along) end
    else
      for k = force.mu and 2 or 1, #force.dense do length = length + dot(force.dense[k], v)^2 end
      if force.mu then wrong = math.max(wrong, along + force.mu * length^0.5)
      elseif force.radius == math.huge then wrong = math.max(wrong, length^0.5)
      else work = work + force.radius * length^0.5 end
    end
  end
  return work, wrong
end

-- "unsolvable" where a motion proves it, "solvable" where nothing is left of the load, else "undecided"; and what is left of it.
function balance.verdict(problem)
  local remove <const>, forces = remover(problem), {}
  local load = remove(dense(problem, problem.load))
  local size = dot(load, load)^0.5
  for _, force in ipairs(problem.forces) do
    force.dense = {}
    local most = 0
    for k, row in ipairs(force.rows) do
      local whole <const> = dense(problem, row)
      local before <const> = dot(whole, whole)
      force.dense[k] = remove(whole)
      local after <const> = dot(whole, whole)
      if after <= 1e-18 * before then for i in ipairs(whole) do whole[i] = 0 end end -- rounding is no resistance
      most = math.max(most, dot(whole, whole))
    end
    if most > 0 then table.insert(forces, force) end
  end
  if size == 0 then return "solvable", 0 end
  local v = nearest_motion(load, size, forces, larger)
  local left, work, wrong = dot(v, v)^0.5, resistance(forces, v)
  if left > 1e-7 and wrong < 1e-7 * left and dot(load, v) - work > 0.5 * left^2 * size then return "unsolvable", left end
  local others = nearest_motion(load, size, forces, 1)
  return dot(others, others)^0.5 < 1e-7 and "solvable" or "undecided", left
end

-- How fast a point moves with the mode-th motion of a body: translations, then rotations, as row_of counts them.
function balance.motion(scene, b, mode)
  local d, body, c = scene.dimension, scene.bodies[b], {}
  for k = 1, d do c[k] = (body.low[k] + body.high[k]) / 2 end
  c = scene.turn(c)
  return function(x)
    local v, r = { 0, 0, 0 }, {}
    for k = 1, d do r[k] = (x[k] - c[k]) / scene.size end
    if mode <= d then v[mode] = 1
    elseif d == 2 then v[1], v[2] = -r[2], r[1]
    else
      local k = mode - 3
      local i, j = k % 3 + 1, (k + 1) % 3 + 1
      v[i], v[j] = -r[j], r[i]
    end
    return v
  end
end

-- Of a scene of bodies; `held` has its nodes.
function balance.scene(scene, held, probed, without)
  local problem = collect(scene, held, probed, without)
  add_supports(scene, held, problem)
  return balance.verdict(problem)
end

return balance
