-- Hertz's line contact: an elastic disc pressed onto a rigid plane.
--
--   ./dotyk scripts/hertz.lua [CELLS]
--
-- Shows peak pressure and half-width of the contact beside the closed form
-- (Johnson 1985, section 4.2), their observed orders over four refinements, and
-- draws images/hertz.png and images/hertz_pressure.png. Units: N, mm.

local cells <const> = tonumber(arg[1]) or 128 -- along the radius, on the finest mesh
local R <const>, E <const>, nu <const> = 50, 210e3, 0.3
local E_star <const> = E / (1 - nu^2)
local descent <const> = 0.12 -- of the top of the disc
local fit <const> = dofile((arg[0]:match "^(.*)/[^/]*$" or ".") .. "/scenes/least_squares.lua")

-- 1. A disc that touches y = 0 at the origin. The conformal map f(z) = (z - m)/(1 - m z) of the disc
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

-- 2. The scene: the top cap comes down, the bottom meets the plane.
local function press(n)
  local disc = dotyk.body{ name = "disc", mesh = refined_disc(n), material = dotyk.material{ E = E, nu = nu } }
  disc:part("cap", function(_, _, _, ny) return ny > 0.4 end):displace{ x = 0, y = -descent }
  local scene = dotyk.scene{ disc }
  local below = disc:part("below", function(_, y) return y < 0.02 * R end)
  local contact = scene:contact{ below, rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
  return dotyk.solve(scene), contact, disc
end

-- 3. The closed form for the force that the solution found, and what the nodes say of it: p² is linear
-- in x², so a least-squares line through the inner nodes gives the half-width.
local function compare(s, contact)
  local c = s:contact(contact)
  local force = c.force[2]
  local a = math.sqrt(4 * force * R / (math.pi * E_star))
  local p0 = 2 * force / (math.pi * a)
  local squares, pressures, l2, middle = {}, {}, 0, nil
  for _, node in ipairs(c.nodes) do
    if math.abs(node.x) < 0.9 * a then
      squares[#squares + 1], pressures[#pressures + 1] = node.x^2, node.pressure^2
    end
    if not middle or math.abs(node.x) < math.abs(middle.x) then middle = node end
    local hertz = p0 * math.sqrt(math.max(0, 1 - (node.x / a)^2))
    l2 = l2 + node.weight * (node.pressure - hertz)^2
  end
  return { force = force, a = a, p0 = p0, peak = middle.pressure, nodes = c.nodes,
           width = math.sqrt(fit.zero(squares, pressures)),
           l2 = math.sqrt(l2 / (4 / 3 * a * p0^2)) }
end

-- 4. Five meshes, four refinements. The single errors jump about: how far the contact's edge lies from
-- the nearest node is different on every mesh. The order is the slope of the least-squares line.
print(("disc R = %g mm on a rigid plane, E = %g MPa, nu = %g; Hertz for the force found"):format(R, E, nu))
print "cells  unknowns  closed      force    peak pressure [MPa]          half-width [mm]           pressure  seconds"
print "                            [N/mm]    found     Hertz    error    found    Hertz    error    in L2"
local s, contact, disc, result
local h, peak, width, l2 = {}, {}, {}, {}
for k = 4, 0, -1 do
  local n = math.max(6, cells >> k)
  s, contact, disc = press(n)
  result = compare(s, contact)
  h[#h + 1], l2[#l2 + 1] = 1 / n, result.l2
  peak[#peak + 1] = math.max(math.abs(result.peak / result.p0 - 1), 1e-6)
  width[#width + 1] = math.max(math.abs(result.width / result.a - 1), 1e-6)
  print(("%5d %9d %7d  %9.3f  %7.2f  %8.2f  %6.3f%%  %7.5f  %7.5f  %6.3f%%  %6.3f%%  %7.3f"):format(
    n, s.unknowns, s:contact(contact).closed, result.force, result.peak, result.p0, 100 * peak[#peak],
    result.width, result.a, 100 * width[#width], 100 * l2[#l2], s.time.total))
end
print(("observed order: peak pressure %.2f, half-width %.2f, pressure in L2 %.2f (theory: 1, for the root at the edge)")
  :format(fit.order(h, peak), fit.order(h, width), fit.order(h, l2)))
print(s)

-- 5. Figures.
s:render{ file = "images/hertz.png", field = "von_mises", window = {-5, -2, 5, 5}, unit = "MPa" }
local x, p, hx, hp = {}, {}, {}, {}
for _, node in ipairs(result.nodes) do
  if math.abs(node.x) < 1.6 * result.a then
    x[#x + 1], p[#p + 1] = node.x, node.pressure
  end
end
for i = -100, 100 do
  hx[#hx + 1], hp[#hp + 1] = result.a * i / 100, result.p0 * math.sqrt(1 - (i / 100)^2)
end
dotyk.chart{ file = "images/hertz_pressure.png", x = "x [mm]", y = "contact pressure [MPa]",
             series = { { name = "nodes", x = x, y = p, style = "points" },
                        { name = "Hertz", x = hx, y = hp, reference = true } } }
print "images/hertz.png, images/hertz_pressure.png"
