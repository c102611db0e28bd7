-- Stability atlas: the parameter ρ of active sets and of Newton's method, over twelve decades and more.
--
--   ./dotyk scripts/studies/stability/rho.lua [CELLS]
--
-- pdas is Newton's method on λ = π(λ + ρ(Bu − c)). After its first linear solve λ·x = 0 on every row, so a sign of λ
-- + ρx is the sign of λ or that of x: ρ chooses the first set, then drops out (TR965 1.2.1). With friction a slipping
-- point has neither zero slip nor a force inside its bound, and ρ stays. Then λ + ρx is known to rounding ε = 2.2e-16
-- of λ or of ρx: forces to ερ, jumps to ε/ρ of what the rows see, so that tol could be met between ρ = ε/tol and tol/ε
-- were jumps differences of what loads and forces make. Where that matters they are computed from the state's own
-- displacements, and ρ may be less and far greater. Where Newton's method loses its way dotyk hands the problem over to other methods, with
-- ρ = 1, and the reason says so: here that is no success of Newton's ("other"). Iterations against ρ, in units of the
-- stiffness that a row sees; then both ends by bisection, for several tol. Every state that is called converged,
-- whichever method found it, is compared with that of another method. Draws images/stability_rho.png (iterations) and
-- images/stability_rho_tol.png (ends).

local n <const> = tonumber(arg[1]) or 32
local common <const> = include "../../lib/common.lua"
local scenes <const> = include "../../lib/friction.lua"

local function punch() return common.punch(n) end
local m <const> = math.max(4, n // 4)
local coulomb <const>, given <const> = dotyk.friction.coulomb(0.3), dotyk.friction.tresca(2.5)
local cases <const> = {
  { "PDAS", "pdas", dotyk.solver.active_set{}, punch },
  { "PDAS, space", "pdas", dotyk.solver.active_set{}, function() return scenes.cube(m) end },
  { "given", "newton", dotyk.solver.projected_cg{}, function() return scenes.lifted(n, given) end },
  { "Coulomb", "newton", dotyk.solver.coulomb_loop{}, function() return scenes.lifted(n, coulomb) end },
  { "Coulomb, space", "newton", dotyk.solver.psor{ omega = 1.2 }, function() return scenes.cube(m, coulomb) end },
}

-- By the method itself and its own test, not by one that it handed over to, nor by what judges any method's state.
local function alone(s)
  local own <const> = s.reason:find "^the residual fell below tol" or s.reason == "active set confirmed"
  return s.converged and own and not s.reason:find("newton lost its way", 1, true)
end

local series, wrong, rescued, lost = {}, 0, 0, 0
local pdas_spread, small_spread, most_pdas = 0, 0, 0
local header = "iterations at ρ =          "
for power = -8, 8 do header = header .. ("%6s"):format("1e" .. power) end
print(header)
for _, case in ipairs(cases) do
  local name, method, other, build = table.unpack(case)
  local scene, contact = build()
  local exact = other:solve(scene)
  assert(exact.converged, exact.reason)
  local curve, line, first, missed = common.curve(name), ("%-27s"):format(name), nil, {}
  for power = -8, 8 do
    local s = dotyk.solver[method]{ rho = 10.0^power, max_iterations = 100 }:solve(scene)
    if s.converged and (common.apart(s, exact, contact) > 1e-6 or common.residual(s) > 1e-8) then wrong = wrong + 1 end
    if alone(s) then
      if power >= -5 then first = first or s.iterations end
      local differs = math.abs(s.iterations - (first or s.iterations))
      if method == "pdas" then pdas_spread, most_pdas = math.max(pdas_spread, differs), math.max(most_pdas, s.iterations)
      elseif power <= 0 and power >= -5 then small_spread = math.max(small_spread, differs) end
      curve:add(10.0^power, s.iterations)
    else
      missed[#missed + 1] = 10.0^power
      if s.converged then rescued = rescued + 1 else lost = lost + 1 end
    end
    line = line .. ("%6s"):format(alone(s) and s.iterations or s.converged and "other" or "-")
  end
  print(line)
  series[#series + 1] = curve
  if #missed > 0 then series[#series + 1] = { x = missed, twin = true, crossed = true, style = "points" } end
end
dotyk.chart{ file = "images/stability_rho.png", title = "PDAS, and Newton with friction", log = "xy", x = "ρ / stiffness of a contact row", y = "iterations", series = series }

-- 2. Both ends, Coulomb friction in the plane.
local scene <const>, contact <const> = scenes.lifted(n, coulomb)
local exact <const> = dotyk.solver.newton{}:solve(scene)
local ends <const> = { common.curve("least ρ", { style = "points" }), common.curve("greatest ρ", { style = "points" }) }
local laws <const> = { common.curve("ε/tol, ε = 2⁻⁵²", { reference = true }), common.curve("tol/ε", { reference = true }) }
local short = 0 -- of the ends, 1 where they are met
print "\n  tol   least ρ    ε/tol   greatest ρ    tol/ε"
for power = -11, -6 do
  local tol = 10.0^power
  local function holds(rho)
    local s = dotyk.solver.newton{ rho = rho, tol = tol, max_iterations = 30 }:solve(scene)
    if s.converged and common.apart(s, exact, contact) > 1e3 * tol then wrong = wrong + 1 end
    return alone(s)
  end
  local least = 1 / common.boundary(1, 1e16, function(inverse) return holds(1 / inverse) end, 0.1)
  local greatest = common.boundary(1, 1e16, holds, 0.1)
  local epsilon <const> = 2.0^-52
  ends[1]:add(tol, least)
  ends[2]:add(tol, greatest)
  laws[1]:add(tol, epsilon / tol)
  laws[2]:add(tol, tol / epsilon)
  print(("%.0e   %.1e  %.1e      %.1e  %.1e"):format(tol, least, epsilon / tol, greatest, tol / epsilon))
  short = math.max(short, least * tol / epsilon, tol / epsilon / greatest)
end
dotyk.chart{ file = "images/stability_rho_tol.png", log = "xy", x = "tolerance tol", y = "ρ / stiffness of a contact row", series = { ends[1], ends[2], laws[1], laws[2] } }
print "images/stability_rho.png, images/stability_rho_tol.png"

common.verdict(wrong == 0 and lost == 0 and rescued > 0 and pdas_spread == 0 and small_spread <= 5 and short < 1, ("pdas takes the same %d iterations at most for every ρ from 1e-8 "
  .. "to 1e8; Newton's method with friction the same but for %d from 1e-5 up to ρ = 1, its default, and can meet tol from below ρ = ε/tol to above tol/ε (by factors of %.2g and more), "
  .. "beyond which other methods solve all %d cases that it loses"):format(most_pdas, small_spread, 1 / short, rescued))
