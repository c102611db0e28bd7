-- dotyk.repeated_systems: every method agrees with dotyk.solve, sensitivities with central differences, bad input is refused.
local refused <const> = require "refused"

local material <const> = dotyk.material{ E = 10, nu = 0.3 }
local loads <const> = { down = { "right", { 0, 0, -0.01 } }, wind = { "top", { 0.02, 0.01, 0 } } }
local function beam(names, map)
  local mesh <const> = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 6, 1, 1 }, cells = { 6, 2, 2 }, element = "Q1" }
  if map then mesh:transform(map) end
  local body <const> = dotyk.body{ name = "beam", mesh = mesh, material = material }
  body:part"left":fix()
  for _, name in ipairs(names) do body:part(loads[name][1]):load(loads[name][2], name) end
  return dotyk.scene{ body }, body
end
-- The components of two lists of nodes: greatest difference by greatest value.
local function off(a, b)
  local difference, size = 0, 0
  assert(#a == #b)
  for k, node in ipairs(a) do
    for i = 4, 6 do difference, size = math.max(difference, math.abs(node[i] - b[k][i])), math.max(size, math.abs(b[k][i])) end
  end
  return difference / size
end

local methods <const>, preconditioners <const> = { "cholesky", "cg", "scg", "cglan", "block_cg" }, { "none", "ssor", "ic" }
local function each(check)
  for _, method in ipairs(methods) do
    for _, preconditioner in ipairs(preconditioners) do check(method, preconditioner) end
  end
end

-- 1. Load cases: dotyk.solve with that load alone. Rounding ends residuals at some 1e-12 here, Cholesky's, too; tol is 1e-10.
local exact <const> = {}
for k, name in ipairs{ "down", "wind" } do
  local scene <const>, body <const> = beam{ name }
  local s <const> = dotyk.solve(scene)
  exact[k] = {}
  for i, node in ipairs(dotyk.repeated_systems{ scene = scene, loads = { name } }:nodes(1)) do
    local x <const>, y <const>, z <const> = node[1], node[2], node[3]
    exact[k][i] = { x, y, z, s:displacement(body, x, y, z) }
  end
end
each(function(method, preconditioner)
  local r <const> = dotyk.repeated_systems{ scene = beam{ "down", "wind" }, loads = { "down", "wind" }, method = method,
    preconditioner = preconditioner, tol = 1e-10 }
  assert(r.converged and #r.systems == 2 and r.systems[2].name == "wind")
  for k = 1, 2 do assert(off(r:nodes(k), exact[k]) < 1e-9) end
end)

-- 2. Sensitivities: central differences with h = 1e-4, whose own error is about h² = 1e-8. The second variable moves inner
-- and side nodes on curved ways, the third nothing. The end stays in its plane and keeps its size: so does its load.
local velocities <const> = {
  function(x, y, z) return 0, 0, (z - 0.5) * (6 - x) / 6 end,
  function(x, y, z) return 0.3 * math.sin(math.pi * x / 6) * y, 0.2 * (6 - x) * y * z, 0 end,
  function() return 0, 0, 0 end,
}
local function moved(k, h)
  local scene <const> = beam({ "down" }, function(x, y, z)
    local vx <const>, vy <const>, vz <const> = velocities[k](x, y, z)
    return x + h * vx, y + h * vy, z + h * vz
  end)
  return dotyk.repeated_systems{ scene = scene, loads = { "down" } }:nodes(1)
end
local differences <const> = {}
for k = 1, 2 do
  local h <const> = 1e-4
  differences[k] = {}
  local plus <const>, minus <const> = moved(k, h), moved(k, -h)
  for i, node in ipairs(plus) do
    differences[k][i] = { 0, 0, 0 }
    for c = 4, 6 do differences[k][i][c] = (node[c] - minus[i][c]) / (2 * h) end
  end
end
each(function(method, preconditioner)
  local r <const> = dotyk.repeated_systems{ scene = beam{ "down" }, velocities = velocities, method = method, preconditioner = preconditioner,
    tol = 1e-10, deflate = method == "cglan" or nil, extend = method == "scg" or nil }
  assert(r.converged and #r.systems == 4 and r.systems[1].name == "analysis")
  for k = 1, 2 do assert(off(r:nodes(k + 1), differences[k]) < 1e-6) end
  assert(r.systems[4].iterations == 0 and r.systems[4].energy == 0)
  assert((r.kept > 0) == (method == "scg" or method == "cglan"))
end)

-- 2b. Loads that change with their area, of all kinds, and springs: as the derivative of dotyk.shape. Contact is far away.
local function loaded()
  local scene <const>, body <const> = beam{ "down", "wind" }
  body:part"bottom":spring{ z = 0.02, x = 0.01 }
  body:part"front":pressure(function(x, y, z) return 0.01 * (1 + x * z) end)
  return scene, body
end
local scene_of_loads <const>, loaded_body <const> = loaded()
local grow <const> = velocities[2]
local far <const> = scene_of_loads:contact{ loaded_body:part"top", rigid = dotyk.rigid.plane{ point = { 0, 0, 50 }, normal = { 0, 0, -1 } } }
local design <const> = dotyk.shape{ scene = scene_of_loads, moves = { { body = loaded_body, velocity = grow, lower = 0, upper = 1 } } }:design{ 0 }
local derivative <const> = {}
local plain <const> = loaded()
local direct <const> = dotyk.repeated_systems{ scene = plain, velocities = { grow } }
for k, node in ipairs(direct:nodes(2)) do
  local d <const> = { design:displacement(loaded_body, node[1], node[2], node[3]) }
  derivative[k] = { 0, 0, 0 }
  for c = 1, 3 do derivative[k][c + 3] = d[c].gradient[1] end
end
assert(design.solution:contact(far).closed == 0)
assert(off(direct:nodes(2), derivative) < 1e-10)

-- 3. Too few iterations are told.
local few <const> = dotyk.repeated_systems{ scene = beam{ "down" }, loads = { "down" }, method = "cg", max_iterations = 2 }
assert(not few.converged and few.systems[1].iterations == 2 and few.systems[1].reason:find "the most allowed")

-- 4. What is refused.
local scene <const>, body <const> = beam{ "down" }
refused(function() dotyk.repeated_systems{ scene = scene } end, "give either loads")
refused(function() dotyk.repeated_systems{ scene = scene, loads = { "donw" } } end, "its cases are 'down'")
refused(function() dotyk.repeated_systems{ scene = scene, loads = { "down" }, method = "sgc" } end, "scg")
refused(function() dotyk.repeated_systems{ scene = scene, loads = { "down" }, method = "cg", deflate = true } end, "'deflate' belongs to")
refused(function() dotyk.repeated_systems{ scene = scene, loads = { "down" }, preconditioner = "ic", omega = 1.2 } end, "'omega' belongs to")
refused(function() dotyk.repeated_systems{ scene = scene, velocities = { function() return 1, 2 end } } end, "velocities[1]")
refused(function() few:nodes(2) end, "system 2 is not one of 1 to 1")
local loose <const> = dotyk.body{ name = "loose", mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { 1, 1, 1 } }, material = material }
loose:part"top":load({ 0, 0, 1 }, "up")
refused(function() dotyk.repeated_systems{ scene = dotyk.scene{ loose }, loads = { "up" } } end, "free to move", "translation along x")
refused(function() dotyk.repeated_systems{ scene = dotyk.scene{ body, loose }, loads = { "up" } } end, "2 bodies")
scene:contact{ body:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0, 0 }, normal = { 0, 0, 1 } } }
refused(function() dotyk.repeated_systems{ scene = scene, loads = { "down" } } end, "in contact")
