-- Quasi-static histories: slip is measured from the last step, and friction remembers.
local check <const> = require "check"
local refused <const> = require "refused"

-- A layer of cells in simple shear between its fixed top and a rigid floor with given friction that presses
-- and moves: stress is uniform, so the friction force F of the whole floor is that of a spring k = G A/H with
-- a slider of strength g A: F_k = π(F_{k-1} + k (d_k - d_{k-1})), π the projection onto the disc of radius g A.
local E <const>, g <const> = 20, 0.3
local function sheared(dim, g_)
  local space = dim == 3
  local m = space and dotyk.mesh.box{ from = {0,0,0}, to = {1,2,0.5}, cells = {2,2,1}, element = "Q1" }
    or dotyk.mesh.rectangle{ from = {0,0}, to = {2,0.5}, cells = {3,1}, element = "Q1" }
  local b = dotyk.body{ mesh = m, material = dotyk.material{ E = E, nu = 0 } }
  b:part "top":fix()
  local scene = dotyk.scene{ b }
  local normal = space and { 0, 0, 1 } or { 0, 1 }
  local point = space and { 0, 0, 0 } or { 0, 0 }
  return scene, scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = point, normal = normal },
                               friction = dotyk.friction.tresca(g_ or g) }
end
local function slider(path, limit, k)
  local F, d, work = { 0, 0 }, { 0, 0 }, 0
  local forces, works = {}, {}
  for i, to in ipairs(path) do
    local x, y = F[1] + k * (to[1] - d[1]), F[2] + k * ((to[2] or 0) - d[2])
    local most = math.max(1, math.sqrt(x * x + y * y) / limit)
    F, d = { x / most, y / most }, { to[1], to[2] or 0 }
    -- What the spring did not take is slip.
    work = work + (F[1] * (x - F[1]) + F[2] * (y - F[2])) / k
    forces[i], works[i] = F, work
  end
  return forces, works
end
local paths <const> = {
  [2] = { {0.01}, {0.05}, {0.03}, {-0.05}, {-0.05}, {0.05}, {0.05} },
  [3] = { {0.01,0}, {0.04,0}, {0.04,0.03}, {0,0.03}, {-0.05,-0.01}, {0.02,0.02} },
}
for dim, path in pairs(paths) do
  local scene, contact = sheared(dim)
  local steps = {}
  for k, to in ipairs(path) do steps[k] = { move = { [contact] = dim == 2 and { to[1], 0.1 } or { to[1], to[2], 0.1 } } } end
  local s = dotyk.solve(scene, { steps = steps })
  check.that(s.converged and #s.steps == #path and s.steps[#path] == s)
  local limit, k = g * 2, E / 2 * 2 / 0.5
  local forces, works = slider(path, limit, k)
  local before = 0
  for i, t in ipairs(s.steps) do
    local c = t:contact(contact)
    check.near(c.friction_force[1], forces[i][1], 1e-11)
    if dim == 3 then check.near(c.friction_force[2], forces[i][2], 1e-11) end
    check.near(c.dissipated, works[i], 1e-12)
    check.near(t.friction_energy, works[i] - before, 1e-12)
    check.that(works[i] >= before)
    before = works[i]
  end
  -- The same one after the other, each continuing the last.
  local t
  for i = 1, #path do t = dotyk.solve(scene, { after = t, steps = { steps[i] } }) end
  check.near(t:contact(contact).friction_force, s:contact(contact).friction_force)
  check.near(t:contact(contact).dissipated, s:contact(contact).dissipated)
  check.near(t.energy, s.energy)
  -- One step to the end forgets the way there.
  t = dotyk.solve(scene, { steps = { steps[#path] } })
  check.near(t:contact(contact).friction_force[1], slider({ path[#path] }, limit, k)[1][1], 1e-11)
end

-- The same with a support by laws in place of the floor: the top moves instead, and the support tells what it dissipates.
do
  local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {2,0.5}, cells = {3,1}, element = "Q1" }, material = dotyk.material{ E = E, nu = 0 } }
  b:part "top":displace{ x = 1, y = 0 }
  local bottom <const> = b:part "bottom"
  bottom:support{ normal = dotyk.law.prescribed(0), tangential = dotyk.law.friction(g) }
  local limit <const>, k <const> = g * 2, E / 2 * 2 / 0.5
  local forces, works = slider(paths[2], limit, k)
  local steps = {}
  for i, to in ipairs(paths[2]) do steps[i] = { load = to[1] } end
  local scene <const> = dotyk.scene{ b }
  local s = dotyk.solve(scene, { steps = steps })
  check.that(s.converged and #s.steps == #steps)
  for i, t in ipairs(s.steps) do
    check.near(t:support(bottom).force[1], -forces[i][1], 1e-11)
    check.near(t:support(bottom).dissipated, works[i], 1e-12)
  end
  check.that(tostring(s):find(("dissipated %.6g"):format(works[#works]), 1, true))
  local t
  for i = 1, #steps do t = dotyk.solve(scene, { after = t, steps = { steps[i] } }) end
  check.near(t:support(bottom).dissipated, works[#works], 1e-12)
end

-- A shape that moves along its normal is a gap: down by d as a plane placed lower by d.
for _, d in ipairs{ 0.03, -0.02 } do
  local function pressed(y, move)
    local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = {8,4} },
                          material = dotyk.material{ E = 10, nu = 0.3 } }
    b:part "bottom":fix()
    local scene = dotyk.scene{ b }
    local c = scene:contact{ b:part "top", rigid = dotyk.rigid.plane{ point = {0, y}, normal = {0,-1} },
                             interference = true, friction = dotyk.friction.coulomb(0.2) }
    local s = dotyk.solve(scene, move and { steps = { { move = { [c] = { 0, move } } } } } or nil)
    return s, s:contact(c)
  end
  local s, c = pressed(1 - d)
  local t, moved = pressed(1, -d)
  check.near(t.energy, s.energy)
  check.near(moved.force, c.force, 1e-11)
  for i, node in ipairs(moved.nodes) do check.near(node.gap, c.nodes[i].gap) end
end

-- Sliding: a block dragged far by the floor rubs with mu times its weight, with given friction g times its base.
for _, case in ipairs{ { dotyk.friction.coulomb(0.4), 0.4 * 6 }, { dotyk.friction.tresca(0.7), 0.7 * 2 } } do
  for _, way in ipairs{ 1, -1 } do
    local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {2,0.5}, cells = {8,2} },
                          material = dotyk.material{ E = 1000, nu = 0.3 } }
    b:part "top":load{ 0, -3 }
    b:part "left":spring{ x = 100 }
    local scene = dotyk.scene{ b }
    local c = scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = case[1] }
    local s = dotyk.solve(scene, { steps = { {}, { move = { [c] = { way, 0 } } } } })
    local r = s:contact(c)
    check.equal({ r.slip, r.stick }, { 9, 0 })
    check.near(r.friction_force, { way * case[2], 0 }, 1e-12)
    check.near(r.force[2], 6, 1e-12)
    check.near((s:reaction(b:part "left")), -way * case[2], 1e-11)
  end
end

-- Load cases: factors stay until they change, and a number changes them all.
local function two_loads()
  local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} },
                        material = dotyk.material{ E = 10, nu = 0.3 } }
  b:part "left":fix()
  b:part "right":displace{ x = 0.02, case = "stretch" }
  b:part "top":load({ 0, -1 }, "press"):pressure(0.5)
  b:part "bottom":load{ 0.3, 0 }
  return b, dotyk.scene{ b }
end
local function single(stretch, press, rest)
  local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} },
                        material = dotyk.material{ E = 10, nu = 0.3 } }
  b:part "left":fix()
  b:part "right":displace{ x = 0.02 * stretch }
  b:part "top":load{ 0, -press }:pressure(0.5 * rest)
  b:part "bottom":load{ 0.3 * rest, 0 }
  return dotyk.solve(dotyk.scene{ b }), b
end
local body <const>, scene <const> = two_loads()
local s = dotyk.solve(scene, { steps = { {}, { load = { press = 0 } }, { load = { stretch = 2, press = 3 } }, {},
                                         { load = 0.5 }, { load = 0 }, { load = { press = -1 } } } })
local factors <const> = { {1,1,1}, {1,0,1}, {2,3,1}, {2,3,1}, {0.5,0.5,0.5}, {0,0,0}, {0,-1,0} }
check.equal(#s.steps, #factors)
for k, f in ipairs(factors) do
  local expected, other = single(table.unpack(f))
  check.near(s.steps[k].energy, expected.energy, 1e-13)
  check.near({ s.steps[k]:displacement(body, 1, 0.5) }, { expected:displacement(other, 1, 0.5) }, 1e-13)
  check.near({ s.steps[k]:reaction(body:part "right") }, { expected:reaction(other:part "right") }, 1e-12)
  check.near({ s.steps[k]:reaction(body:part "left") }, { expected:reaction(other:part "left") }, 1e-12)
end
check.near(dotyk.solve(scene).energy, s.steps[1].energy, 1e-13)

-- What is not a history is refused, at the step.
local shear <const>, floor <const> = sheared(2)
local function solve(options) return function() dotyk.solve(shear, options) end end
refused(solve{ steps = {} }, "'steps' is empty")
refused(solve{ steps = { { load = "all" } } }, "step 1: 'load' must be a table or a number")
refused(solve{ steps = { {}, { load = 0/0 } } }, "'steps': entry 2: 'load' must be a finite number, got nan")
refused(solve{ steps = { {}, { load = { 1 } } } }, "step 2: 'load' must be a factor, or a table of factors")
refused(solve{ steps = { { load = { press = 1 } } } }, "step 1: no load of the scene is of the case 'press'; none is of any")
refused(function() dotyk.solve(scene, { steps = { {}, { load = { pres = 1 } } } }) end, "step 2: 'load': no load case 'pres', did you mean 'press'?")
refused(function() dotyk.solve(scene, { steps = { { load = { wind = 1 } } } }) end, "no load of the scene is of the case 'wind'; its cases are 'press', 'stretch'")
refused(solve{ steps = { { move = { floor = { 1, 0 } } } } }, "step 1: 'move' must be a table of displacements by contact")
refused(solve{ steps = { { move = { [floor] = { 1, 0, 0 } } } } }, "must be a table of 2 finite numbers")
refused(solve{ steps = { { moved = {} } } }, "unknown key 'moved', did you mean 'move'?")
local _, stranger <const> = sheared(2)
refused(solve{ steps = { { move = { [stranger] = { 1, 0 } } } } }, "step 1: the contact of 'body' bottom with a rigid plane is not of this scene")
local pair <const>, upper <const> = (function()
  local function half(y)
    return dotyk.body{ name = "half " .. y, mesh = dotyk.mesh.rectangle{ from = {0,y}, to = {1,y+1}, cells = {4,4} },
                       material = dotyk.material{ E = 10, nu = 0.3 } }
  end
  local a, b = half(0), half(1)
  a:part "bottom":fix()
  b:part "top":load({ 0, -1 }, "press"):load({ 0.2, 0 }, "shear")
  local scene = dotyk.scene{ a, b }
  return scene, scene:contact{ b:part "bottom", a:part "top", friction = dotyk.friction.coulomb(0.4) }
end)()
refused(function() dotyk.solve(pair, { steps = { { move = { [upper] = { 1, 0 } } } } }) end, "has no rigid shape to move")
refused(function() dotyk.solve(pair, { steps = { {}, { load = { shear = 10 } } } }) end,
        "step 2: not held: nothing stops 'half 1': clockwise rotation about (1.09677, 0.758065)")
refused(function() dotyk.solve(pair, { after = dotyk.solve(shear) }) end, "'after' has other contact rows than the scene")

-- A step that does not converge, or is stopped, ends the history.
local cycle <const> = { { load = { shear = 0 } }, { load = { shear = 1.9 } }, { load = { shear = -1.9 } } }
local full = dotyk.solve(pair, { steps = cycle })
check.that(full.converged and full.steps[2].iterations > 1)
local short = dotyk.solver.newton{ max_iterations = 1 }:solve(pair, { steps = cycle })
check.equal({ short.converged, #short.steps }, { false, 2 })
check.that(short.reason:find("step 2 of 3: no convergence within 1 iterations", 1, true), short.reason)
local seen = {}
local stopped = dotyk.solver.newton{ on_iteration = function(k, info)
  seen[#seen + 1] = { info.step, k }
  return not (info.step == 2 and k == 1)
end }:solve(pair, { steps = cycle })
check.equal({ stopped.converged, #stopped.steps }, { false, 2 })
check.that(stopped.reason:find("step 2 of 3: interrupted", 1, true), stopped.reason)
check.equal(seen[1], { 1, 1 })
check.equal(seen[#seen], { 2, 1 })
check.near(stopped.steps[1].energy, full.steps[1].energy)

-- What a script adds to the scene afterwards is for the next solve, which may still follow the last.
check.equal(dotyk.solve(pair, { after = full, steps = { {} } }).steps[1]:contact(upper).friction_force[1] < 0, false)

-- The error of every step is estimated, also where elastic laws of supports take part in it; of the last one as of a single solve.
do
  local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {8,8} }, material = dotyk.material{ E = 1000, nu = 0.3 } }
  b:part "top":load{ 0.1, -1 }
  b:part "bottom":support{ normal = dotyk.law.one_sided_elastic(1), tangential = dotyk.law.friction(5) }  -- it sticks
  local scene <const> = dotyk.scene{ b }
  local s <const> = dotyk.solve(scene, { steps = { { load = 0.5 }, { load = 1 } } })
  local once <const>, parts <const> = dotyk.solve(scene):error_estimate()
  check.that(parts.laws > parts.recovery)
  for _, step in ipairs(s.steps) do check.near((step:error_estimate()), once, 1e-6) end
end
