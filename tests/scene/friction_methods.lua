-- What the makers of the methods for friction refuse, and what their solutions tell.
local refused <const> = require "refused"
local solver <const> = dotyk.solver

refused(function() solver.uzawa{ rho = 0 } end, "'rho' must be a positive number")
refused(function() solver.uzawa{ omega = 1 } end, "unknown key 'omega'")
for _, omega in ipairs{ 0, 2, 2.5 } do
  refused(function() solver.psor{ omega = omega } end, "'omega' must be a number above 0 and below 2, got the number " .. omega)
end
refused(function() solver.uzawa_pdas{ unit = "force" } end, "'unit'", "\"force/displacement\"")
refused(function() solver.coulomb_loop{ inner = "newton" } end, "'inner'", "a solver")
refused(function() solver.coulomb_loop{ inner = solver.pdas{} } end, "does not work on contact rows alone with friction", "newton, proximal, uzawa, uzawa_pdas, psor, projected_cg and coulomb_loop do")

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

-- A method is printed with the options that change what it does.
assert(tostring(solver.newton{ watch = true, seed = 7 }) == "solver newton: rho = 1, watch, seed = 7, tol = 1e-10, max_iterations = 100")
assert(tostring(solver.newton{}) == "solver newton: rho = 1, tol = 1e-10, max_iterations = 100")
assert(tostring(solver.pdas{ kernel = "screws", screws = { 3, 1 }, ordering = "minimum_degree" }) ==
  "solver pdas: rho = 1, reduced, kernel by screws first at rows 3, 1, tol = 1e-10, max_iterations = 100, ordering = minimum_degree")

-- Bounds and coefficients.
for _, law in ipairs{ dotyk.friction.tresca, dotyk.friction.coulomb } do
  refused(function() law(0/0) end, "must be a finite number, got nan (not a number)")
  refused(function() law(-1) end, "must be a number of at least 0", "got the number -1")
  refused(function() law "2" end, "or a function, got the string \"2\"")
  refused(function() law{ 1 } end, "or a function, got a table")
end
refused(function() dotyk.friction.tresca(-1/0) end, "got the number -inf")
refused(function() dotyk.friction.coulomb(1/0) end, "'mu' must be a finite number, got inf")
assert(tostring(dotyk.friction.tresca(1/0)) == "law: friction inf")

-- Each that the refusal names.
local _, message = pcall(function() solver.pdas{}:solve(scene) end)
local named <const> = {}
for name in message:match("; ([^;]*) can$"):gmatch "[%w_]+" do if name ~= "and" then named[#named + 1] = name end end
assert(#named == 8, message)
for _, name in ipairs(named) do
  local s = solver[name]{}:solve(scene)
  assert(s.converged and math.abs(s.energy - newton.energy) < 1e-8 * newton.energy, name)
end

-- Two contacts on one part with given friction, which the lower one has though it is open: where both stick their multipliers depend on each
-- other. Friction is that of one contact with both bounds.
local function pushed(bounds, steps)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {8, 4} } }
  block:part"top":load{ 0, -5 }
  block:part"left":load{ 4, 0 }
  block:part"right":spring{ x = 1 }
  local scene <const> = dotyk.scene{ block }
  local ground <const> = { dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, dotyk.rigid.gap{ normal = {0, -1}, gap = 0.1 } }
  for k, bound in ipairs(bounds) do scene:contact{ block:part"bottom", rigid = ground[k], friction = dotyk.friction.tresca(bound) } end
  local s <const> = dotyk.solve(scene, { steps = steps })
  assert(s.converged and s.method == "newton" and not s.reason:find "fixed point", s.reason)
  return s
end
for _, steps in ipairs{ { { load = 1 } }, { { load = 1 }, { load = 0.3 } } } do
  local one <const>, two <const> = pushed({ 1.5 }, steps), pushed({ 1, 0.5 }, steps)
  assert(math.abs(one.energy - two.energy) < 1e-9 * math.abs(pushed({ 1.5 }, { { load = 1 } }).energy), ("%.12g, not %.12g"):format(two.energy, one.energy))
end
