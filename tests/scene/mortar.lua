-- Contact and glue of parts whose nodes do not match, as a script sees them.
local is <const>, refused <const> = require("check").that, require "refused"

local steel <const> = dotyk.material{ E = 1000, nu = 0.3 }
local function block(name, base, cells)
  local body = dotyk.body{ name = name, material = steel,
    mesh = dotyk.mesh.rectangle{ from = {0, base}, to = {1, base + 1}, cells = {cells, 4} } }
  body:part"left":slide()
  return body
end
local lower <const>, upper <const> = block("lower", 0, 5), block("upper", 1, 7)
lower:part"bottom":slide()
upper:part"top":pressure(10)

-- 1. Nodes decide, or the script; the report says which.
local function solved(pairing)
  local scene = dotyk.scene{ lower, upper }
  local contact = scene:contact{ upper:part"bottom", lower:part"top", pairing = pairing }
  return dotyk.solve(scene), contact, scene
end
local s, contact, scene = solved()
-- On triangles the multipliers are the coarser part's; forces and normals stay those of the part that was named first.
is(tostring(scene):find("6 rows, frictionless, mortar", 1, true), tostring(scene))
local c = s:contact(contact)
is(c.closed == 6 and math.abs(c.force[2] - 10) < 1e-11)
for _, node in ipairs(c.nodes) do is(math.abs(node.normal[2] + 1) < 1e-15) end
for _, node in ipairs(c.nodes) do is(math.abs(node.pressure - 10) < 1e-10 and math.abs(node.gap) < 1e-12) end
local feet, uneven, other = solved "node_to_segment"
is(tostring(other):find("node to segment", 1, true), tostring(other))
local least = math.huge
for _, node in ipairs(feet:contact(uneven).nodes) do least = math.min(least, node.pressure) end
is(math.abs(feet:contact(uneven).force[2] - 10) < 1e-11 and least < 9.5, least)
-- 2. What goes with matching nodes only says so.
local two <const> = dotyk.scene{ lower, upper }
local bottom <const>, top <const> = upper:part"bottom", lower:part"top"
refused(function() two:contact{ bottom, top, pairing = "matching" } end, "do not match", 'pairing = "mortar"')
refused(function() two:contact{ bottom, top, pairing = "mortars" } end, 'did you mean "mortar"')
refused(function() two:contact{ bottom, top, multipliers = "P1-P0" } end, "for matching nodes")
refused(function() two:contact{ bottom, rigid = dotyk.rigid.plane{ point = {0, 1}, normal = {0, 1} }, pairing = "mortar" } end, "'pairing' is for two parts")
local again <const> = two:contact{ bottom, top }
refused(function() two:contact{ bottom, top } end, "already joined")
refused(function() again:inf_sup{ part = "normal" } end, "inf-sup constants are computed for matching nodes")

-- 3. Results go where others do.
is(s:error_estimate() < 1e-5)
s:write "mortar.vtu"
s:write_contact "mortar.csv"
is(dotyk.solve(scene, { start = s }).converged)

-- 4. Glue.
local glued <const> = dotyk.scene{ lower, upper }
local tie <const> = glued:glue{ bottom, top }
is(tostring(glued):find("8 nodes, mortar", 1, true), tostring(glued))
local t <const> = dotyk.solve(glued)
is(math.abs(t:stress(upper, 0.4, 1.5).yy + 10) < 1e-9)
is(tie.name:find "glue")

-- 5. Parts that nowhere overlap have no gap below 0 in the mean, though dual hats are negative in places: one facet, covered in part
-- by a body that touches it at one corner and is 0.3 above it at the other, is at rest.
local one <const> = dotyk.material{ E = 1000, nu = 0.3 }
local wide <const> = dotyk.body{ name = "wide", material = one, mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {3, 1}, cells = {1, 1}, element = "Q1" } }
local narrow <const> = dotyk.body{ name = "narrow", material = one, mesh = dotyk.mesh.rectangle{ from = {1, 1}, to = {2, 2}, cells = {1, 1}, element = "Q1" }
  :transform(function(x, y) return x, y + 0.3 * (x - 1) * (2 - y) end) }
wide:part"bottom":fix()
narrow:part"top":displace{ x = 0, y = 0 }
for _, interference in ipairs{ false, true } do
  local apart <const> = dotyk.scene{ wide, narrow }
  local touching <const> = apart:contact{ wide:part"top", narrow:part"bottom", pairing = "mortar", interference = interference }
  for _, node in ipairs(dotyk.solve(apart):contact(touching).nodes) do is(node.gap >= 0 and node.pressure == 0, node.gap) end
end

-- 6. A part that overhangs the other by slivers of its facets: the pressure does not grow as these fall to nothing, and forces act where nodes say.
for _, shift in ipairs{ 0, 1e-8, 1e-5, 1e-3, 0.01, 0.03, 0.05, 0.07 } do
  local above <const> = dotyk.body{ name = "above", material = dotyk.material{ E = 210e3, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {-0.5 + shift, 0}, to = {1.5 + shift, 0.5}, cells = {20, 5} } }
  local below <const> = dotyk.body{ name = "below", material = dotyk.material{ E = 2e3, nu = 0.3 }, mesh = dotyk.mesh.rectangle{ from = {0, -0.5}, to = {1, 0}, cells = {45, 6} } }
  below:part"bottom":fix()
  above:part"top":displace{ x = 0, y = -0.01 }
  local over <const> = dotyk.scene{ above, below }
  local slivers <const> = over:contact{ above:part"bottom", below:part"top", pairing = "mortar" }
  local result <const> = dotyk.solve(over):contact(slivers)
  local moment = 0
  for _, node in ipairs(result.nodes) do moment = moment + node.force * (node.x - 0.5) end
  is(result.max_pressure > 48 and result.max_pressure < 50, shift .. ": " .. result.max_pressure)
  is(math.abs(moment) < 0.01 * result.force[2], shift .. ": " .. moment) -- the scene is symmetric but for the mesh
end

-- 7. A small body on one or two facets of a coarse one can still be turned: multipliers are left out only where the others bear every moment.
local function tilted(n)
  local small <const> = dotyk.body{ name = "small", material = one, mesh = dotyk.mesh.rectangle{ from = {0.25, 0}, to = {0.4, 0.3}, cells = {3, 6} } }
  local base <const> = dotyk.body{ name = "base", material = one, mesh = dotyk.mesh.rectangle{ from = {0, -1}, to = {1, 0}, cells = {n, n} } }
  base:part"bottom":fix()
  small:part"top":displace{ x = 0, y = function(x) return -0.2 * (x - 0.325) end }
  local on <const> = dotyk.scene{ small, base }
  local between <const> = on:contact{ small:part"bottom", base:part"top" }
  return dotyk.solve(on):contact(between).force[2]
end
is(math.abs(tilted(4) / tilted(8) - 1) < 0.3, tilted(4)) -- with one row it would be 0
local function swayed(n, named)
  local small <const> = dotyk.body{ name = "small", material = one, mesh = dotyk.mesh.rectangle{ from = {0.25, 0}, to = {0.4, 0.3}, cells = {3, 6} } }
  local base <const> = dotyk.body{ name = "base", material = one, mesh = dotyk.mesh.rectangle{ from = {0, -1}, to = {1, 0}, cells = {n, n} } }
  base:part"bottom":fix()
  small:part"top":load{ 0.1, 0 }
  local on <const> = dotyk.scene{ small, base }
  if named == "base" then on:glue{ base:part"top", small:part"bottom" } else on:glue{ small:part"bottom", base:part"top" } end
  return (dotyk.solve(on):displacement(small, 0.325, 0.3))
end
is(math.abs(swayed(4, "base") / swayed(4, "small") - 1) < 0.5, swayed(4, "base"))
