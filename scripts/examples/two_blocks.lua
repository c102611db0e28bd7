-- Two elastic blocks of different stiffness, the arched upper one pressed onto the lower.
--
--   ./dotyk scripts/examples/two_blocks.lua [CELLS]
--
-- The right half is modelled: x = 0 is a line of symmetry. The upper block is held by contact alone in
-- the vertical direction: no spring is added. Shows the balance of forces, and images/two_blocks.png.

local n <const> = tonumber(arg[1]) or 24
local soft <const>, stiff <const> = dotyk.material{ E = 1000, nu = 0.3 }, dotyk.material{ E = 4000, nu = 0.3 }

-- 1. The gap between the blocks grows outwards.
local lower = dotyk.body{ name = "lower", material = soft,
  mesh = dotyk.mesh.rectangle{ from = {0, -1}, to = {1.5, 0}, cells = {3 * n // 2, n} } }
local upper = dotyk.body{ name = "upper", material = stiff,
  mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 0.6}, cells = {n, 2 * n // 3} }:transform(
    function(x, y) return x, y + 0.03 * x^2 end) }
lower:part"bottom":fix()
lower:part"left":slide()
upper:part"left":slide()
upper:part"top":pressure(20)

-- 2. What touches.
local scene = dotyk.scene{ lower, upper }
local contact = scene:contact{ upper:part"bottom", lower:part"top" }
print(scene:plan())

-- 3. The solution, and whether it balances.
local s = dotyk.solve(scene)
print(s)
local c = s:contact(contact)
local fx, fy = s:reaction(lower:part"bottom")
local sideways = fx + s:reaction(lower:part"left") - c.force[1]
print(("contact carries %.10f, the support below %.10f; sideways all forces on the lower block add up to %.1e"):format(
  c.force[2], fy, sideways))

s:render{ file = "images/two_blocks.png", field = "yy", units = { length = "mm", stress = "MPa", load = "MPa" }, deform = 1, supports = true, loads = true }
print "images/two_blocks.png"
