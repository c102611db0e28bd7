-- What shape:optimise refuses is an error at the line that asked for it; errors in functions of a script keep their own line.
local refused <const> = require "refused"
local check <const> = require "check"
local nan <const> = 0/0

local function pressed(load, change)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {-1, 0}, to = {1, 1}, cells = {8, 4} } }
  block:part "top":load{ 0, load }
  block:part "left":fix "x"
  local scene <const> = dotyk.scene{ block }
  scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
  local it <const> = { scene = scene, moves = { { part = block:part "bottom", control_points = 5, direction = {0, 1}, lower = -1, upper = 0.05 } } }
  for key, value in pairs(change or {}) do
    if it[key] == nil then it[key] = value else for name, entry in pairs(value) do it[key][1][name] = entry end end
  end
  return dotyk.shape(it)
end
local it <const> = pressed(-1)
refused.intact = function() check.near(it:design().volume.value, 2) end

-- Options.
refused(function() it:optimise{ method = "sqp" } end, "'method'", 'did you mean "slp"?')
refused(function() it:optimise{ radius = 0 } end, "'radius'", "above 0")
refused(function() it:optimise{ radius = 2 } end, "'radius'", "at most 1")
refused(function() it:optimise{ tol_design = 0 } end, "'tol_design'", "positive")
refused(function() it:optimise{ tol_gap = nan } end, "'tol_gap'", "nan")
refused(function() it:optimise{ max_designs = 0 } end, "'max_designs'")
refused(function() it:optimise{ start = { 0 } } end, "'start' has 1 components; there are 5 design variables")
refused(function() it:optimise{ start = { nan, 0, 0, 0, 0 } } end, "'start'", "nan")
refused(function() it:optimise{ start = { 1, 0, 0, 0, 0 } } end, "design variable 1 starts at 1, outside its bounds -1 and 0.05")
refused(function() it:optimise{ start = it } end, "'start'", "an optimum", "got a shape")
refused(function() it:optimise{ on_design = 3 } end, "'on_design' must be a function")
refused(function() it:optimise{ on_desing = print } end, "'on_desing'", "did you mean 'on_design'?")
for _, pattern in ipairs{ "a.png", "a%s.png", "a%d%d.png", "a%999d.png", "a%-3d.png", "a%.png", "a%%d.png", "" } do
  refused(function() it:optimise{ figures = pattern } end, "'figures' is", "as images/shape_%03d.png does")
end
refused(function() it:optimise{ figures = "nowhere/a%d.png" } end, "nowhere/a1.png", "No such file")
refused(function() it:optimise{ figures = "a%d.pgn" } end, "a1.pgn", "must end in .png")
refused(function() it:optimise{ file = "nowhere/a.lua" } end, "nowhere/a.lua", "No such file")

-- The first design.
refused(function() pressed(-1, { moves = { start = -0.5 } }):optimise() end, "the first design is not admissible", "the rigid plane penetrates the part by 0.5")
refused(function() pressed(1):optimise() end, "the first design is not admissible", "not held", "'block'")
refused(function() pressed(-1, { moves = { upper = 2, start = 2 } }):optimise() end, "the first design is not admissible", "inverted")
refused(function() pressed(-1, { method = dotyk.solver.uzawa{ max_iterations = 2 } }):optimise() end, "the first design is not admissible", "did not converge")
refused(function() pressed(-1, { method = dotyk.solver.penalty{} }):optimise() end, "penalised")
refused(function() pressed(-1, { moves = { lower = 0, upper = 0.05, start = 0.05 }, differences = 5 }):optimise() end, "the design at 5 beside in variable 1", "not admissible")

-- What functions return, for each method (NLopt's are C).
for _, method in ipairs{ "slp", "mma", "ccsaq", "slsqp" } do
  local function least(objective, constraint)
    return pressed(-1, { moves = { lower = 0, upper = 0.005, start = { 0.003, 0.001, 0.001, 0.002, 0.003 } }, objective = objective, constraints = constraint and { { quantity = constraint, most = 1 } } or nil })
  end
  local function after(designs, value) -- that, of later designs
    local count = 0
    return function(d)
      count = count + 1
      if count > designs then return value(d) end
      return d.peak_pressure
    end
  end
  for _, returned in ipairs{ "low", {}, true, { value = 1, gradient = { 1 } } } do
    refused(function() least(function() return returned end):optimise{ method = method } end, "the function of the objective returned", "a number or a dual number")
    refused(function() least(after(2, function() return returned end)):optimise{ method = method } end, "the function of the objective returned", "a number or a dual number")
  end
  refused(function() least(function(d) return d.compliance.value end):optimise{ method = method } end, "which has no derivatives")
  refused(function() least(function() end):optimise{ method = method } end, "the function of the objective returned nil")
  refused(function() least(function() return nan end):optimise{ method = method } end, "the function of the objective returned nan (not a number)")
  refused(function() least(function() return 1/0 end):optimise{ method = method } end, "the function of the objective returned inf")
  refused(function() least(after(1, function(d) return d.compliance * nan end)):optimise{ method = method } end, "returned nan")
  refused(function() least(function(d) return dotyk.dual.sqrt(d.alpha[1]) end):optimise{ method = method } end, "returned 0, whose derivative by design variable 1 is infinite")
  refused(function() least("volume", function() return "full" end):optimise{ method = method } end, "the function of constraint 1 returned", '"full"')
  refused(function() least(function() error "own fault" end):optimise{ method = method } end, "own fault", "in 'objective' of optimise")
  refused(function() least(after(2, function() error "own fault" end)):optimise{ method = method } end, "own fault", "in 'objective' of optimise")
  refused(function() least("peak_pressure", after(2, function() error "own fault" end)):optimise{ method = method } end, "own fault", "in 'constraint 1' of optimise")
  refused(function() least(function(d) return d.presure end):optimise{ method = method } end, "'presure'", "in 'objective' of optimise")
  refused(function() it:optimise{ method = method, on_design = function(k) if k == 2 then error "own fault" end end } end, "own fault", "in 'on_design' of optimise")
  local thrown <const> = {}
  local ok <const>, value <const> = pcall(function() least(function() error(thrown) end):optimise{ method = method } end)
  check.that(not ok and value == thrown, "errors that are no text pass unchanged")
end
local coarser <const> = pressed(-1, { moves = { control_points = 4 } }):design().compliance
refused(function() pressed(-1, { objective = function(d) return d.compliance + coarser end }):optimise() end, "dual numbers of different designs do not mix")

-- Constraints that cannot be kept: no error, but said.
local best <const> = pressed(-1, { constraints = { { quantity = "volume", most = 0.5 } } }):optimise()
check.that(not best.converged and best.constraints[1] > 0 and best.reason:find "constraints are violated")
refused(function() return best.objectiv end, "'objectiv'", "did you mean 'objective'?")

-- Within functions of a run everything else still works, also another run.
local inner
local outer <const> = it:optimise{ max_designs = 2, on_design = function() inner = it:optimise{ max_designs = 2 } end }
check.equal(inner.objective, outer.objective)
