-- What plates refuse is an error at the line that asked for it, and says what would do.
local refused <const> = require "refused"
local check <const> = require "check"
local law <const> = dotyk.law

local square <const> = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {4, 4} }
local held <const> = { deflection = law.prescribed(), rotation = law.prescribed() }
local function plate(change)
  local p = { mesh = square, load = -1, edge = held }
  for k, v in pairs(change) do p[k] = v end
  if change.edges and not change.edge then p.edge = nil end
  return dotyk.plate(p)
end
refused.intact = function() check.that(dotyk.solve(dotyk.plate{ mesh = square, load = -1, edge = held }).converged) end

-- The mesh.
refused(function() dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2}, element = "Q1" }, edge = held } end, "quadrilaterals", "triangles", "P1")
refused(function() dotyk.plate{ mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {1, 1, 1} }, edge = held } end, "triangles")
refused(function() dotyk.plate{ edge = held } end, "'mesh'")

-- Numbers.
for _, nu in ipairs{ 1, -1, 1.5, 0/0, math.huge } do refused(function() dotyk.plate{ mesh = square, nu = nu, edge = held } end, "nu") end
-- Near 1 and -1 Morley's element is off by any factor; HCT is not: on a polygon simply supported nu does not matter.
for _, nu in ipairs{ 0.9, -0.9, 0.99, 0.9999, -0.9999 } do
  refused(function() dotyk.plate{ mesh = square, nu = nu, edge = held } end, "with Morley's element it must be between -0.8 and 0.8", "element = \"hct\"")
end
do
  local function middle(element, nu)
    local fine = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {8, 8} }
    return dotyk.solve(dotyk.plate{ mesh = fine, element = element, nu = nu, load = -1, edge = { deflection = law.prescribed() } }):deflection(0.5, 0.5)
  end
  for _, nu in ipairs{ -0.9999, 0.3, 0.9999 } do check.near(middle("hct", nu), -0.00406, 1e-5) end
  local off <const> = middle("morley", 0.3) + 0.00406
  for _, nu in ipairs{ -0.8, 0, 0.5, 0.8 } do check.that(math.abs(middle("morley", nu) + 0.00406) < 5 * math.abs(off)) end
end
for _, D in ipairs{ 0, -1, 0/0, math.huge } do refused(function() dotyk.plate{ mesh = square, D = D, edge = held } end, "D") end
for _, D in ipairs{ 0, -1 } do refused(function() dotyk.plate{ mesh = square, D = function(x) return x < 0.5 and 1 or D end, edge = held } end, "D is", "at (", "must be positive") end
for _, D in ipairs{ 0/0, math.huge } do refused(function() dotyk.plate{ mesh = square, D = function(x) return x < 0.5 and 1 or D end, edge = held } end, "function 'D' returned", "at (") end
refused(function() dotyk.plate{ mesh = square, D = function() return "stiff" end, edge = held } end, "D")
refused(function() dotyk.plate{ mesh = square, D = function() error "own fault" end, edge = held } end, "own fault")
refused(function() dotyk.plate{ mesh = square, load = 0/0, edge = held } end, "load")
refused(function() dotyk.plate{ mesh = square, load = function() return 0/0 end, edge = held } end, "function 'load' returned", "at (")
refused(function() dotyk.plate{ mesh = square, load = function() end, edge = held } end, "load")
refused(function() dotyk.plate{ mesh = square, element = "morly", edge = held } end, 'did you mean "morley"?')
refused(function() dotyk.plate{ mesh = square, thickness = 1, edge = held } end, "'thickness'")

-- Parts.
refused(function() dotyk.plate{ mesh = square, edges = { lefd = held } } end, "lefd", "left", "where")
refused(function() dotyk.plate{ mesh = square, edge = held, edges = { left = held } } end, "edge", "edges", "not both")
refused(function() dotyk.plate{ mesh = square, edges = { left = held, side = { where = function(x) return x < 0.01 end, deflection = law.prescribed() } } } end, "'left'", "'side'", "one of them")
refused(function() dotyk.plate{ mesh = square, edges = { nowhere = { where = function() return false end, deflection = law.prescribed() } } } end, "nowhere")
refused(function() dotyk.plate{ mesh = square, edges = { left = { deflexion = law.prescribed() } } } end, "'deflexion'", "'deflection'")
refused(function() dotyk.plate{ mesh = square, edges = { held } } end, "edges")
refused(function() dotyk.plate{ mesh = square, edges = { left = 3 } } end, "edges.left", "rotation = law", "got the number 3")
refused(function() dotyk.plate{ mesh = square, edges = { left = law.signorini() } } end, "edges.left", "rotation = law")
refused(function() dotyk.plate{ mesh = square, edges = 3 } end, "edges", "got the number 3")
refused(function() dotyk.plate{ mesh = square, edges = { left = { where = 3 } } } end, "where")

-- Laws.
refused(function() dotyk.plate{ mesh = square, edge = { deflection = law.breaking(10, 1) } } end, "do not break", "capped_elastic")
refused(function() dotyk.plate{ mesh = square, edge = { rotation = function() return law.breaking(10, 1) end } } end, "do not break")
refused(function() dotyk.plate{ mesh = square, edge = held, supports = { { x = 0.5, y = 0.5, deflection = law.breaking(10, 1) } } } end, "do not break")
refused(function() dotyk.plate{ mesh = square, edge = { deflection = 3 } } end, "deflection")
refused(function() dotyk.plate{ mesh = square, edge = { deflection = function() return 3 end } } end, "law")
refused(function() dotyk.plate{ mesh = square, edge = { deflection = function() end } } end, "law")
refused(function() dotyk.plate{ mesh = square, edge = { deflection = function(x) return law.prescribed(x / 0 - x / 0) end } } end, "prescribed")

-- Points.
refused(function() dotyk.plate{ mesh = square, edge = held, loads = { { x = 2, y = 0.5, force = 1 } } } end, "(2, 0.5)", "not on the plate")
refused(function() dotyk.plate{ mesh = square, edge = held, loads = { { x = 0/0, y = 0.5, force = 1 } } } end, "x")
refused(function() dotyk.plate{ mesh = square, edge = held, loads = { { x = 0.5, y = 0.5 } } } end, "'force'")
refused(function() dotyk.plate{ mesh = square, edge = held, supports = { { x = 0.5, y = -0.1, deflection = law.signorini() } } } end, "(0.5, -0.1)", "not on the plate")
refused(function() dotyk.plate{ mesh = square, edge = held, supports = { { x = 0, y = 0, deflection = law.signorini() } } } end, "held already")
refused(function() dotyk.plate{ mesh = square, edge = held, lines = { { from = {0.5, 0.5}, to = {1.5, 0.5}, force = 1 } } } end, "not on the plate")
refused(function() dotyk.plate{ mesh = square, edge = held, lines = { { from = {0.5, 0.5}, to = {0.5, 0.5}, force = 1 } } } end, "begins and ends")
refused(function() dotyk.plate{ mesh = square, edge = held, lines = { { from = {0.5}, to = {0.5, 0.5}, force = 1 } } } end, "from")

-- Supports that contradict each other.
for _, element in ipairs{ "morley", "hct" } do
  refused(function() dotyk.plate{ mesh = square, element = element, edges = { left = { deflection = law.prescribed(0) }, bottom = { deflection = law.prescribed(1) } } } end, "contradictory", "(0, 0)")
  refused(function() dotyk.plate{ mesh = square, element = element, edge = held, obstacle = 0.1 } end, "contradictory", "obstacle")
end
refused(function() dotyk.plate{ mesh = square, edge = held, obstacle = function() return 0/0 end } end, "function 'obstacle' returned", "at (")
refused(function() dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {1, 1} }, element = "hct", edge = held, nu = 2 } end, "nu")

-- Without a solution: at the line that solves.
local free <const> = dotyk.plate{ mesh = square, load = -1 }
refused(function() dotyk.solve(free) end, "no solution", "P5 (33)")
local lifted <const> = dotyk.plate{ mesh = square, load = 1, edge = { deflection = law.signorini(), rotation = law.prescribed() } }
refused(function() dotyk.solve(lifted) end, "the whole plate upwards", "resultant is 1", "P5 (45)")
local rubbed <const> = dotyk.plate{ mesh = square, load = 1, edge = { deflection = law.friction(0.2), rotation = law.prescribed() } }
refused(function() dotyk.solve(rubbed) end, "all that it can bear, 0.8", "P5 (63)")
local unloaded <const> = dotyk.plate{ mesh = square }
refused(function() dotyk.solve(unloaded) end, "nothing")

-- Questions to a solution.
local s <const> = dotyk.solve(dotyk.plate{ mesh = square, load = -1, edge = held })
refused(function() s:deflection(1.5, 0.5) end, "(1.5, 0.5)", "not on the plate")
refused(function() s:slope(0/0, 0.5) end, "x")
refused(function() s:moment(0.5) end, "y")
refused(function() s:reaction "left" end, "left", "edge")
refused(function() s:reaction(1) end, "no point supports")
