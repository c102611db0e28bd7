-- A free body under loads that balance each other to rounding is solved, up to its motions; one that they drive is refused.
local refused <const> = require "refused"
local function square(up)
  local body <const> = dotyk.body{ name = "a", material = dotyk.material{ E = 1, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 3, 3 } } }
  body:part "top":load{ 0, -1 }
  body:part "bottom":load{ 0, up }
  return dotyk.scene{ body }, body
end
for _, method in ipairs{ dotyk.solver.pdas{}, dotyk.solver.feti{ subdomains = 3 } } do
  local scene <const>, body <const> = square(1)
  local s <const> = method:solve(scene)
  assert(s.converged, s.reason)
  local _, top <const> = s:displacement(body, 0.5, 1)
  local _, bottom <const> = s:displacement(body, 0.5, 0)
  assert(math.abs(top - bottom + (1 - 0.3^2)) < 1e-6)  -- plane strain: (1 - nu^2)/E
  refused(function() method:solve((square(1.001))) end, "nothing stops")
end
