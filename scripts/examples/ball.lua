-- A rigid ball pressed into an elastic block, in space; Hertz's point contact beside it.
--
--   ./dotyk scripts/examples/ball.lua [CELLS]
--
-- A quarter of the block is modelled: the planes x = 0 and y = 0 are planes of symmetry, where the
-- block slides. Shows force, radius and peak pressure beside the closed form (Johnson 1985, section
-- 4.2), and images/ball.png.

local n <const> = tonumber(arg[1]) or 18
local ball <const> = include "../lib/hertz.lua".ball
local R <const>, E_star <const> = ball.R, ball.E / (1 - ball.nu^2)

-- 1. The quarter block and its solution.
local scene, contact = ball.scene(n)
local s = dotyk.solve(scene)
print(s)

-- 2. Hertz for the force found. The block is no half-space, so the depth is not compared.
local c = s:contact(contact)
local force = -4 * c.force[3]
local a = (3 * force * R / (4 * E_star))^(1 / 3)
local p0 = 3 * force / (2 * math.pi * a^2)
print(("force %.4f; contact radius %.4f by area, Hertz %.4f; peak pressure %.2f, Hertz %.2f (%.1f %% off)"):format(
  force, math.sqrt(4 * c.area / math.pi), a, c.max_pressure, p0, 100 * (c.max_pressure / p0 - 1)))

s:render{ file = "images/ball.png", field = "von_mises", units = { length = "mm", stress = "MPa" }, deform = 1, view = {-1, -1.4, 0.9} }
print "images/ball.png"
