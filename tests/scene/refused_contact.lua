-- Contacts that cannot be meant.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
refused.intact = it.solve
local scene <const>, block <const>, top <const>, floor <const> = it.scene, it.body, it.top, it.floor

local function on_top(name, cells)
  return dotyk.body{ name = name, material = it.material,
                     mesh = dotyk.mesh.rectangle{ from = {0,1}, to = {1,2}, cells = cells } }
end

-- What is joined.
refused(function() scene:contact{ top } end, "contact: give two parts, or one part and 'rigid'")
refused(function() scene:contact{} end, "contact: takes at least 1 part, got 0")
refused(function() scene:contact{ nil, rigid = floor } end, "takes at least 1 part, got 0 (or nil)")
refused(function() scene:contact{ top, it.left, it.right } end, "takes at most 2 parts, got 3")
refused(function() scene:contact{ top, it.bottom, rigid = floor } end, "give one part with 'rigid', or two parts without it")
refused(function() scene:contact{ block, rigid = floor } end, "item 1: expected a part, got a body")
refused(function() scene:contact{ "top", rigid = floor } end, "item 1: expected a part, got the string \"top\"")
refused(function() scene:contact{ top, rigid = it.mesh } end, "'rigid': expected a rigid, got a mesh")
refused(function() scene:contact{ top, rgid = floor } end, "unknown key 'rgid', did you mean 'rigid'?")
refused(function() scene:contact{ top, rigid = floor, gap = 0/0 } end, "'gap' must be a finite number, got nan")
refused(function() scene.contact{ top, rigid = floor } end, "(write scene:contact with a colon, not a dot)")
local other <const> = on_top("other", { 2, 2 })
refused(function() scene:contact{ other:part "bottom", rigid = floor } end, "part 'bottom' belongs to 'other', which is not in this scene; its bodies are 'block'")
refused(function() scene:contact{ top, other:part "bottom" } end, "which is not in this scene")
refused(function() scene:glue{ top } end, "glue: takes 2 parts, got 1")
refused(function() scene:contact{ top, top } end, "'block' top and 'block' top do not face each other")

-- Multipliers and the friction that goes with them.
local given <const>, coulomb <const> = dotyk.friction.tresca(1), dotyk.friction.coulomb(0.3)
local ceiling <const> = dotyk.rigid.plane{ point = {0,1}, normal = {0,-1} }
refused(function() scene:contact{ top, rigid = floor, multipliers = "P1" } end, "'multipliers'", "\"P1-P0\"")
refused(function() scene:contact{ top, rigid = ceiling, friction = coulomb, multipliers = "P1-P0" } end, "Coulomb friction does not go with multipliers = \"P1-P0\"", "take \"nodal\"")
refused(function() scene:contact{ top, rigid = ceiling, friction = given, friction_size = 0.5 } end, "'friction_size' is the size of the cells of friction with multipliers = \"P1-P0\"")
refused(function() scene:contact{ top, rigid = ceiling, multipliers = "P1-P0", friction_size = 0.5 } end, "it is given without them")
refused(function() scene:contact{ top, rigid = ceiling, friction = given, multipliers = "P1-P0", friction_size = 0 } end, "'friction_size' must be a positive number")

-- Meshes that do not match, faces that do not face, the same said twice.
local base <const> = dotyk.body{ name = "base", mesh = it.mesh, material = it.material }
base:part "bottom":fix()
local face <const> = base:part "top"
local two <const> = dotyk.scene{ base, on_top("upper", { 2, 1 }), on_top("three", { 3, 1 }), on_top("four", { 4, 1 }) }
local upper <const>, three <const>, four <const> = two.bodies[2], two.bodies[3], two.bodies[4]
for _, way in ipairs{ "contact", "glue" } do
  refused(function() two[way](two, { face, three:part "bottom", pairing = "matching" }) end, way .. ": the nodes of 'base' top and 'three' bottom do not match: the node at (0.5, 1)")
  refused(function() two[way](two, { face, four:part "bottom", pairing = "matching" }) end, "the node at (0.25, 1) of 'four' bottom has no partner on the other side")
  refused(function() two[way](two, { face, upper:part "top" }) end, "do not face each other", "normals opposed")
  refused(function() two[way](two, { face, upper:part "left" }) end, "do not face each other")
end
-- Glue across a gap, which would lose the moment of its forces; a tenth of a facet is a layer of glue.
local function over(height, cells)
  local upper = dotyk.body{ name = "upper", material = it.material, mesh = dotyk.mesh.rectangle{ from = {0,1 + height}, to = {1,2 + height}, cells = cells } }
  return dotyk.scene{ base, upper }, upper:part "bottom"
end
for _, cells in ipairs{ { 2, 1 }, { 3, 1 } } do
  for _, height in ipairs{ 2, 0.1 } do
    local apart, under = over(height, cells)
    for _, pairing in ipairs{ "mortar", "node_to_segment", cells[1] == 2 and "matching" or nil } do
      refused(function() apart:glue{ under, face, pairing = pairing } end, ("'upper' bottom and 'base' top lie %g apart at ("):format(height), "only parts that touch can be glued")
      refused(function() apart:glue{ face, under, pairing = pairing } end, ("lie %g apart at ("):format(height))
    end
    apart:contact{ under, face }
  end
  local near, under = over(0.02, cells)
  near:glue{ under, face }
end
-- Chords of curved parts lie apart as they must.
local function arc(inner, cells)
  local function bend(x, y) return (inner + y) * math.cos(math.pi * x), -(inner + y) * math.sin(math.pi * x) end
  return dotyk.body{ name = "arc " .. inner, material = it.material, mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {cells,2} }:transform(bend) }
end
for _, cells in ipairs{ { 4, 7 }, { 3, 20 }, { 40, 53 } } do
  for _, pairing in ipairs{ "mortar", "node_to_segment" } do
    local inside, outside = arc(1, cells[1]), arc(2, cells[2])
    dotyk.scene{ inside, outside }:glue{ inside:part "top", outside:part "bottom", pairing = pairing }
    dotyk.scene{ inside, outside }:glue{ outside:part "bottom", inside:part "top", pairing = pairing }
  end
end
local glue <const> = two:glue{ face, upper:part "bottom" }
refused(function() two:contact{ face, upper:part "bottom" } end, "already joined by the glue of 'base' top to 'upper' bottom")
refused(function() two:glue{ upper:part "bottom", face } end, "already joined by the glue")
three:part "top":fix()
four:part "top":fix()
local s <const> = dotyk.solve(two)
refused(function() s:contact(glue) end, "glue of 'base' top to 'upper' bottom is a glue; only contacts have a pressure")

-- Rigid obstacles.
refused(function() dotyk.rigid.plane{ point = {0,0}, normal = {0,0} } end, "plane: 'normal' is zero; it must have a direction")
refused(function() dotyk.rigid.gap{ normal = {0,0,0}, gap = 0 } end, "gap: 'normal' is zero")
refused(function() dotyk.rigid.plane{ point = {0,0,0}, normal = {0,1} } end, "'point' has 3 components; it must have 2 here (2-D)")
refused(function() dotyk.rigid.plane{ point = {0}, normal = {1} } end, "'point' must be a table of 2 or 3 numbers, got a table of 1")
refused(function() dotyk.rigid.ball{ center = {0,0}, radius = 0 } end, "'radius' must be a positive number, got the number 0")
refused(function() dotyk.rigid.ball{ center = {0,0}, radius = -1 } end, "'radius' must be a positive number, got the number -1")
refused(function() dotyk.rigid.ball{ center = {0,0}, radius = 1/0 } end, "'radius' must be a finite number, got inf")
local deep <const> = dotyk.rigid.plane{ point = {0,0,0}, normal = {0,0,1} }
refused(function() scene:contact{ it.right, rigid = deep } end, "the rigid plane has 3 components, the scene is 2-D")
local holed <const> = dotyk.rigid.gap{ normal = {1,0}, gap = function(x, y) return y > 0.7 and 0/0 or 1 end }
refused(function() scene:contact{ it.right, rigid = holed } end, "contact: function 'gap' returned nan (not a number) at (1, 1)")

-- An obstacle that overlaps the body at rest, unless that is meant.
local high <const> = dotyk.rigid.plane{ point = {0,0.1}, normal = {0,1} }
local ball <const> = dotyk.rigid.ball{ center = {0.5,-0.5}, radius = 0.7 }
refused(function() scene:contact{ it.bottom, rigid = high } end, "the rigid plane penetrates the part by 0.1 at (0, 0)", "interference = true")
refused(function() scene:contact{ it.bottom, rigid = ball } end, "the rigid ball penetrates the part by 0.2 at (0.5, 0)", "interference = true")
local inner <const> = dotyk.rigid.ball{ center = {0.5,0.3}, radius = 0.1 }
refused(function() scene:contact{ it.bottom, rigid = inner } end, "the rigid ball lies behind the part: at (0.5, 0)")
-- From behind a plane would fill the body and pull the part outwards; a gap measured inwards would as well.
for _, height in ipairs{ 0.9999, 0.5, -1 } do
  local behind <const> = dotyk.rigid.plane{ point = {0,height}, normal = {0,1} }
  for _, interference in ipairs{ false, true } do
    refused(function() scene:contact{ top, rigid = behind, interference = interference } end, "the rigid plane lies behind the part: at (0, 1)", "the part faces away")
  end
end
refused(function() scene:contact{ top, rigid = dotyk.rigid.gap{ normal = {0,-1}, gap = 0 } } end, "the rigid gap lies behind the part: its normal points into the body")
local on_node <const> = dotyk.rigid.ball{ center = {0.5,0}, radius = 0.1 }
refused(function() scene:contact{ it.bottom, rigid = on_node } end, "the centre of the rigid ball lies on the contact part")
local bar <const> = dotyk.body{ mesh = it.mesh, material = it.material }
bar:part "top":fix()
local pressed <const> = dotyk.scene{ bar }
local c <const> = pressed:contact{ bar:part "bottom", rigid = high, interference = true }
check.near(dotyk.solve(pressed):contact(c).force, { 0, 1 }, 1e-12)  -- E × 0.1: the floor pushes upwards
-- The same of two parts, where a negative gap is a press fit and no mistake.
local function stacked(base)
  local function square(name, y)
    return dotyk.body{ name = name, material = it.material,
                       mesh = dotyk.mesh.rectangle{ from = {0,y}, to = {1,y + 1}, cells = {2,2} } }
  end
  local low, high = square("low", 0), square("high", base)
  low:part "bottom":fix()
  high:part "top":fix()
  return dotyk.scene{ low, high }, high:part "bottom", low:part "top"
end
local overlapping <const>, above <const>, below <const> = stacked(0.9)
refused(function() overlapping:contact{ above, below } end, "'high' bottom and 'low' top overlap by 0.1 at (0, 0.9) before any load", "interference = true")
overlapping:contact{ above, below, gap = 0.1 }
local meant <const>, up <const>, down <const> = stacked(0.9)
local fit <const>, over <const>, under <const> = stacked(1)
local pushed <const>, fitted <const> = meant:contact{ up, down, interference = true }, fit:contact{ over, under, gap = -0.1 }
check.near(dotyk.solve(meant):contact(pushed).force, { 0, 0.5 }, 1e-12)  -- E × 0.1, shared by two blocks
check.near(dotyk.solve(fit):contact(fitted).force, { 0, 0.5 }, 1e-12)
-- Normals of any length give the same.
for _, length in ipairs{ 1e-300, 1.7e308 } do
  local far = dotyk.scene{ dotyk.body{ mesh = it.mesh, material = it.material } }
  far.bodies[1]:part "top":fix()
  local tall = dotyk.rigid.plane{ point = {0,0.1}, normal = {0,length} }
  local d = far:contact{ far.bodies[1]:part "bottom", rigid = tall, interference = true }
  check.near(dotyk.solve(far):contact(d).force, { 0, 1 }, 1e-12)
end
