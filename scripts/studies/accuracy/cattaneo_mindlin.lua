-- Cattaneo and Mindlin's contact: two equal elastic bodies pressed together and then sheared by less than
-- friction holds. The middle of the contact sticks, its rim slips.
--
--   ./dotyk scripts/studies/accuracy/cattaneo_mindlin.lua [CELLS]
--
-- Pressure, shear and stick zone beside the closed form (Johnson 1985, section 7.2) with their observed
-- orders, the force at which everything slides, and a cycle of loading, unloading and reloading with the
-- work it dissipates. Draws images/cattaneo_mindlin.png, images/cattaneo_mindlin_zones.png and
-- images/hysteresis.png. Units: N, mm.

local cells <const> = tonumber(arg[1]) or 512 -- along the contact line, on the finest mesh
local R <const>, E <const>, nu <const>, mu <const> = 50, 210e3, 0.3, 0.3
local E_star <const> = E / (1 - nu^2) / 2     -- of the pair
local L <const> = 60                          -- half the width and the height of each block
local press <const>, pull <const> = 0.0436, 0.0105 -- of the top
local fit <const> = include "../../lib/least_squares.lua"

-- 1. Two square blocks that touch along a line: the gap is that of a cylinder of radius R on a plane. Equal
-- materials, so that pressing causes no slip and shearing no pressure (Dundurs' second constant is 0). The
-- mesh is graded like sinh, towards the contact.
local beta <const> = math.log(L + math.sqrt(L^2 + 1))
local function graded(t) return (math.exp(beta * t) - math.exp(-beta * t)) / 2 / L end -- odd, [-1,1] onto itself
local along <const> = function(s) return (1 + graded(2 * s - 1)) / 2 end
local function pair(n, law)
  local function block(name, y, depth)
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = nu },
      mesh = dotyk.mesh.rectangle{ from = {-L, y}, to = {L, y + L}, cells = {n, n // 2}, element = "Q1",
                                   grading = { x = along, y = depth } } }
  end
  local lower = block("lower", -L, function(s) return 1 - graded(1 - s) end)
  local upper = block("upper", 0, graded)
  lower:part "bottom":fix()
  upper:part "top":displace{ y = -press }:displace{ x = pull, case = "shear" }
  local scene = dotyk.scene{ lower, upper }
  local near = function(x, y) return math.abs(y) < 1e-9 and math.abs(x) < 3 end
  local contact = scene:contact{ upper:part("near", near), lower:part("near", near), friction = law,
                                 gap = function(x) return x^2 / (2 * R) end }
  return scene, contact, upper
end

-- 2. First pressed, then sheared: two steps, for friction remembers the way.
local function shear_to(...)
  local steps = {}
  for k, factor in ipairs{ ... } do steps[k] = { load = { shear = factor } } end
  return { steps = steps }
end
local coulomb <const> = dotyk.friction.coulomb(mu)
local function solve(n)
  local scene, contact, upper = pair(n, coulomb)
  return dotyk.solve(scene, shear_to(0, 1)), contact, upper
end

-- 3. The closed form for the forces P and Q that the solution found:
--   p = p0 √(1 − x²/a²),  q = μ p − μ p0 (c/a) √(1 − x²/c²),  a² = 4PR/(πE*),  c² = a² (1 − Q/μP).
-- p² is linear in x², and so is (μp − q)² where it sticks: least-squares lines through the inner nodes give
-- the half-widths found.
local function add(points, x, y) points.x[#points.x + 1], points.y[#points.y + 1] = x, y end
local function half_width(points) return math.sqrt(fit.zero(points.x, points.y)) end
local function root(x) return math.sqrt(math.max(0, x)) end
local function closed_form(P, Q)
  local a = math.sqrt(4 * P * R / (math.pi * E_star))
  local c, p0 = a * math.sqrt(1 - Q / (mu * P)), 2 * P / (math.pi * a)
  local function p(x) return p0 * root(1 - (x / a)^2) end
  return { a = a, c = c, p0 = p0, p = p, q = function(x) return mu * p(x) - mu * p0 * c / a * root(1 - (x / c)^2) end }
end
local function compare(s, contact)
  local r = s:contact(contact)
  local P, Q = r.force[2], -r.friction_force[1] -- on the upper body
  local exact = closed_form(P, Q)
  local inner, stuck, l2p, l2q, p2, q2 = { x = {}, y = {} }, { x = {}, y = {} }, 0, 0, 0, 0
  for _, node in ipairs(r.nodes) do
    local x, p, q = node.x, node.pressure, -node.shear[1]
    if math.abs(x) < 0.9 * exact.a then add(inner, x^2, p^2) end
    if math.abs(x) < 0.9 * exact.c then add(stuck, x^2, (mu * p - q)^2) end
    l2p, l2q = l2p + node.weight * (p - exact.p(x))^2, l2q + node.weight * (q - exact.q(x))^2
    p2, q2 = p2 + node.weight * exact.p(x)^2, q2 + node.weight * exact.q(x)^2
  end
  return { P = P, Q = Q, exact = exact, nodes = r.nodes, a = half_width(inner), c = half_width(stuck),
           l2p = math.sqrt(l2p / p2), l2q = math.sqrt(l2q / q2), stick = r.stick, slip = r.slip }
end

-- 4. Refinement. The single errors jump about with the place of the zones' ends between the nodes: the order
-- is the slope of the least-squares line.
print(("blocks of %g mm, R = %g mm, E = %g MPa, nu = %g, mu = %g"):format(2 * L, R, E, nu, mu))
print "cells  unknowns  stick slip    P [N/mm]   Q/(mu P)   half-width a [mm]         stick half-width c [mm]   L2 error of     seconds"
print "                                                     found   closed    error    found   closed    error     p       q"
local s, contact, upper, result
local h, ea, ec, ep, eq = {}, {}, {}, {}, {}
for k = 4, 0, -1 do
  local n = cells >> k
  if n < 32 then goto continue end -- too coarse for a zone that sticks
  s, contact, upper = solve(n)
  result = compare(s, contact)
  local exact, i = result.exact, #h + 1
  h[i], ep[i], eq[i] = 1 / n, result.l2p, result.l2q
  ea[i], ec[i] = math.abs(result.a / exact.a - 1), math.abs(result.c / exact.c - 1)
  print(("%5d %9d  %5d %4d  %10.4f   %.6f   %.5f  %.5f  %6.3f%%  %.5f  %.5f  %6.3f%%  %6.3f%% %6.3f%%  %7.3f"):format(
    n, s.unknowns, result.stick, result.slip, result.P, result.Q / (mu * result.P), result.a, exact.a, 100 * ea[i],
    result.c, exact.c, 100 * ec[i], 100 * ep[i], 100 * eq[i], s.time.total))
  ::continue::
end
if #h >= 3 then -- piecewise constant forces and roots at the ends: order 1
  assert(fit.order(h, ep) > 0.9 and fit.order(h, eq) > 0.9, "pressure and shear do not converge as they should")
  assert(ea[#h] < 0.02 and ec[#h] < 0.02, "the zones are not where they should be")
end
print(("observed order: half-width %.2f, stick half-width %.2f, pressure in L2 %.2f, shear in L2 %.2f (theory in L2: 1, for the roots)")
  :format(fit.order(h, ea), fit.order(h, ec), fit.order(h, ep), fit.order(h, eq)))

-- 5. Pressing alone causes no slip, shearing no pressure; and sheared far enough everything slides, with the
-- force mu P.
local pressed = s.steps[1]:contact(contact)
print(("pressed alone: friction %.1e of the pressing force, which shearing changes by %.1e of it"):format(
  math.abs(pressed.friction_force[1]) / pressed.force[2], math.abs(result.P / pressed.force[2] - 1)))
assert(math.abs(pressed.friction_force[1]) < 1e-10 * pressed.force[2] and math.abs(result.P / pressed.force[2] - 1) < 1e-10)
local coarse <const> = math.max(64, cells >> 1)
do
  local scene, c = pair(coarse, coulomb)
  local r = dotyk.solve(scene, shear_to(0, 4)):contact(c)
  print(("sheared four times as far: %d stick, %d slip, Q/(mu P) - 1 = %.1e"):format(
    r.stick, r.slip, -r.friction_force[1] / (mu * r.force[2]) - 1))
  assert(r.stick == 0 and math.abs(-r.friction_force[1] / (mu * r.force[2]) - 1) < 1e-10)
end

-- 6. A cycle: sheared to and fro. With q = Q/μP the tangential displacement of the bodies against each other is
-- C Q + w(Q): elastic, with a compliance C that a half-plane leaves open and the blocks' size sets (it is fitted
-- to the first loading), and what slip adds,
--   w = μP/(πE*) ((1 − q) ln(1 − q) + q);
-- after a turn at ±Q* it is ∓(C ΔQ + 2 w(ΔQ/2)) from there (Mindlin and Deresiewicz), and a
-- cycle dissipates the area of the loop,
--   (μP)²/(πE*) (4 (1 − q*) ln(1 − q*) + 4 q* − 2 q*²).
local path, legs <const> = { 0 }, { { 0, 1 }, { 1, -1 }, { -1, 1 }, { 1, 0.2 } }
for _, leg in ipairs(legs) do
  local n = math.ceil(12 * math.abs(leg[2] - leg[1]))
  for k = 1, n do path[#path + 1] = leg[1] + (leg[2] - leg[1]) * k / n end
end
local scene, loop_contact = pair(coarse, coulomb)
local loop <const> = dotyk.solve(scene, shear_to(table.unpack(path)))
local q, excess, work, P = {}, {}, {}, loop:contact(loop_contact).force[2]
for k, step in ipairs(loop.steps) do
  local r = step:contact(loop_contact)
  q[k], work[k] = -r.friction_force[1] / (mu * P), r.dissipated
end
local function w(x) return 1e3 * mu * P / (math.pi * E_star) * ((1 - x) * math.log(1 - x) + x) end -- µm
local top <const> = q[13] -- at the first turn
local sum, squares = 0, 0
for k = 1, 13 do sum, squares = sum + q[k] * (1e3 * path[k] * pull - w(q[k])), squares + q[k]^2 end
for k = 1, #path do excess[k] = 1e3 * path[k] * pull - sum / squares * q[k] end
local function on_loop(x, turn)    -- turn: nil before the first, else the sign of q where it turned
  if not turn then return w(x) end
  return turn * (w(top) - 2 * w((top - turn * x) / 2))
end
local worst, turn = 0, nil
for k = 1, #path do
  worst = math.max(worst, math.abs(excess[k] - on_loop(q[k], turn)))
  if k == 13 then turn = 1 elseif k == 37 then turn = -1 elseif k == 61 then turn = 1 end
end
local cycle <const> = work[61] - work[13]
local exact <const> = (mu * P)^2 / (math.pi * E_star) * (4 * (1 - top) * math.log(1 - top) + 4 * top - 2 * top^2)
print(("cycle between Q = ±%.4f mu P in %d steps, %d cells, %.3f s (%.3f s of it the factorisation):"):format(
  top, #path, coarse, loop.time.total, loop.time.factor))
print(("  dissipated in a cycle %.6f N, closed form %.6f N: %.2f%%; the loop's points lie within %.2f%% of its width"):format(
  cycle, exact, 100 * (cycle / exact - 1), 100 * worst / (2 * w(top))))
assert(math.abs(excess[61] - excess[13]) < 1e-9 * w(top), "the loop does not close")
if coarse >= 128 then assert(math.abs(cycle / exact - 1) < 0.1, "the work of a cycle is wrong") end
print(("  the loop closes within %.1e of its width"):format(math.abs(excess[61] - excess[13]) / (2 * w(top))))

-- 7. Figures: tractions, zones, the loop.
local at, p, shear, px, pe, qx, qe = {}, {}, {}, {}, {}, {}, {}
local stride <const> = math.max(1, cells // 128)
for k, node in ipairs(result.nodes) do
  if k % stride == 0 and math.abs(node.x) < 1.4 * result.exact.a then
    at[#at + 1], p[#p + 1], shear[#shear + 1] = node.x, mu * node.pressure, -node.shear[1]
  end
end
for i = -200, 200 do
  local x, stick = result.exact.a * i / 200, result.exact.c * i / 200
  px[#px + 1], pe[#pe + 1], qx[#qx + 1], qe[#qe + 1] = x, mu * result.exact.p(x), stick, result.exact.q(stick)
end
dotyk.chart{ file = "images/cattaneo_mindlin.png", x = "x [mm]", y = "traction [MPa]", y_range = { -15, 350 }, series = {
  { name = "μ × pressure", x = at, y = p, style = "points" },
  { name = "shear", x = at, y = shear, style = "points" },
  { name = "theory", x = px, y = pe, reference = true },
  { x = qx, y = qe, reference = true } } }
solve(coarse):render{ file = "images/cattaneo_mindlin_zones.png", field = "xy", units = { length = "mm", stress = "MPa" }, edges = false, window = { -2.2, -1.6, 2.2, 1.6 } }
local function curve(from, to, turn)
  local x, y = {}, {}
  for k = 0, 100 do
    local value = from + (to - from) * k / 100
    x[k + 1], y[k + 1] = on_loop(value, turn), value
  end
  return x, y
end
local series = { { name = "steps", x = excess, y = q, style = "points" } }
for k, leg in ipairs{ { 0, top }, { top, -top, 1 }, { -top, top, -1 } } do
  local x, y = curve(table.unpack(leg))
  series[#series + 1] = { name = k == 1 and "closed form" or nil, x = x, y = y, reference = true }
end
dotyk.chart{ file = "images/hysteresis.png", x = "displacement by slip [µm]", y = "shear force Q / (μP)", series = series }
print "images/cattaneo_mindlin.png, images/cattaneo_mindlin_zones.png, images/hysteresis.png"
