-- Supports by laws start as a coarser or an earlier solution ended, as contacts do.
local check <const> = require "check"

-- A strip pressed in the middle: it lifts on either side of that, and bears far away.
local function strip(n, law)
  local b <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {-8, 0}, to = {8, 1}, cells = {16 * n, 2 * n} }, material = dotyk.material{ E = 1000, nu = 0.3 } }
  b:part "bottom":support{ normal = law, tangential = dotyk.law.elastic(100) }
  b:part "top":load(function(x) return 0.1, -5 * math.exp(-x^2) - 0.02 end)
  return dotyk.scene{ b }, b:part "bottom"
end

for name, law in pairs{ signorini = dotyk.law.signorini(), elastic = dotyk.law.one_sided_elastic(1e4), unequal = dotyk.law.unequal_elastic(1e4, 0) } do
  local scene <const>, bottom <const> = strip(4, law)
  for _, solver in ipairs{ dotyk.solver.pdas{}, dotyk.solver.pdas{ reduced = false }, dotyk.solver.newton{} } do
    local cold <const> = solver:solve(scene)
    local support <const> = cold:support(bottom)
    check.that(cold.converged and cold.iterations > 4 and support.open > 0 and support.closed > 0, name)
    -- From its own end: nothing is left to do.
    local again <const> = solver:solve(scene, { start = cold })
    check.that(again.converged and again.iterations <= 1, ("%s, %s: %d iterations from the solution, %d from rest"):format(name, cold.method, again.iterations, cold.iterations))
    check.near(again.energy, cold.energy, 1e-9 * math.abs(cold.energy), name)
    -- From a coarser mesh: fewer steps than from rest.
    local coarse <const> = solver:solve((strip(2, law)))
    local fine <const> = solver:solve(scene, { start = coarse })
    check.that(fine.converged and fine.iterations < cold.iterations, ("%s, %s: %d iterations from a coarser solution, %d from rest"):format(name, cold.method, fine.iterations, cold.iterations))
    check.near(fine.energy, cold.energy, 1e-9 * math.abs(cold.energy), name)
  end
end
