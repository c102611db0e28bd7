-- Hertz's line contact of two elastic blocks of one material, the upper one's lower side a parabola: the right half, refined
-- towards the contact, nodes of the two matching or not. With the closed form beside it. Loaded by include. Units: N, mm.

local hertz = { R = 100, E = 210e3, nu = 0.3, size = 100 }
local R <const>, size <const> = hertz.R, hertz.size
local steel <const> = dotyk.material{ E = hertz.E, nu = hertz.nu }
local E_star <const> = hertz.E / (1 - hertz.nu^2) / 2 -- of both blocks

-- Widths of cells grow e^4.5 times from the contact outwards.
local function towards(s) return (math.exp(4.5 * s) - 1) / (math.exp(4.5) - 1) end

-- n and m cells along the edges of the upper (first) and the lower block, the top pressed down. Scene, contact.
function hertz.scene(n, m, pairing, element, down)
  local upper = dotyk.mesh.rectangle{ from = {0, 0}, to = {size, size}, cells = {n, n}, element = element,
    grading = { x = towards, y = towards } }:transform(function(x, y) return x, y + x^2 / (2 * R) * (1 - y / size) end)
  local lower = dotyk.mesh.rectangle{ from = {0, -size}, to = {size, 0}, cells = {m, m}, element = element,
    grading = { x = towards, y = function(s) return 1 - towards(1 - s) end } }
  upper = dotyk.body{ name = "upper", mesh = upper, material = steel }
  lower = dotyk.body{ name = "lower", mesh = lower, material = steel }
  upper:part"left":slide()
  lower:part"left":slide()
  lower:part"bottom":fix()
  upper:part"top":displace{ x = 0, y = -down }
  local scene = dotyk.scene{ upper, lower }
  local below = upper:part("below", function(x, _, _, ny) return ny < -0.8 and x < 12 end)
  return scene, scene:contact{ below, lower:part"top", pairing = pairing }
end

-- The closed form (Johnson 1985, section 4.2) for the force that a solution found: half-width a, peak pressure p0; and the
-- pressure's distance from it in L2, relative, at the contact nodes, and the peak's.
function hertz.compare(s, contact)
  local c = s:contact(contact)
  local force = 2 * c.force[2]
  local a = math.sqrt(4 * force * R / (math.pi * E_star))
  local p0, l2 = 2 * force / (math.pi * a), 0
  for _, node in ipairs(c.nodes) do
    l2 = l2 + 2 * node.weight * (node.pressure - p0 * math.sqrt(math.max(0, 1 - (node.x / a)^2)))^2
  end
  return { a = a, p0 = p0, l2 = math.sqrt(l2 / (4 / 3 * a * p0^2)), peak = math.abs(c.max_pressure / p0 - 1), nodes = c.nodes }
end

return hertz
