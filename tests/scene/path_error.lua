-- What one load step leaves out of friction's path, by closed forms.
local check <const> = require "check"

-- A stiff block on springs of 100 above a plane, pushed sideways by 1, and down (or the plane moves up) so that a share tau of it closes
-- the gap. Stuck from then on, friction bears 1 - tau; after n steps 1 - floor(n tau)/n, where the last step before it touched has left it.
local function friction(tau, steps, moved)
  local gap <const> = 0.01
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1e7, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = {0, gap}, to = {1, 1 + gap}, cells = {2, 2}, element = "Q1" } }
  block:part"bottom":spring{ x = 100 }
  block:part"bottom":load{ 1, 0 }
  block:part"top":spring{ y = 100 }
  if not moved then block:part"top":load{ 0, -100 * gap / tau } end
  local it <const> = dotyk.scene{ block }
  local contact <const> = it:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} },
                                      friction = dotyk.friction.coulomb(1000) }
  local list <const> = {}
  for k = 1, steps do list[k] = { load = k / steps, move = moved and { [contact] = { 0, gap / tau * k / steps } } or nil } end
  local s <const> = dotyk.solve(it, { steps = list })
  check.that(s.converged, s.reason)
  local sum = 0
  for _, node in ipairs(s:contact(contact).nodes) do sum = sum + node.shear[1] * node.weight end
  return -sum, s
end

for _, tau in ipairs{ 0.3, 0.45, 0.7, 0.9 } do
  local left <const> = math.floor(8 * tau) / 8
  for _, moved in ipairs{ false, true } do
    local one <const>, s <const> = friction(tau, 1, moved)
    check.near(one, 1, 1e-3, "one step") -- the block's strain
    check.near(s:path_error(), left / (1 - left), 2e-3 / (1 - left), "path_error")
    check.that(s.reason:find("one load step from rest, while friction follows the path of the load: path_error()", 1, true), "the reason says so: " .. s.reason)
    check.that(tostring(s):find("from those of eight steps", 1, true), "and so does print")
    for _, n in ipairs{ 2, 16, 128 } do check.near(friction(tau, n, moved), 1 - math.floor(n * tau + 1e-3) / n, 2e-3, n .. " steps") end
  end
end

-- Touching from the start: a part of the load has that part of the solution, and steps change nothing.
local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
  mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {6, 6} } }
block:part"top":load{ 3, -10 }
local it <const> = dotyk.scene{ block }
it:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = dotyk.friction.coulomb(0.4) }
local s <const> = dotyk.solve(it)
check.near(s:path_error(), 0, 0)
check.that(not s.reason:find("path", 1, true), s.reason)

-- Where all slips, friction is its bound, whatever the path: found out by steps, not guessed.
local slipping <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1e7, nu = 0 },
  mesh = dotyk.mesh.rectangle{ from = {0, 0.01}, to = {1, 1.01}, cells = {2, 2}, element = "Q1" } }
slipping:part"bottom":spring{ x = 100 }
slipping:part"bottom":load{ 1, 0 }
slipping:part"top":spring{ y = 100 }
slipping:part"top":load{ 0, -2 }
local floor <const> = dotyk.scene{ slipping }
floor:contact{ slipping:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = dotyk.friction.coulomb(0.1) }
local slipped <const> = dotyk.solve(floor)
check.that(slipped.reason:find("friction follows the path", 1, true) and not slipped.reason:find("%", 1, true), slipped.reason)
check.near(slipped:path_error(), 0, 1e-8)
check.that(tostring(slipped):find("eight steps give the same", 1, true))

-- It speaks of one step from rest.
local _, stepped <const> = friction(0.3, 4)
check.error(function() stepped:path_error() end, "follows another")

-- 5. A contact without friction that closes on the way: bodies slip before it stops them, and friction is less after more steps.
do
  local body <const> = dotyk.body{ name = "slider", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 4, 1 }, cells = { 16, 4 }, element = "Q1" } }
  body:part"top":load{ 1.5, -3 }
  local scene <const> = dotyk.scene{ body }
  scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }, friction = dotyk.friction.coulomb(0.3) }
  scene:contact{ body:part("stop", function(x, y) return x > 4 - 1e-9 and y > 0.4 end), rigid = dotyk.rigid.plane{ point = { 4.003, 0 }, normal = { -1, 0 } } }
  local s <const> = dotyk.solve(scene)
  check.that(s.converged and s.reason:find("friction follows the path", 1, true), s.reason)
  check.that(s:path_error() > 0.1)
  local cut <const> = dotyk.solver.psor{ max_iterations = 2 }:solve(scene)
  check.error(function() cut:path_error() end, "does not apply")
end

-- 6. The same floor stated as a support: one mechanics, one path error.
do
  local function on(floor)
    local body <const> = dotyk.body{ name = "slider", material = dotyk.material{ E = 1000, nu = 0.3 },
      mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 4, 1 }, cells = { 16, 4 }, element = "Q1" } }
    body:part"top":load{ 1.5, -3 }
    local scene <const> = dotyk.scene{ body }
    if floor then scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }, friction = dotyk.friction.coulomb(0.3) }
    else body:part"bottom":support{ normal = dotyk.law.signorini(), tangential = dotyk.friction.coulomb(0.3) } end
    scene:contact{ body:part("stop", function(x, y) return x > 4 - 1e-9 and y > 0.4 end), rigid = dotyk.rigid.plane{ point = { 4.003, 0 }, normal = { -1, 0 } } }
    local s <const> = dotyk.solve(scene)
    check.that(s.reason:find("friction follows the path", 1, true), s.reason)
    return s:path_error()
  end
  check.that(on(true) > 0.1)
  check.near(on(false), on(true), 1e-6)
end

-- 7. Given friction is no cone: where nothing closed, steps may still matter, and that is found out by taking them.
do
  local body <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {6, 6} } }
  body:part"top":load{ 3, -10 }
  body:part"left":spring{ x = 100, y = 100 }
  local scene <const> = dotyk.scene{ body }
  local c <const> = scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = dotyk.friction.tresca(1.5) }
  local one <const> = dotyk.solve(scene)
  local steps <const> = {}
  for k = 1, 8 do steps[k] = { load = k / 8 } end
  local eight <const> = dotyk.solve(scene, { steps = steps })
  local apart, sum = 0, 0
  for k, node in ipairs(eight:contact(c).nodes) do
    apart, sum = apart + node.weight * math.abs(node.shear[1] - one:contact(c).nodes[k].shear[1]), sum + node.weight * math.abs(node.shear[1])
  end
  check.near(one:path_error(), apart / sum, 1e-6)
end

-- 8. All slips at the end, and the way matters all the same: the block goes uphill before it touches the slope, and downhill once it is pressed on it.
do
  local c <const>, s <const> = math.cos(0.3), math.sin(0.3)
  local body <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1e6, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 2, 2 }, element = "Q1" }:transform(function(x, y) return c * x - s * y, s * x + c * y end) }
  body:part"bottom":spring{ x = 100 }
  body:part"top":spring{ y = 100 }
  body:part"bottom":load{ 1, 0 }
  body:part"top":load{ 0, -2 }
  local scene <const> = dotyk.scene{ body }
  local contact <const> = scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = { 0.01 * s, -0.01 * c }, normal = { -s, c } }, friction = dotyk.friction.coulomb(0.2) }
  local solution <const> = dotyk.solve(scene)
  check.equal(solution:contact(contact).stick, 0)
  check.that(solution:path_error() > 0.1)
  check.that(not solution.reason:find("%", 1, true), solution.reason) -- no share that says how little
end
