-- Random scenes whose energy is convex (given friction, laws of supports, no Coulomb): the default method solves each of
-- them, and its energy is that of a second method.
--   dotyk tests/solver/convex_scenes.lua [SEED] [COUNT]
local seed <const>, count <const> = tonumber(arg[1]) or 1, tonumber(arg[2]) or 40
local verbose <const> = arg[3] == "verbose"

-- A generator of our own: the same scenes everywhere.
local state
local function uniform()
  state = (state * 1103515245 + 12345) % 2147483648
  return (state // 65536) / 32768
end
local function between(a, b) return a + (b - a) * uniform() end
local function decades(a, b) return 10 ^ between(a, b) end
local function whole(a, b) return a + math.min(b - a, math.floor((b - a + 1) * uniform())) end
local function pick(list) return list[whole(1, #list)] end

local function block(name, from, size, space, E, size_of_cells)
  local to, cells = {}, {}
  for i = 1, #from do to[i], cells[i] = from[i] + size[i], math.max(1, math.min(space and 4 or 8, math.floor(size[i] / size_of_cells))) end
  local make = space and dotyk.mesh.box or dotyk.mesh.rectangle
  return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = between(0, 0.4) },
    mesh = make{ from = from, to = to, cells = cells, element = pick{ "P1", "Q1" } } }
end

local function vector(space, size)
  local v = { between(-1, 1) * size, between(-1, 0.4) * size }
  if space then v = { v[1], between(-1, 1) * size, v[2] } end
  return v
end

-- Friction of everyday size against the load, or decades from it; sometimes none.
local function tresca(load)
  if uniform() < 0.2 then return nil end
  return dotyk.friction.tresca(load * (uniform() < 0.5 and between(0.1, 3) or decades(-4, 4)))
end

local function law(k, load, tangential, space)
  if tangential and space then return dotyk.law.friction(load * decades(-1, 1)) end
  local laws = {
    function() return dotyk.law.elastic(k) end,
    function() return dotyk.law.friction(load * decades(-1, 1)) end,
    function() return dotyk.law.capped_elastic(k, load * decades(-1, 1)) end,
  }
  if not tangential then
    laws[#laws + 1] = function() return dotyk.law.one_sided_elastic(k) end
    laws[#laws + 1] = function() return dotyk.law.signorini() end
    laws[#laws + 1] = function() return dotyk.law.unequal_elastic(k, k * decades(-3, 0)) end
  end
  return pick(laws)()
end

local function scene_of(number)
  state = (seed * 7919 + number * 104729) % 2147483648
  for _ = 1, 3 do uniform() end
  local space, E, load = uniform() < 0.3, decades(0, 5), decades(-1, 3)
  local size = space and { between(0.5, 3), between(0.5, 3), between(0.3, 2) } or { between(0.5, 4), between(0.2, 3) }
  local from = space and { 0, 0, 0 } or { 0, 0 }
  local high <const> = space and 3 or 2
  local bodies = { block("lower", from, size, space, E, space and 0.6 or 0.4) }
  if uniform() < 0.4 then
    local start = { table.unpack(from) }
    start[high] = size[high] + (uniform() < 0.5 and 0 or between(0, 0.02))
    local other = { table.unpack(size) }
    other[1], other[high] = size[1] * pick{ 1, 0.5, 0.7 }, between(0.3, 2)
    bodies[2] = block("upper", start, other, space, E * decades(-3, 3), space and 0.6 or 0.4)
  end
  local scene = dotyk.scene(bodies)
  local up = space and { 0, 0, 1 } or { 0, 1 }
  local lower, upper = bodies[1], bodies[#bodies]
  local kind = whole(1, 4)
  if kind == 1 then
    lower:part"bottom":fix()
  elseif kind == 2 then
    lower:part"bottom":support{ normal = law(E * decades(-3, 2), load), tangential = law(E * decades(-3, 2), load, true, space) }
  else
    scene:contact{ lower:part"bottom", rigid = dotyk.rigid.plane{ point = from, normal = up }, friction = tresca(load) }
  end
  if uniform() < 0.4 then
    scene:contact{ lower:part"left", rigid = dotyk.rigid.plane{ point = from, normal = space and { 1, 0, 0 } or { 1, 0 } }, friction = tresca(load) }
  end
  if uniform() < 0.2 then lower:part"right":slide() end
  if #bodies == 2 then scene:contact{ upper:part"bottom", lower:part"top", friction = tresca(load) } end
  upper:part"top":load(vector(space, load))
  if uniform() < 0.3 then lower:part"right":load(vector(space, load * decades(-2, 0))) end
  if uniform() < 0.3 then for _, b in ipairs(bodies) do b:part(pick{ "left", "right" }):spring{ x = E * decades(-6, -1), y = E * decades(-6, -1) } end end
  return scene, bodies, 10 * load
end

-- The greatest displacement of corners.
local function greatest(s, bodies)
  local most = 0
  for _, b in ipairs(bodies) do
    for _, name in ipairs{ "left", "right" } do
      b:part(name, function(...)
        local u = { s:displacement(b, table.unpack({ ... }, 1, b.dimension)) }
        for _, v in ipairs(u) do most = math.max(most, math.abs(v)) end
        return true
      end)
    end
  end
  return most
end

local refused, solved, failures, rescued = 0, 0, {}, 0
local function note(number, text) failures[#failures + 1] = ("scene %d of seed %d: %s"):format(number, seed, text) end
for number = 1, count do
  local scene, bodies, forces = scene_of(number)
  local ok, s = pcall(dotyk.solve, scene)
  if not ok then
    refused = refused + 1
    if not tostring(s):find("not held") and not tostring(s):find("no solution") and not tostring(s):find("nothing stops") and not tostring(s):find("does work") then note(number, "refused: " .. tostring(s)) end
  elseif not s.converged then
    note(number, s.method .. ": " .. s.reason)
  else
    solved = solved + 1
    if s.reason:find("lost its way") then rescued = rescued + 1 if verbose then print(number, s.rows, s.iterations, s.reason) end end
    local second = dotyk.solver.proximal{ max_iterations = 200 }:solve(scene)
    if not second.converged then second = dotyk.solver.projected_cg{ max_iterations = 20000 }:solve(scene) end
    local mine, other = s.energy + s.friction_energy, second.energy + second.friction_energy
    -- Energies are known up to the error in the laws times a force and a displacement of the problem, row by row.
    local error = (s.residual.law + second.residual.law) * forces * greatest(s, bodies)
    if second.converged and math.abs(mine - other) > 1e-7 * (math.abs(s.energy) + s.friction_energy) + 10 * s.rows * error then
      note(number, ("energy %.15g by %s, %.15g by %s"):format(mine, s.method, other, second.method))
    end
    if verbose and not second.converged then print(number, "no second method", second.reason) end
  end
end
if verbose then print(("%d solved, %d of them handed over, %d refused, %d failures"):format(solved, rescued, refused, #failures)) end
assert(#failures == 0, table.concat(failures, "\n"))
assert(solved > count / 3, "too few scenes have a solution")
