-- Parts that are not there, and what does not fit them.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
refused.intact = it.solve
local block <const>, top <const> = it.body, it.top
local cube <const> = dotyk.body{ name = "cube", material = it.material,
                                 mesh = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {1,1,1} } }
local other <const> = dotyk.body{ name = "other", mesh = it.mesh, material = it.material }

-- Names and predicates.
refused(function() block:part "topp" end, "part: 'block' has no part 'topp', did you mean 'top'?")
refused(function() block:part "xyzzy" end, "'block' has no part 'xyzzy'; it has bottom, left, right, top")
refused(function() block:part("none", function(x, y) return x > 5 end) end, "part 'none' of 'block' is empty", "none of the boundary's facets")
refused(function() block:part() end, "argument 1 'name' is missing, expected a string")
refused(function() block:part(nil) end, "argument 1 'name' is nil (a variable misspelt or not yet set?)")
refused(function() block:part(3) end, "argument 1 'name' must be a string, got the number 3")
refused(function() block:part("p", "x > 0") end, "argument 2 'chosen' must be a function")
refused(function() block:part("p", function(x, y) return x.z end) end, "attempt to index a number value (local 'x') (in 'chosen' of part at ")
refused(function() block.part "top" end, "(write body:part with a colon, not a dot)")

-- Dimensions.
refused(function() cube:part "top":load{ 0, -1 } end, "load: 'traction' must be a table of 3 numbers or a function, got a table of 2")
refused(function() top:load{ 0, -1, 0 } end, "'traction' must be a table of 2 numbers or a function, got a table of 3")
refused(function() top:load(3) end, "'traction' must be a table of 2 numbers or a function, got a number")
refused(function() top:pressure{ 1, 2 } end, "'value' must be a number or a function, got a table of 2")
refused(function() dotyk.body{ mesh = it.mesh, material = it.material, force = { 0, 0, -1 } } end, "'force' must be a table of 2 numbers")
refused(function() top:fix "z" end, "fix: component 'z' does not exist: 'block' is 2-D")
refused(function() top:fix "w" end, "must be \"x\", \"y\" or \"z\", got \"w\"")
refused(function() top:displace{ z = 0.1 } end, "displace: component 'z' does not exist: 'block' is 2-D")
refused(function() top:spring{ z = 1 } end, "spring: component 'z' does not exist")
refused(function() dotyk.scene{ block, cube } end, "scene: 'cube' is 3-D, 'block' is 2-D; the bodies of a scene must have one dimension")

-- Empty tables and holes.
refused(function() top:load{} end, "'traction' must be a table of 2 numbers")
refused(function() top:load{ nil, -1 } end, "'traction': entry 1 must be a number, got nil")
refused(function() top:load(nil) end, "argument 1 'traction' is nil")
refused(function() top:displace{} end, "displace: name at least one component: x, y or z")
refused(function() top:displace() end, "displace: name at least one component")
refused(function() top:spring{} end, "spring: name at least one component")
refused(function() top:displace{ X = 1 } end, "unknown key 'X', did you mean 'x'?")
refused(function() top:displace{ 0.1 } end, "displace: the number 0.1 given without a key, expected 'x', 'y'")

-- Values.
refused(function() top:spring{ y = -1 } end, "stiffness is -1 at (", "must be zero or positive")
refused(function() top:spring{ y = function(x, y) return x - 0.5 end } end, "spring: stiffness is -0.", " at (0.", "must be zero or positive")
refused(function() top:spring{ y = 0/0 } end, "'y' must be a finite number, got nan")
refused(function() top:displace{ x = function() return 1/0 end } end, "function 'x' returned inf at (")

-- Supports that contradict each other: the second is not taken. (At the corner left holds u_x at 0.)
refused(function() top:displace{ x = 0.1 } end, "displace: contradictory supports on 'block': at the node (0, 1) part 'left' prescribes ux = 0 and part 'top' prescribes 0.1")
top:displace{ x = 0 }  -- says the same there: no contradiction
local bar <const> = dotyk.body{ name = "bar", mesh = it.mesh, material = it.material }
bar:part "bottom":fix()
refused.intact = function() check.near(dotyk.solve(dotyk.scene{ bar }).energy, 0) end
refused(function() bar:part "bottom":displace{ y = 1 } end, "part 'bottom' prescribes uy = 0 and part 'bottom' prescribes 1")
refused(function() bar:part "left":displace{ y = 1 } end, "at the node (0, 0) part 'bottom' prescribes uy = 0 and part 'left' prescribes 1")

-- Scenes.
refused.intact = it.solve
refused(function() dotyk.scene{} end, "scene: a scene needs at least one body")
refused(function() dotyk.scene() end, "scene: a scene needs at least one body")
refused(function() dotyk.scene{ block, block } end, "scene: 'block' is given twice")
local twin <const> = dotyk.body{ name = "block", mesh = it.mesh, material = it.material }
refused(function() dotyk.scene{ block, twin } end, "two bodies are named 'block'", "a name of its own")
refused(function() dotyk.scene{ block, nil, other } end, "scene: item 2: expected a body, got nil (a variable misspelt or not yet set?)")
refused(function() dotyk.scene(block) end, "expected a table of bodies, got a body")
refused(function() dotyk.scene{ it.mesh } end, "item 1: expected a body, got a mesh")
refused(function() dotyk.scene{ bodies = { block } } end, "unknown key 'bodies'")

-- Bodies and contacts of another scene asked of a solution.
local s <const> = it.solve()
refused(function() s:displacement(other, 0, 0) end, "displacement: 'other' is not of the scene that was solved")
refused(function() s:stress(other, 0, 0) end, "'other' is not of the scene that was solved")
refused(function() s:reaction(other:part "left") end, "is not of the scene that was solved")
refused(function() s:displacement(block, 2, 0.5) end, "the point (2, 0.5) lies outside 'block' at rest")
refused(function() s:stress(block, 0.5, -0.1) end, "the point (0.5, -0.1) lies outside 'block' at rest")
refused(function() s:displacement(block, 1e300, 0) end, "lies outside 'block'")
refused(function() s:displacement(block, 0/0, 0) end, "argument 2 'x' must be a finite number, got nan")
refused(function() s:displacement(block, 1) end, "argument 3 'y' is missing, expected a number")
refused(function() s:displacement(block, 0, 0, 0) end, "z is given, but the scene is 2-D")
refused(function() s:displacement(0, 0, block) end, "argument 1 'body': expected a body, got the number 0")
refused(function() s:contact(nil) end, "argument 1 'contact' is nil")
refused(function() s:contact(refused.pressed_block().contact) end, "is not part of the scene that was solved")
cube:part "bottom":fix()
refused(function() dotyk.solve(dotyk.scene{ cube }):displacement(cube, 0, 0) end, "z is missing: the scene is 3-D")
