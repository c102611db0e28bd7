-- Glued bodies are one for FETI as for the direct method; its limits on steps are kept, Coulomb's outer loop included.
local steel <const> = dotyk.material{ E = 1000, nu = 0.3 }
local function block(name, x)
  return dotyk.body{ name = name, material = steel, force = { 0.1, -1 },
    mesh = dotyk.mesh.rectangle{ from = { x, 0 }, to = { x + 1, 1 }, cells = { 6, 6 } } }
end
local function glued(friction)
  local lower <const> = dotyk.body{ name = "lower", material = steel, mesh = dotyk.mesh.rectangle{ from = { 0, -1 }, to = { 2, 0 }, cells = { 12, 6 } } }
  lower:part "bottom":fix()
  local left <const>, right <const> = block("left", 0), block("right", 1)
  right:part "right":slide()
  local scene <const> = dotyk.scene{ lower, left, right }
  scene:glue{ left:part "right", right:part "left" }
  scene:contact{ left:part "bottom", lower:part("under left", function(x, _, _, ny) return ny > 0.9 and x < 1 end), friction = friction }
  scene:contact{ right:part "bottom", lower:part("under right", function(x, _, _, ny) return ny > 0.9 and x > 1 end), friction = friction }
  return scene, left
end

local scene <const>, left <const> = glued()
local direct <const> = dotyk.solver.pdas{ tol = 1e-12 }:solve(scene)
assert(direct.converged, direct.reason)
for _, subdomains in ipairs{ 3, 9 } do
  local s <const> = dotyk.solver.feti{ subdomains = subdomains, tol = 1e-10 }:solve(scene)
  assert(s.converged, s.reason)
  assert(math.abs(s.energy / direct.energy - 1) < 1e-7, s.energy / direct.energy - 1)
  local u <const>, v <const> = { s:displacement(left, 0.5, 1) }, { direct:displacement(left, 0.5, 1) }
  assert(math.abs(u[1] - v[1]) + math.abs(u[2] - v[2]) < 1e-7 * (math.abs(v[1]) + math.abs(v[2])))
end

local rubbing <const> = glued(dotyk.friction.coulomb(0.2))
local whole <const> = dotyk.solver.feti{}:solve(rubbing)
assert(whole.converged and whole.iterations > 4, whole.reason)
for most = 1, 4 do
  local s <const> = dotyk.solver.feti{ max_iterations = most }:solve(rubbing)
  assert(s.iterations <= most and not s.converged and s.reason:find "no convergence within", s.reason)
end
local s <const> = dotyk.solver.feti{ max_inner = 5 }:solve(rubbing)
assert(s.feti.inner <= 5 and not s.converged, s.reason)

-- The last penalty, in units of |PFP|: rho times 10 for each outer step of algorithm 4.1 after which |G lambda - e| is above eta.
local grown = 0
for _, case in ipairs{ { 30, 0.1 }, { 30, 1e-9 }, { 1, 1e-9 } } do
  local s <const> = dotyk.solver.feti{ update = "penalty", rho = case[1], eta = case[2], M = 1000 }:solve(scene)
  assert(s.converged, s.reason)
  local times <const> = math.log(s.feti.rho / case[1], 10)
  assert(math.abs(times - math.floor(times + 0.5)) < 1e-9 and times >= 0, s.feti.rho)
  grown = grown + times
end
assert(grown > 0)
assert(dotyk.solver.feti{ update = "precision", rho = 7 }:solve(scene).feti.rho == 7)

-- The paper's stopping rule: |d| is above |P d| here, so that it ends no later.
local own <const>, paper <const> = dotyk.solver.feti{ tol = 1e-3 }:solve(scene), dotyk.solver.feti{ tol = 1e-3, stop = "d" }:solve(scene)
assert(own.converged and paper.converged and paper.feti.inner <= own.feti.inner)
