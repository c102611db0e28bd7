-- What the makers of the methods for friction refuse, and what their solutions tell.
local refused <const> = require "refused"
local solver <const> = dotyk.solver

refused(function() solver.uzawa{ rho = 0 } end, "'rho' must be a positive number")
refused(function() solver.uzawa{ omega = 1 } end, "unknown key 'omega'")
refused(function() solver.psor{ omega = 2.5 } end, "'omega'", "2.5")
refused(function() solver.psor{ omega = 0 } end, "'omega'")
refused(function() solver.uzawa_pdas{ unit = "force" } end, "'unit'", "\"force/displacement\"")
refused(function() solver.coulomb_loop{ inner = "newton" } end, "'inner'", "a solver")
refused(function() solver.coulomb_loop{ inner = solver.pdas{} } end, "which cannot treat friction", "newton, proximal, uzawa, uzawa_pdas, psor, projected_cg and coulomb_loop can")

local function foot(mu)
  local block = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {8, 4} } }
  block:part"bottom":displace{ x = 0.5, y = 0.05 }
  local scene = dotyk.scene{ block }
  return scene, scene:contact{ block:part"top", rigid = dotyk.rigid.plane{ point = {0, 1}, normal = {0, -1} },
                               friction = dotyk.friction.coulomb(mu) }
end
refused(function() solver.pdas{}:solve((foot(0.3))) end, "pdas cannot treat the Coulomb friction", "uzawa_pdas")

-- Every one of them, by name; a loop within a loop is a loop.
local scene <const>, contact <const> = foot(0.3)
local newton <const> = solver.newton{}:solve(scene)
local methods <const> = { uzawa = {}, uzawa_pdas = {}, psor = { omega = 1.1 }, projected_cg = {}, proximal = {}, coulomb_loop = {} }
for name, options in pairs(methods) do
  local s = solver[name](options):solve(scene)
  assert(s.converged and s.method == name, name)
  assert(math.abs(s.energy - newton.energy) < 1e-9 * newton.energy, name)
  local c = s:contact(contact)
  assert(c.slip == newton:contact(contact).slip, name)
  for _, node in ipairs(c.nodes) do
    local shear = math.sqrt(node.shear[1]^2 + node.shear[2]^2)
    assert(node.pressure >= 0 and shear <= 0.3 * node.pressure * (1 + 1e-8) + 1e-12, name)
  end
  local within = solver.coulomb_loop{ inner = solver[name](options) }:solve(scene)
  assert(within.converged and within.reason:find(" of " .. name .. " in all", 1, true), name)
end

-- Contraction: told from the third step on, until the change is rounding.
local loop <const> = solver.coulomb_loop{}:solve(scene)
assert(not pcall(function() return loop.history[1].contraction end))
local q <const> = loop.history[4].contraction
assert(q > 0 and q < 0.3)

-- Stopped in the second step of the loop: the state so far, and no solution.
local stopped <const> = solver.coulomb_loop{ on_iteration = function(k) return k < 2 end }:solve(scene)
assert(not stopped.converged and stopped.iterations == 2 and stopped.reason:find("interrupted", 1, true))

-- A step beyond the bound is told.
local far <const> = solver.uzawa{ rho = 3, max_iterations = 20 }:solve(scene)
assert(not far.converged and far.reason:find("beyond which steps need not converge", 1, true))
