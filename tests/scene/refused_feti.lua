-- Options of FETI that no solution comes of: refused where they are given.
local refused <const> = require "refused"

-- Beyond 1e10 times ‖PFP‖ the penalty leaves no digit of the rest; it ended as "no convergence".
refused(function() dotyk.solver.feti{ rho = 1e10 } end, "'rho' must be a number above 0 and below 1e+10")
refused(function() dotyk.solver.feti{ rho = 0 } end, "'rho' must be a number above 0")

-- A number that was not asked for is nil, not an unknown field.
local body <const> = dotyk.body{ name = "b", mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { 2, 2, 2 } },
  material = dotyk.material{ E = 1 }, force = { 0, 0, -1 } }
body:part "bottom":fix()
local scene <const> = dotyk.scene{ body }
assert(dotyk.solver.feti{ subdomains = { 2, 1, 1 } }:solve(scene).feti.condition == nil)
assert(dotyk.solver.feti{ subdomains = { 2, 1, 1 }, spectrum = true }:solve(scene).feti.condition > 1)
refused(function() return dotyk.solver.feti{}:solve(scene).feti.conditon end, "unknown field 'conditon'")
