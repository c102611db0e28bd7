-- What dotyk.shape and designs refuse is an error at the line that asked for it, and says what would do.
local refused <const> = require "refused"
local check <const> = require "check"
local nan <const>, inf <const> = 0/0, math.huge

local function pressed(name, load)
  local block <const> = dotyk.body{ name = name, material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {-1, 0}, to = {1, 1}, cells = {8, 4} } }
  block:part "top":load{ 0, load or -1 }
  block:part "left":fix "x"
  local scene <const> = dotyk.scene{ block }
  return block, scene, scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
end
local block <const>, scene <const>, contact <const> = pressed "block"
local other_block <const>, _ <const>, other_contact <const> = pressed "other"
local bottom <const> = block:part "bottom"

local none <const> = {} -- for a key that is left out
local function with(given, change)
  for key, value in pairs(change or {}) do
    if value == none then given[key] = nil else given[key] = value end
  end
  return given
end
local function move(change) return with({ part = bottom, control_points = 5, direction = {0, 1}, lower = 0, upper = 0.05 }, change) end
local function one(moved, change) return with({ scene = scene, moves = { move(moved) } }, change) end
refused.intact = function() check.near(dotyk.shape(one()):design().volume.value, 2) end

-- Sizes and kinds.
refused(function() dotyk.shape(one({}, { scene = none })) end, "missing key 'scene'")
refused(function() dotyk.shape(one({}, { moves = none })) end, "missing key 'moves'")
refused(function() dotyk.shape(one({}, { moves = {} })) end, "'moves' must be a table of 1 to 256 items")
refused(function() dotyk.shape(one({}, { moves = move() })) end, "'moves'", "got the key")
refused(function() dotyk.shape(one({}, { objectiv = "volume" })) end, "'objectiv'", "did you mean 'objective'?")
refused(function() dotyk.shape(one{ contrl_points = 3 }) end, "entry 1", "'contrl_points'", "did you mean 'control_points'?")
refused(function() dotyk.shape(one({}, { objective = "complience" })) end, "'objective'", 'did you mean "compliance"?')
refused(function() dotyk.shape(one({}, { objective = 3 })) end, "'objective'", "a function", "got the number 3")
refused(function() dotyk.shape(one({}, { exponent = 0.5 })) end, "'exponent'", "at least 1")
refused(function() dotyk.shape(one({}, { differences = 0 })) end, "'differences'", "positive")
refused(function() dotyk.shape(one({}, { method = "pdas" })) end, "'method'", "a solver")

-- What moves.
refused(function() dotyk.shape(one{ part = block:part "botom" }) end, "'block' has no part 'botom'", "did you mean 'bottom'?")
refused(function() dotyk.shape(one{ part = other_block:part "bottom" }) end, "'other' is not of the scene")
refused(function() dotyk.shape(one({}, { moves = { move(), move{ part = other_block:part "top" } } })) end, "'moves': entry 2", "'other' is not of the scene")
refused(function() dotyk.shape(one{ part = none }) end, "either part", "or body and velocity")
refused(function() dotyk.shape(one{ body = block, velocity = function() return 0, 1 end }) end, "either part", "or body and velocity")
refused(function() dotyk.shape(one{ part = none, body = block }) end, "either part", "or body and velocity")
refused(function() dotyk.shape(one{ control_points = 1 }) end, "'control_points'", "at least 2")
refused(function() dotyk.shape(one{ control_points = 3 }) end, "degree 3 with 3 control points", "at least 4")
refused(function() dotyk.shape(one{ control_points = 40 }) end, "control point 2 of 40 moves none of the 9 nodes of 'block' bottom")
refused(function() dotyk.shape(one{ control_points = 1000000000 }) end, "at most 4096")
refused(function() dotyk.shape(one{ control_points = {4, 4} }) end, "'control_points'", "in the plane give one")
refused(function() dotyk.shape(one{ control_points = {4.5, 4} }) end, "'control_points'", "integer")
refused(function() dotyk.shape(one{ degree = 4 }) end, "'degree'", "from 1 to 3")
refused(function() dotyk.shape(one{ direction = {0, 1, 2} }) end, "'direction' has 3 components", "must have 2")
refused(function() dotyk.shape(one{ direction = {0, 0} }) end, "other than zero")
refused(function() dotyk.shape(one{ direction = {0, nan} }) end, "'direction'", "nan")
refused(function() dotyk.shape(one{ extension = "strucured" }) end, 'did you mean "structured"?')
refused(function() dotyk.shape(one{ fixed = { other_block:part "top" } }) end, "of another body")
refused(function() dotyk.shape(one{ fixed = { bottom } }) end, "'block' bottom is to stay")

-- Bounds.
refused(function() dotyk.shape(one{ lower = none }) end, "missing key 'lower'")
refused(function() dotyk.shape(one{ lower = 0.1 }) end, "design variable 1 has lower = 0.1 above upper = 0.05")
refused(function() dotyk.shape(one{ lower = {0, 0} }) end, "'lower' has 2 entries; these are 5 design variables")
refused(function() dotyk.shape(one{ start = {0, 0} }) end, "'start' has 2 entries")
refused(function() dotyk.shape(one({}, { moves = { move(), move{ upper = {1} } } })) end, "'moves': entry 2", "'upper' has 1 entries")
for _, value in ipairs{ nan, inf, -inf } do refused(function() dotyk.shape(one{ upper = value }) end, "'upper' must be a finite number") end
refused(function() dotyk.shape(one{ upper = {0, 0, 0, 0, nan} }) end, "'upper': entry 5", "nan")

-- Velocities.
local function by(velocity, body) return one{ part = none, control_points = none, direction = none, body = body or block, velocity = velocity } end
for _, key in ipairs{ "control_points", "degree", "symmetric" } do
  refused(function() dotyk.shape(one{ part = none, control_points = none, direction = none, body = block, velocity = print, [key] = key ~= "symmetric" and 3 or true }) end,
    ("'%s' belongs to part"):format(key))
end
refused(function() dotyk.shape(by(function() return 1 end)) end, "'velocity' returned 1 number, expected 2", "at (-1, 0)")
refused(function() dotyk.shape(by(function() return 0, nan end)) end, "'velocity' returned nan", "at (-1, 0)")
refused(function() dotyk.shape(by(function() end)) end, "'velocity' returned nothing")
refused(function() dotyk.shape(by(function() return 0, 0 end)) end, "design variable 1 moves nothing")
refused(function() dotyk.shape(by(function() error "own fault" end)) end, "own fault", "in 'velocity' of shape")
refused(function() dotyk.shape(by(function() return 0, 1 end, other_block)) end, "'other' is not of the scene")

-- Constraints.
refused(function() dotyk.shape(one({}, { constraints = { { quantity = "compliance" } } })) end, "constraint 1 needs 'most'")
refused(function() dotyk.shape(one({}, { constraints = { { quantity = "volume" }, { quantity = function() return 1 end } } })) end, "constraint 2 needs 'most'")
refused(function() dotyk.shape(one({}, { constraints = { { most = 1 } } })) end, "missing key 'quantity'")
refused(function() dotyk.shape(one({}, { constraints = { quantity = "volume" } })) end, "'constraints'")
refused(function() dotyk.shape(one({}, { constraints = { { quantity = "volume", most = nan } } })) end, "'most'", "nan")

-- In space.
local box <const> = dotyk.body{ name = "box", material = dotyk.material{ E = 1, nu = 0.3 },
  mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {4, 4, 2} } }
box:part "bottom":fix()
local solid <const> = dotyk.scene{ box }
local function in_space(change) return { scene = solid, moves = { with({ part = box:part "top", control_points = 4, lower = 0, upper = 0.1 }, change) } } end
check.equal(dotyk.shape(in_space()).variables, 16)
check.equal(dotyk.shape(in_space{ control_points = {5, 4} }).variables, 20)
refused(function() dotyk.shape(in_space{ symmetric = true }) end, "'symmetric' is for parts in the plane")
refused(function() dotyk.shape(in_space{ extension = "structured" }) end, "'box'", "harmonic")
refused(function() dotyk.shape(in_space{ direction = {0, 1} }) end, "'direction' has 2 components; it must have 3")
refused(function() dotyk.shape(in_space{ control_points = {4, 1} }) end, "'control_points'", "at least 2")
refused(function() dotyk.shape(in_space()):design().peak_pressure:foo() end, "peak_pressure needs a contact, and the scene has none")
refused(function() dotyk.shape(in_space()):design():displacement(box, 0.5, 0.5) end, "z is missing")

-- Designs.
local it <const> = dotyk.shape(one())
refused(function() it:design{ 1, 2 } end, "'alpha' has 2 components; there are 5 design variables")
refused(function() it:design{ nan, 0, 0, 0, 0 } end, "'alpha'", "nan")
refused(function() it:design{ 0, nil, 0, 0, 0 } end, "'alpha'", "entry 2", "nil")
refused(function() it:design{ "a", 0, 0, 0, 0 } end, "'alpha'", '"a"')
refused(function() it:design{ 2, 2, 2, 2, 2 } end, "'block' where its nodes have moved to", "inverted")
refused(function() it:design{ -1, -1, -1, -1, -1 } end, "the rigid plane penetrates the part by 1")
refused(function() it:design{ 1e300, 0, 0, 0, 0 } end, "'block' where its nodes have moved to")
refused(function() it.design{ 0, 0, 0, 0, 0 } end, "colon")
local design <const> = it:design{ 0.001, 0, 0, 0, 0.001 }
refused(function() design:displacement(block, 3, 0) end, "(3, 0) is outside 'block' as it was first designed")
refused(function() design:displacement(block, nan, 0) end, "'x'", "nan")
refused(function() design:displacement(block, 0, 0, 0) end, "z is given, but the scene is 2-D")
refused(function() design:displacement(other_block, 0, 0) end, "'other' is not of the scene that is designed")
refused(function() design:position(other_block, 0, 0) end, "'other' is not of the scene that is designed")
refused(function() design:contact(other_contact) end, "'other' bottom", "is not of the scene that is designed")
refused(function() design:contact() end, "'contact' is missing")
refused(function() design:along{ 1 } end, "'direction' has 1 components; there are 5 design variables")
refused(function() design:along{ 0, 0, 0, 0, 0 } end, "'direction' is zero")
refused(function() design:along{ inf, 0, 0, 0, 0 } end, "'direction'", "inf")
refused(function() return design.complience end, "'complience'", "did you mean 'compliance'?")
check.equal(#design:contact(contact), 9)

-- A scene without a solution, at the line that solves it; solutions without derivatives.
local lifted <const>, lifted_scene <const> = pressed("lifted", 1)
local free <const> = dotyk.shape{ scene = lifted_scene, moves = { move{ part = lifted:part "bottom" } } }
refused(function() free:design() end, "not held", "'lifted'")
local short <const> = dotyk.shape(one({}, { method = dotyk.solver.uzawa{ max_iterations = 2 } })):design()
check.that(not short.solution.converged)
refused(function() return short.compliance end, "has not converged")
refused(function() return short.peak_pressure end, "has not converged")
refused(function() return short:displacement(block, 0, 0) end, "has not converged")
local penalised <const> = dotyk.shape(one({}, { method = dotyk.solver.penalty{} })):design()
refused(function() return penalised.compliance end, "penalised", "pdas")
refused(function() return penalised.peak_pressure end, "penalised", "pdas")
