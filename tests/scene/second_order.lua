-- Cells of order 2 as a script sees them: what they give, and what is for order 1 alone says so.
local check <const>, refused <const> = require "check", require "refused"

local steel <const> = dotyk.material{ E = 100, nu = 0.3 }
local function block(element, name, base, cells)
  local body <const> = dotyk.body{ name = name or "block", material = steel,
    mesh = dotyk.mesh.rectangle{ from = {0, base or 0}, to = {1, (base or 0) + 1}, cells = { cells or 4, 2 }, element = element } }
  body:part "left":slide()
  return body
end

-- 1. Meshes: their element, nodes, and areas by what a body weighs.
local function weight(mesh)
  local b <const> = dotyk.body{ mesh = mesh, material = steel, force = { 0, -1 } }
  local on <const> = mesh.parts[1] == "boundary" and b:part "boundary" or b:part "bottom"
  on:fix()
  return select(2, dotyk.solve(dotyk.scene{ b }):reaction(on))
end
for element, nodes in pairs{ P1 = 3 * 4, Q1 = 3 * 4, P2 = 5 * 7, Q2 = 5 * 7 } do
  local m <const> = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {2, 3}, element = element }
  check.equal({ m.element, m.node_count }, { element, nodes })
  check.near(weight(m), 2)
end
for _, element in ipairs{ "P2", "Q2" } do  -- sides are parabolas: order 4
  local function missing(n) return math.abs(weight(dotyk.mesh.disc{ center = {0, 0}, radius = 1, cells = n, element = element }) - math.pi) end
  check.that(missing(8) < 1e-5 and missing(4) / missing(8) > 14, element)
end

-- 2. Bending: one cell's height of order 2 has Euler's beam, M = σ b²/6 with σ linear, exactly.
for _, element in ipairs{ "P2", "Q2" } do
  local beam <const> = dotyk.body{ material = dotyk.material{ E = 100, nu = 0, plane = "stress" },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {4, 1}, cells = {4, 1}, element = element } }
  beam:part "left":fix()
  beam:part "right":load(function(x, y) return y - 0.5, 0 end)
  local s <const> = dotyk.solve(dotyk.scene{ beam })
  local ux, uy = s:displacement(beam, 4, 0.5)
  check.near({ ux, uy }, { 0, -4^2 / (2 * 100) }, 1e-12)  -- κ = 1/E
  check.near(s:stress(beam, 2, 0.75).xx, 0.25, 1e-11)
end

-- 3. Contact, friction and results of one P2 on one Q2 body.
local lower <const>, upper <const> = block("P2", "lower", 0, 3), block("Q2", "upper", 1, 4)
lower:part "bottom":fix()
upper:part "top":load{ 0.5, -2 }
local scene <const> = dotyk.scene{ lower, upper }
local contact <const> = scene:contact{ upper:part "bottom", lower:part "top", friction = dotyk.friction.coulomb(0.3) }
check.that(tostring(scene):find("mortar", 1, true), tostring(scene))
local s <const> = dotyk.solve(scene)
check.that(s.converged)
local c <const> = s:contact(contact)
check.equal(#c.nodes, 4)  -- corners of the coarser part
check.near(c.force[2], 2, 1e-10)
for _, node in ipairs(c.nodes) do check.that(node.gap > -1e-10 and node.pressure >= 0) end
s:write "second.vtu"
s:write_contact "second.csv"
check.that(dotyk.solve(scene, { start = s }).converged)

-- 4. What is for cells of order 1 says so.
refused(function() s:error_estimate() end, "'lower' is of P2", "order 1")
local one <const> = block("Q2")
one:part "bottom":fix()
one:part "top":load{ 0, -1 }
refused(function() dotyk.shape{ scene = dotyk.scene{ one }, moves = { { part = one:part "right", control_points = 3, direction = {1, 0}, lower = 0, upper = 0.1 } } } end,
        "'block' is of Q2", "P1 or Q1")
refused(function() dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2}, element = "P2" }, load = -1 } end, "P2")
refused(function()
  dotyk.adapt{ tol = 0.1, mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2}, element = "P2" }, scene = function(mesh)
    local body <const> = dotyk.body{ mesh = mesh, material = steel }
    body:part "bottom":fix()
    return dotyk.scene{ body }
  end }
end, "P2")
refused(function() dotyk.refinement{ dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2}, element = "P2" } } end, "P2")
local a <const>, b <const> = block("P2", "a"), block("P2", "b", 1)
local two <const> = dotyk.scene{ a, b }
refused(function() two:contact{ b:part "bottom", a:part "top", friction = dotyk.friction.tresca(1), multipliers = "P1-P0" } end, "P1-P0", "order 1", "'b' is of P2")
local p1 <const> = block("P1", "c", 1)
local mixed <const> = dotyk.scene{ a, p1 }
refused(function() mixed:contact{ p1:part "bottom", a:part "top", pairing = "matching" } end, "do not match")
refused(function() dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2}, element = "P3" } end, "'element' must be")
refused(function() dotyk.repeated_systems{ scene = dotyk.scene{ one }, velocities = { function(x, y) return x, 0 end } } end, "'block' is of Q2", "P1 or Q1")

-- Node to segment asks for the feet of all nodes of a facet: an octagon's facet on its corner has none on a block of two cells.
do
  local ball <const> = dotyk.body{ name = "ball", material = steel, mesh = dotyk.mesh.disc{ center = {0, 1}, radius = 1, cells = 2, element = "Q2" } }
  local base <const> = dotyk.body{ name = "base", material = steel, mesh = dotyk.mesh.rectangle{ from = {-0.9, -1}, to = {0.9, 0}, cells = {2, 1}, element = "Q2" } }
  local low <const> = ball:part("low", function(x, y, nx, ny) return ny < -0.2 end)
  refused(function() dotyk.scene{ ball, base }:contact{ low, base:part "top", pairing = "node_to_segment" } end,
    "no facet of one has feet of all its nodes on the other, as node_to_segment asks of order 2: take smaller cells, or mortar")
end

-- Curved sides in space, of cells alike: the answer does not depend on which part is named first.
local function pressed(element, swapped)
  local function box(name, base, height, E)
    local mesh <const> = dotyk.mesh.box{ from = {0, 0, base}, to = {4, 4, base + 4}, cells = {2, 2, 2}, element = element }
    mesh:transform(function(x, y, z) return x, y, z + height(x, y) * (1 - math.abs(z) / 4) end)
    return dotyk.body{ name = name, mesh = mesh, material = dotyk.material{ E = E, nu = 0.2 } }
  end
  local upper <const> = box("upper", 0, function(x, y) return 0.02 * (x^2 + y^2) end, 3000)
  local lower <const> = box("lower", -4, function(x) return -0.03 * x^2 end, 1000)
  upper:part "top":displace{ x = 0.05, y = 0.02, z = -0.2 }
  lower:part "bottom":fix()
  local parts = { upper:part "bottom", lower:part "top" }
  if swapped then parts[1], parts[2] = parts[2], parts[1] end
  local scene <const> = dotyk.scene{ upper, lower }
  local contact <const> = scene:contact{ parts[1], parts[2], friction = dotyk.friction.coulomb(0.2) }
  local s <const> = dotyk.solve(scene)
  check.that(s.converged, s.reason)
  local force <const>, sign <const> = s:contact(contact).force, swapped and -1 or 1
  return { sign * force[1], sign * force[2], sign * force[3] }
end
for _, element in ipairs{ "P2", "Q2" } do check.near(pressed(element, false), pressed(element, true), 1e-7) end
