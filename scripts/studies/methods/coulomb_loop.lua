-- Coulomb friction as a loop over given friction: where does it contract, and where does it end?
--
--   ./dotyk scripts/studies/methods/coulomb_loop.lua [FINEST]
--
-- A foot is pressed on a rigid plane and dragged along it, so that it slips throughout. Each step of the loop
-- solves with given bounds, then takes mu times the new pressure. Its contraction (the mean of the second half of
-- the steps) against mu on several meshes, for Poisson's ratios 0 and 0.3, beside Newton's method on Coulomb's law
-- itself; draws images/coulomb_loop.png.
--
-- What the numbers say. While all nodes slip, a step of the loop is linear: λ_n := W_nn⁻¹(x₀ − mu W_nt λ_n). Below a
-- flat foot on a half-plane W_nn⁻¹ W_nt is (1 − 2ν)/(2(1 − ν)) times the Hilbert transform, of norm one: the loop
-- contracts by mu (1 − 2ν)/(2(1 − ν)) on every mesh, that is by mu/2 for ν = 0, and ends to converge at mu = 2
-- (3.5 for ν = 0.3); refinement only brings the finite foot closer to that. Its eigenvalues are imaginary: the
-- change of one step may grow although that of two falls, hence the mean. Beyond the limit the bounds do not grow
-- for ever: pressures stay positive, nodes lift off and come back, and the change stays what it is (a contraction
-- of 1). An incompressible body would not couple at all. Newton's method has the coupling in its derivative and does not notice the limit: a few iterations beyond it.

local finest <const> = tonumber(arg[1]) or 128
local scenes <const> = include "../../lib/friction.lua"
local coefficients <const> = { 0.1, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6, 1.8, 2, 2.2, 2.5, 3, 4 }
local meshes <const> = {}
for _, n in ipairs{ 16, 32, 64, 128 } do if n <= finest then meshes[#meshes + 1] = n end end

local series = {}
for _, nu in ipairs{ 0, 0.3 } do
  local theory = (1 - 2 * nu) / (2 * (1 - nu))
  print(("\nPoisson's ratio %g: contraction in theory %.3f mu, the loop ends at mu = %.2f"):format(nu, theory, 1 / theory))
  print "          n    mu  stick/slip/open  Newton   loop  contraction  in theory  inner iterations  ends"
  for _, n in ipairs(meshes) do
    local x, y = {}, {}
    for _, mu in ipairs(coefficients) do
      local scene, contact = scenes.foot(n, dotyk.friction.coulomb(mu), nu)
      local newton = dotyk.solver.newton{}:solve(scene)
      local loop = dotyk.solver.coulomb_loop{ max_iterations = 300 }:solve(scene)
      local c = newton:contact(contact)
      local q = tonumber(loop.reason:match "multiplied by ([%d%.e+-]+) a step")
      print(("%11d  %4g  %5d/%4d/%4d  %6s  %5d  %11s  %9.3f  %16s  %s"):format(n, mu, c.stick, c.slip, c.open,
        newton.converged and newton.iterations or "none", loop.iterations, q and ("%.3f"):format(q) or "-", theory * mu,
        loop.reason:match "(%d+) iterations of newton", loop.converged and "" or loop.reason:match "^[^;]*"))
      assert(newton.converged)
      if loop.converged then assert(math.abs(loop.energy - newton.energy) < 1e-8 * math.abs(newton.energy)) end
      if mu * theory < 0.9 and c.stick == 0 then assert(loop.converged) end
      if q and c.stick == 0 then x[#x + 1], y[#y + 1] = mu, q end
    end
    if n == meshes[1] or n == meshes[#meshes] then
      series[#series + 1] = { name = ("ν = %g, n = %d"):format(nu, n), x = x, y = y }
    end
  end
  series[#series + 1] = { name = ("theory, ν = %g"):format(nu), x = { 0.1, 4 }, y = { 0.1 * theory, 4 * theory }, reference = true }
end
series[#series + 1] = { name = "no contraction above", x = { 0.1, 4 }, y = { 1, 1 }, reference = true }

dotyk.chart{ file = "images/coulomb_loop.png", log = "xy", x_range = { 0.08, 12 }, x = "coefficient of friction μ", y = "contraction of a step", series = series }
print "images/coulomb_loop.png"
