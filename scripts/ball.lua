-- A rigid ball pressed into an elastic block, in space; Hertz's point contact beside it.
--
--   ./dotyk scripts/ball.lua [CELLS]
--
-- A quarter of the block is modelled: the planes x = 0 and y = 0 are planes of symmetry, where the
-- block slides. Shows force, radius and peak pressure beside the closed form (Johnson 1985, section
-- 4.2), and images/ball.png.

local n <const> = tonumber(arg[1]) or 18
local E <const>, nu <const>, R <const>, depth <const> = 1000, 0.3, 2, 0.02
local E_star <const> = E / (1 - nu^2)

-- 1. The quarter block, finer towards the contact.
local function towards(s) return s * (0.25 + 0.75 * s) end
local mesh = dotyk.mesh.box{ from = {0, 0, -1}, to = {1, 1, 0}, cells = {n, n, n}, element = "Q1",
  grading = { x = towards, y = towards, z = function(s) return 1 - towards(1 - s) end } }
local block = dotyk.body{ name = "block", mesh = mesh, material = dotyk.material{ E = E, nu = nu } }
block:part"left":slide()
block:part"front":slide()
block:part"bottom":fix()

-- 2. The ball overlaps the block by the depth that it is pressed in.
local scene = dotyk.scene{ block }
local top = block:part("near", function(x, y, _, _, _, nz) return nz > 0.9 and x^2 + y^2 < 0.4 end)
local contact = scene:contact{ top, interference = true,
                               rigid = dotyk.rigid.ball{ center = {0, 0, R - depth}, radius = R } }
local s = dotyk.solve(scene)
print(s)

-- 3. Hertz for the force found. The block is no half-space, so the depth is not compared.
local c = s:contact(contact)
local force = -4 * c.force[3]
local a = (3 * force * R / (4 * E_star))^(1 / 3)
local p0 = 3 * force / (2 * math.pi * a^2)
print(("force %.4f; contact radius %.4f by area, Hertz %.4f; peak pressure %.2f, Hertz %.2f (%.1f %% off)"):format(
  force, math.sqrt(4 * c.area / math.pi), a, c.max_pressure, p0, 100 * (c.max_pressure / p0 - 1)))

s:render{ file = "images/ball.png", field = "von_mises", deform = 1, view = {-1, -1.4, 0.9} }
print "images/ball.png"
