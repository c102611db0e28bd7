-- Hertz's line contact: an elastic disc pressed onto a rigid plane.
--
--   ./dotyk scripts/studies/accuracy/hertz.lua [CELLS]
--
-- Shows peak pressure and half-width of the contact beside the closed form
-- (Johnson 1985, section 4.2), their observed orders over four refinements, and
-- draws images/hertz.png and images/hertz_pressure.png. Units: N, mm.

local cells <const> = tonumber(arg[1]) or 128 -- along the radius, on the finest mesh
local hertz <const> = include "../../lib/hertz.lua"
local fit <const> = include "../../lib/least_squares.lua"

-- 1. What the nodes say beside the closed form: p² is linear in x², so a least-squares line through the inner nodes gives the
-- half-width.
local function compare(s, contact)
  local c = s:contact(contact)
  local force, a, p0 = hertz.line(s, contact)
  local squares, pressures, middle = {}, {}, nil
  for _, node in ipairs(c.nodes) do
    if math.abs(node.x) < 0.9 * a then
      squares[#squares + 1], pressures[#pressures + 1] = node.x^2, node.pressure^2
    end
    if not middle or math.abs(node.x) < math.abs(middle.x) then middle = node end
  end
  return { force = force, a = a, p0 = p0, peak = middle.pressure, nodes = c.nodes,
           width = math.sqrt(fit.zero(squares, pressures)), l2 = hertz.line_error(s, contact) }
end

-- 2. Five meshes, four refinements. The single errors jump about: how far the contact's edge lies from
-- the nearest node is different on every mesh. The order is the slope of the least-squares line.
print(("disc R = %g mm on a rigid plane, E = %g MPa, nu = %g; Hertz for the force found"):format(hertz.R, hertz.E, hertz.nu))
print "cells  unknowns  closed      force    peak pressure [MPa]          half-width [mm]           pressure  seconds"
print "                            [N/mm]    found     Hertz    error    found    Hertz    error    in L2"
local s, result
local h, peak, width, l2 = {}, {}, {}, {}
for k = 4, 0, -1 do
  local n = math.max(6, cells >> k)
  local scene, contact = hertz.disc(n)
  s = dotyk.solve(scene)
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

-- 3. Figures.
s:render{ file = "images/hertz.png", field = "von_mises", window = {-5, -2, 5, 5}, units = { length = "mm", stress = "MPa" } }
local x, p, hx, hp = {}, {}, {}, {}
for i, node in ipairs(result.nodes) do
  if i % 3 == 0 and math.abs(node.x) < 1.6 * result.a then -- every third, beside the curve
    x[#x + 1], p[#p + 1] = node.x, node.pressure
  end
end
for i = -100, 100 do
  hx[#hx + 1], hp[#hp + 1] = result.a * i / 100, result.p0 * math.sqrt(1 - (i / 100)^2)
end
dotyk.chart{ file = "images/hertz_pressure.png", x = "x [mm]", y = "contact pressure [MPa]", y_range = { -150, 1.05 * result.p0 },
             series = { { name = "nodes", x = x, y = p, style = "points" },
                        { name = "Hertz", x = hx, y = hp, reference = true } } }
print "images/hertz.png, images/hertz_pressure.png"
