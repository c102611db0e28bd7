-- dotyk.beam as a script sees it: values, errors where they are made, every method, branches.
local check <const> = require "check"
local refused <const> = require "refused"
local law <const> = dotyk.law

local function beam(keys)
  keys.left = keys.left or { deflection = law.signorini() }
  keys.right = keys.right or { deflection = law.signorini() }
  return dotyk.beam(keys)
end

-- A beam on two supports: 5qL⁴/384EJ, qL²/8.
local s <const> = dotyk.solve(beam{ length = 2, EJ = 3, load = -4 })
check.near(s:deflection(1), -5 * 4 * 2^4 / (384 * 3), 1e-11)  -- 32⁴ roundings
check.near(s:moment(1), -4 * 2^2 / 8, 1e-12)
check.near(s:reaction("left").force, 4, 1e-12)
check.near(s:reaction(2).force, 4, 1e-12)
check.equal(s.converged, true)
check.equal(#s.branches, 1)

-- Functions of x are taken when the beam is made; the same as a constant.
local f <const> = dotyk.solve(beam{ length = 2, EJ = function() return 3 end, load = function() return -4 end })
for x = 0, 2, 0.25 do
  check.near(f:deflection(x), s:deflection(x), 1e-11)
  check.near(f:shear(x), s:shear(x), 1e-11)
end

-- Methods that treat laws with two limits, and one that does not.
local rubbing <const> = beam{ load = -1, right = { deflection = law.friction(2) } }
for _, name in ipairs{ "pdas", "newton", "uzawa", "psor", "proximal" } do
  check.near(dotyk.solver[name]{}:solve(rubbing):deflection(0.5), -5 / 384, 1e-9, name)
end
refused(function() dotyk.solver.interior_point{}:solve(rubbing) end, "cannot treat the friction law of the right deflection; pdas can")

-- Refusals, at the line that makes or solves it.
refused(function() dotyk.beam{ length = -1 } end, "'length'")
refused(function() dotyk.beam{ lenght = 1 } end, "unknown key 'lenght'")
refused(function() dotyk.beam{ left = { deflection = 3 } } end, "expected a law, got the number 3")
refused(function() dotyk.beam{ EJ = function(x) return 0.5 - x end } end, "EJ is")
refused(function() dotyk.beam{ load = function() return "much" end } end, "'load'")
refused(function() dotyk.beam{ supports = { { x = 2, deflection = law.signorini() } } } end, "the beam goes from 0 to 1")
refused(function() dotyk.beam{ supports = { { x = 0, deflection = law.signorini() } } } end, "are at one point")
refused(function() law.elastic(-1) end, "'k' must be a number of at least 0")
refused(function() law.capped_elastic(1) end, "'g'")
refused(function() dotyk.solve(beam{ load = 1 }) end, "theorem 3")
refused(function() dotyk.solve(dotyk.beam{ load = 1 }) end, "no solution")
refused(function() dotyk.solve(dotyk.beam{}) end, "nothing holds it, and nothing loads it")
refused(function() dotyk.beam{ cells = 2000 } end, "'cells'")
assert(dotyk.solve(dotyk.beam{ loads = { { x = 0.2, force = 1 }, { x = 0.8, force = 1 }, { x = 0.5, force = -2 } } }).converged)
refused(function() dotyk.solve(beam{ load = -1 }, { start = { 1 } }) end, "options are for scenes")
refused(function() return s:deflection(3) end, "x = 3 is not on the beam")
refused(function() return s:reaction(0.3) end, "the supports are left, right")

-- A breaking support, whole and broken.
local b <const> = dotyk.solve(dotyk.beam{ left = { deflection = law.prescribed(), rotation = law.prescribed() },
  right = { deflection = law.breaking(3, 0.2) }, loads = { { x = 1, force = -0.3 } } })
check.equal(#b.branches, 2)
check.equal(b.branches[1].energy <= b.branches[2].energy, true)
local broken <const> = #b.branches[1].broken == 1 and b.branches[1] or b.branches[2]
check.equal(broken.broken, { "right deflection" })
check.near(broken:deflection(1), -0.1, 1e-11)

-- Supports that stand at h, and foundations: a law, or a function of x that gives one.
local stop <const> = dotyk.solve(dotyk.beam{ left = { deflection = law.prescribed(), rotation = law.prescribed() }, right = { deflection = law.signorini(), deflection_at = 0.1 } })
check.near(stop:deflection(1), 0.1)
check.near(stop:reaction("right").force, 0.3, 1e-11)
check.equal(stop:pressure(0.5), 0)
for _, foundation in ipairs{ law.elastic(50), function() return law.elastic(50) end } do
  local w <const> = dotyk.solve(dotyk.beam{ loads = { { x = 0, force = -1 }, { x = 1, force = -1 }, { x = 0.5, force = 2 } }, load = -2, foundation = foundation,
                                            foundation_at = function(x) return 0.1 + 0.2 * x end })
  local force = 0
  for i = 0, 32 do force = force + w:pressure(i / 32) / (i % 32 == 0 and 64 or 32) end
  check.near(force, 2, 1e-9)
  check.near(w:pressure(0.25), 50 * (0.15 - w:deflection(0.25)), 1e-9)
  check.that(tostring(w):find("foundation: force 2", 1, true))
end
check.that(tostring(dotyk.beam{ load = -1, foundation = law.signorini() }):find("on a foundation", 1, true))
refused(function() dotyk.beam{ left = { deflection_at = 1 } } end, "'deflection_at' is where the law of 'deflection' stands, and that is free")
refused(function() dotyk.beam{ left = { rotation = law.load(1), rotation_at = 1 } } end, "'rotation_at'", "that is load")
refused(function() dotyk.beam{ foundation_at = 1 } end, "'foundation_at'", "give 'foundation'")
refused(function() dotyk.beam{ foundation = 3 } end, "'foundation'")
refused(function() dotyk.beam{ foundation = function(x) return x end } end, "function 'foundation' returned the number 0, expected a law")
refused(function() dotyk.beam{ foundation = law.breaking(1, 1) } end, "the foundation's law at x = 0 is breaking 1", "capped_elastic")
refused(function() dotyk.beam{ foundation = law.signorini(), left = { deflection = law.signorini() } } end, "the support left", "both hold the deflection rigidly")
refused(function() dotyk.solve(dotyk.beam{ load = 1, foundation = law.one_sided_elastic(1) }) end, "no solution")
