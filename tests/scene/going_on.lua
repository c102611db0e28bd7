-- A method that is stopped goes on from its state: where iterations depend on the iterate alone, as if it had not been stopped;
-- where they remember more, no worse than it was.
local check <const> = require "check"

local function scene(free)
  local body <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {-1, 0}, to = {1, 1}, cells = {12, 6} } }
  if not free then body:part"left":fix "x" end
  body:part"top":load{ free and 0 or 3, -10 }
  local it <const> = dotyk.scene{ body }
  it:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = not free and dotyk.friction.coulomb(0.3) or nil }
  return it
end

local function last(s) return s.history[#s.history].residual end

for _, free in ipairs{ false, true } do
  for name, options in pairs{ uzawa = { rho = 0.3 }, psor = { omega = 0.5 }, uzawa_pdas = {}, coulomb_loop = {}, projected_cg = {}, proximal = {}, newton = {} } do
    local function solver(iterations)
      local all <const> = { max_iterations = iterations, tol = 1e-13 }
      for key, value in pairs(options) do all[key] = value end
      return dotyk.solver[name](all)
    end
    local count <const> = (name == "uzawa" or name == "psor") and 20 or name == "projected_cg" and 8 or 1 -- its energy falls at every step, its residual in the long run
    local it <const> = scene(free)
    local part <const>, whole <const> = solver(count):solve(it), solver(2 * count):solve(it)
    local on <const> = solver(count):solve(it, { start = part })
    if not part.converged then
      check.that(last(on) < last(part), ("%s: %g after %g"):format(name, last(on), last(part)))
      -- Free bodies' equilibrium is settled by a multiplier that the state shows but in its jump.
      if not free and (name == "uzawa" or name == "psor" or name == "uzawa_pdas" or name == "coulomb_loop") then
        check.near(last(on), last(whole), 1e-6 * last(whole) + 1e-13, name)
      end
    end
    -- From a solution nothing is left to do.
    local solved <const> = dotyk.solver[name]{ max_iterations = 5000 }:solve(it)
    if solved.converged then check.that(dotyk.solver[name]{ max_iterations = 5000 }:solve(it, { start = solved }).iterations <= 3, name) end
  end
end

-- Methods on all unknowns go on from the whole state, named or by default.
do
  local scenes <const> = include "../../scripts/lib/scale_scenes.lua"
  local there <const> = pcall(dotyk.solver.multigrid().solve, dotyk.solver.multigrid(), scenes.cube(2, {})) -- is PETSc?
  for _, friction in ipairs{ false, 0.3 } do
    local it <const> = scenes.cube(friction and 24 or 20, { friction = friction or nil })
    for name, solve in pairs{ default = dotyk.solve, pdas = function(...) return dotyk.solver.pdas{ reduced = false }:solve(...) end } do
      local solved <const> = solve(it)
      local on <const> = solve(it, { start = solved })
      if name == "default" and there then check.equal(solved.method, "multigrid") end
      check.that(on.converged and on.iterations < math.max(2, solved.iterations), ("%s: %d iterations after %d"):format(name, on.iterations, solved.iterations))
      check.near(on.energy, solved.energy, 1e-9 * math.abs(solved.energy), name)
    end
  end
end
