-- Hertz's contacts: a disc on a rigid plane (line contact) and a rigid ball on a block (point contact), with the
-- closed form beside the first. Loaded by include; solves nothing itself. Units: N, mm.

local hertz = { R = 50, E = 210e3, nu = 0.3, descent = 0.12 } -- descent: of the top of the disc
local R <const>, E <const>, nu <const> = hertz.R, hertz.E, hertz.nu
hertz.E_star = E / (1 - nu^2)

-- A disc that touches y = 0 at the origin, n cells along its radius. The conformal map f(z) = (z - m)/(1 - m z) of the disc
-- onto itself moves its nodes towards the contact: cells there are (1 - m)/(1 + m) of their size.
local m <const> = 0.85
local function refined_disc(n)
  local mesh = dotyk.mesh.disc{ center = {0, R}, radius = R, cells = n }
  return mesh:transform(function(x, y)
    local a, b = (y - R) / R, -x / R -- z = a + b i, the contact at z = -1
    local cr, ci = a - m, b
    local dr, di = 1 - m * a, -m * b
    local d = dr^2 + di^2
    local re, im = (cr * dr + ci * di) / d, (ci * dr - cr * di) / d
    return -R * im, R + R * re
  end)
end

-- The top cap comes down, the bottom meets the plane. Scene, contact.
function hertz.disc(n)
  local disc = dotyk.body{ name = "disc", mesh = refined_disc(n), material = dotyk.material{ E = E, nu = nu } }
  disc:part("cap", function(_, _, _, ny) return ny > 0.4 end):displace{ x = 0, y = -hertz.descent }
  local scene = dotyk.scene{ disc }
  local below = disc:part("below", function(_, y) return y < 0.02 * R end)
  return scene, scene:contact{ below, rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
end

-- The closed form (Johnson 1985, section 4.2) for the force that a solution found: force, half-width a, peak pressure p0.
function hertz.line(s, contact)
  local force = s:contact(contact).force[2]
  local a = math.sqrt(4 * force * R / (math.pi * hertz.E_star))
  return force, a, 2 * force / (math.pi * a)
end

-- The pressure's distance from the closed form in L2, relative, at the contact nodes.
function hertz.line_error(s, contact)
  local _, a, p0 = hertz.line(s, contact)
  local l2 = 0
  for _, node in ipairs(s:contact(contact).nodes) do
    l2 = l2 + node.weight * (node.pressure - p0 * math.sqrt(math.max(0, 1 - (node.x / a)^2)))^2
  end
  return math.sqrt(l2 / (4 / 3 * a * p0^2))
end

-- A rigid ball of radius 2 pressed into a block by a depth: a quarter of it, finer towards the contact. Scene, contact.
hertz.ball = { R = 2, E = 1000, nu = 0.3, depth = 0.02 }
function hertz.ball.scene(n)
  local ball <const> = hertz.ball
  local function towards(s) return s * (0.25 + 0.75 * s) end
  local mesh = dotyk.mesh.box{ from = {0, 0, -1}, to = {1, 1, 0}, cells = {n, n, n}, element = "Q1",
    grading = { x = towards, y = towards, z = function(s) return 1 - towards(1 - s) end } }
  local block = dotyk.body{ name = "block", mesh = mesh, material = dotyk.material{ E = ball.E, nu = ball.nu } }
  block:part"left":slide() -- planes of symmetry
  block:part"front":slide()
  block:part"bottom":fix()
  local scene = dotyk.scene{ block }
  local top = block:part("near", function(x, y, _, _, _, nz) return nz > 0.9 and x^2 + y^2 < 0.4 end)
  -- The ball overlaps the block by the depth that it is pressed in.
  return scene, scene:contact{ top, interference = true, rigid = dotyk.rigid.ball{ center = {0, 0, ball.R - ball.depth}, radius = ball.R } }
end

return hertz
