-- Where a method starts and how it ends early.
local check <const> = require "check"
local refused <const> = require "refused"

-- A punch whose active set takes several iterations to find.
local b <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1, nu = 0.3 },
                              mesh = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {32,16} } }
b:part "bottom":fix()
local scene <const> = dotyk.scene{ b }
local contact <const> = scene:contact{ b:part "top",
  rigid = dotyk.rigid.gap{ normal = {0,1}, gap = function(x) return x^2/4 - 0.02 end } }
local best <const> = dotyk.solve(scene)
check.that(best.converged and best.iterations >= 2, best.iterations)
function refused.intact() check.near(dotyk.solve(scene).energy, best.energy) end
local rows <const> = #best:contact(contact).nodes

for _, reduced in ipairs{ true, false } do
  local function with(options)
    options.reduced = reduced
    return dotyk.solver.pdas(options)
  end
  -- on_iteration sees every iteration, and may stop.
  local seen = {}
  local s = with{ on_iteration = function(k, info) seen[k] = info end }:solve(scene)
  check.equal(#seen, s.iterations)
  check.equal(#s.history, s.iterations)
  for k, info in ipairs(seen) do
    check.equal({ info.active, info.changed, info.residual }, { s.history[k].active, s.history[k].changed, s.history[k].residual })
  end
  check.equal(seen[#seen].changed, 0)
  s = with{ on_iteration = function(k) return k < 1 end }:solve(scene)
  check.equal({ s.converged, s.iterations }, { false, 1 })
  check.that(s.reason:find("interrupted", 1, true), s.reason)
  check.near(s.residual.equilibrium, 0)  -- a state in balance, though not the right one
  check.that(s:contact(contact).max_pressure > 0)
  -- Too few iterations: the rows that still change are named.
  s = with{ max_iterations = 1 }:solve(scene)
  check.equal({ s.converged, s.iterations }, { false, 1 })
  check.that(s.reason:find("rows that still change: node %d+ of 'block' at %("), s.reason)
  -- Stopping is only looked at: a last iteration that ends the method still converges.
  s = with{ on_iteration = function(_, info) return info.changed > 0 end }:solve(scene)
  check.that(s.converged)
  -- An error inside goes out at its own line.
  local ok, message = pcall(function() with{ on_iteration = function(k) if k == 2 then error "mine" end end }:solve(scene) end)
  check.that(not ok and message:find "stopping.lua:44: mine %(in 'on_iteration' of solve at [^ ]*stopping.lua:44%)$", message)
  refused.intact()
end
refused(function() dotyk.solver.pdas{ on_iteration = "often" } end, "'on_iteration' must be a function, got the string \"often\"")
refused(function() dotyk.solver.pdas{ max_iterations = 0 } end, "'max_iterations' must be an integer of at least 1, got the number 0")
refused(function() dotyk.solver.pdas{ maxiterations = 3 } end, "unknown key 'maxiterations', did you mean 'max_iterations'?")
refused(function() dotyk.solver.pdas{ tol = 0 } end, "'tol' must be a positive number")
refused(function() dotyk.solver.pdas{ rho = -1 } end, "'rho' must be a positive number")
refused(function() dotyk.solver.pdass{} end, "did you mean 'pdas'?")

-- Starts: any gives the same solution; rows that do not exist are refused.
local all <const> = {}
for row = 1, rows do all[row] = row end
for _, start in ipairs{ {}, { 1 }, { rows }, { 2, 2, 2 }, all, best } do
  local s = dotyk.solve(scene, { start = start })
  check.that(s.converged)
  check.near(s.energy, best.energy)
end
check.equal(dotyk.solve(scene, { start = best }).iterations, 1)
refused(function() dotyk.solve(scene, { start = { 1, rows + 1 } }) end, ("start names row %d; the scene has rows 1 to %d"):format(rows + 1, rows))
refused(function() dotyk.solve(scene, { start = { 0 } }) end, "start names row 0")
refused(function() dotyk.solve(scene, { start = { 1.5 } }) end, "'start': entry 1 must be an integer, got the number 1.5")
refused(function() dotyk.solve(scene, { start = { 1, nil, 3 } }) end, "'start': entry 2 must be an integer, got nil")
refused(function() dotyk.solve(scene, { start = "best" }) end, "'start' must be a solution or a table of integers")
refused(function() dotyk.solve(scene, { strat = best }) end, "unknown key 'strat', did you mean 'start'?")
refused(function() dotyk.solve(b) end, "argument 1 'scene' must be a scene, a beam or a plate, got a body")
refused(function() dotyk.solve() end, "argument 1 'scene' is missing")
