-- A soft support alone holds the block that slides on given friction: steps with springs on its motion crawl, the step without them ends it.
local check <const> = require "check"

local function solve(method, soft)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1e6, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {8, 4}, element = "Q1" } }
  local scene <const> = dotyk.scene{ block }
  scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = dotyk.friction.tresca(5) }
  local support <const> = block:part "right":support{ normal = dotyk.law.one_sided_elastic(soft) }
  block:part "top":load{ 20, -50 }
  local s <const> = method:solve(scene)
  check.that(s.converged, s.reason)
  local force <const> = s:support(support).force
  check.near(force[1], -(2 * 20 - 2 * 5), 1e-8 * 30) -- load less friction, which slips everywhere
  return s.iterations
end

for _, soft in ipairs{ 1e4, 1e2, 1, 0.01 } do
  local iterations <const> = solve(dotyk.solver.proximal{}, soft)
  check.that(iterations <= 15, ("%d iterations at a support of %g"):format(iterations, soft))
  solve(dotyk.solver.newton{}, soft)
end
