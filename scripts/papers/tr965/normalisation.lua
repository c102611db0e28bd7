-- Two screws and one linear condition p(v) = 0: TR965, lemma 1.12, (1.77)–(1.78).
--
--   ./dotyk scripts/papers/tr965/normalisation.lua [FINEST]
--
-- The upper of two blocks may move and turn in the x1 x3 plane: its front slides. Contact does not notice one of its motions r, and
-- the report adds p(v) = 0, p(r) ≠ 0, an integral along a segment γ0 of the contact.
-- (a) Planar contact, r = (1, 0, 0), p(v) = ∫_γ0 v_1 ds for n = (0, 0, −1) up to sign. The program returns the solution of least norm, so that
--     p(u) ≠ 0. S(r) = 0 and no contact force works on r: the condition bears nothing, and u − p(u)/p(r) r, by solution:moved, is the
--     report's solution. Check: two opposite contacts hold u_1 of a single node on γ0 instead (another condition that bears nothing);
--     energy and contact forces must be the same, and after the shift by p the displacement too, for each γ0.
-- (b) A cylinder's facets, r the turn about its axis, p(v) = ∫_γ0 (x_3 v_1 − x_1 v_3) ds about the axis, γ0 all of the front edge of the
--     contact. On the cylinder r is free; on facets contact notices it, so that (1.74) for them has a solution without p, and
--     p(v) = 0 is a support. It is imposed by its multiplier: the load μ p, with μ such that p(u) = 0 (Newton's method with differences;
--     p(u) is monotone and piecewise linear in μ). The load per area with the weight (4 − 6 x2/h)/h on the first row of cells is p exactly.
--     The support bears the moment M = μ p(r). Two loads, with and without a moment about the axis: if the cylinder is to be
--     approximated, M must tend to zero with h for the second, and to minus the load's moment for the first.
-- Prints tables and draws images/papers_normalisation.png.

local finest <const> = math.max(6, tonumber(arg[1]) or 8)
local common <const> = include "../../lib/common.lua"
local pdas <const> = dotyk.solver.pdas{}
local C <const>, Z <const> = 0.4, 2 -- the axis x1 = C, x3 = Z

local function two_bodies(n, bend, fx)
  local function body(name, bottom, E)
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3 },
      mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { n, n, n }, element = "Q1" }:transform(function(x, y, z)
        return x, y, z + bottom + bend(x) * (bottom < 0 and z or 1 - z) -- flat top and bottom
      end) }
  end
  local lower <const>, upper <const> = body("lower", -1, 200), body("upper", 0, 700)
  lower:part"bottom":fix()
  upper:part"front":slide()
  upper:part"top":load(function(x, y) return fx, 0, (5 * y - 4) * (1 + 0.8 * (x - 0.5)) end) -- it lifts the back
  local scene <const> = dotyk.scene{ lower, upper }
  return scene, scene:contact{ upper:part"bottom", lower:part"top" }, upper
end

local function forces_apart(a, b) -- over the greatest of b's
  local most, size = 0, 0
  for k, node in ipairs(a) do most, size = math.max(most, math.abs(node.force - b[k].force)), math.max(size, b[k].force) end
  return most / size
end

-- ∫ of w1(x, z) v_1 + w3(x, z) v_3 along the front edge of the contact, cells first to last, by Simpson's rule on each (exact).
local function functional(n, bend, first, last, w1, w3, v)
  local sum = 0
  for k = first, last do
    local a <const>, b <const> = (k - 1) / n, k / n
    local za <const>, zb <const> = bend(a), bend(b)
    local length <const> = math.sqrt((b - a)^2 + (zb - za)^2)
    for i, weight in ipairs{ 1 / 6, 4 / 6, 1 / 6 } do
      local x <const>, z <const> = a + (i - 1) / 2 * (b - a), za + (i - 1) / 2 * (zb - za)
      local v1 <const>, _, v3 <const> = v(x, z)
      sum = sum + length * weight * (w1(x, z) * v1 + w3(x, z) * v3)
    end
  end
  return sum
end

-- 1. (a) Planar contact.
local function flat() return 0 end
local function one() return 1 end
print "(a) planar contact: p(u)/p(r) of the solution of least norm, and differences to the scene that holds one node of γ0"
print "  n   γ0             p(u)/p(r)   held at   p(u)/p(r)  energy   forces   displacement after the shift"
local same, shifted = 0, {}
for n = 4, math.min(finest, 12), 4 do
  local scene <const>, contact <const>, upper <const> = two_bodies(n, flat, 0)
  assert(scene:balance().verdict == "up to motion")
  local s <const> = pdas:solve(scene)
  for _, segment in ipairs{ { 1, n }, { 1, n // 2 }, { n // 2 + 1, n }, { n, n } } do
    local node <const> = segment[1] == n and 1 or (segment[1] - 1) / n
    local held <const>, touch <const>, body <const> = two_bodies(n, flat, 0)
    local spot <const> = body:part("spot", function(x, y, z) return z < 1e-9 and y < 1 / n and math.abs(x - node) < 1 / n end)
    local function only(x, y) return math.abs(x - node) + y < 1e-9 and 0 or 1000 end -- far from all nodes but one
    for _, sign in ipairs{ 1, -1 } do held:contact{ spot, rigid = dotyk.rigid.gap{ normal = { sign, 0, 0 }, gap = only } } end
    local t <const> = pdas:solve(held)
    assert(s.converged and t.converged and math.abs((t:displacement(body, node, 0, 0))) < 1e-12, t.reason)
    local function p(solution, of)
      local function along(v) return functional(n, flat, segment[1], segment[2], one, flat, v) end
      return along(function(x) return solution:displacement(of, x, 0, 0) end) / along(function() return 1, 0, 0 end)
    end
    local ps <const>, pt <const>, size = p(s, upper), p(t, body), 0
    local chosen <const> = s:moved{ body = upper, translation = { -ps, 0, 0 } } -- the report's solution: p(u) = 0
    assert(math.abs(p(chosen, upper)) < 1e-14 and chosen.residual.law < 1e-9)
    local energy <const>, forces <const>, apart = math.abs(t.energy / s.energy - 1), forces_apart(t:contact(touch).nodes, s:contact(contact).nodes), 0
    for k, node_t in ipairs(t:contact(touch).nodes) do assert(node_t.status == s:contact(contact).nodes[k].status) end
    for _, x in ipairs{ 0, 0.25, 0.5, 1 } do
      for _, z in ipairs{ 0, 0.5, 1 } do
        local u <const>, v <const> = { chosen:displacement(upper, x, z, z) }, { t:displacement(body, x, z, z) }
        v[1] = v[1] - pt
        for i = 1, 3 do apart, size = math.max(apart, math.abs(u[i] - v[i])), math.max(size, math.abs(u[i])) end
      end
    end
    assert(math.abs(ps) > 1e-5, "the least solution has p(u) = 0 by chance")
    if n == 4 then
      local curve <const> = common.curve(("γ₀ = [%g, %g]"):format((segment[1] - 1) / n, segment[2] / n))
      for k = 0, n do curve:add(k / n, 1e5 * (s:displacement(upper, k / n, 0, 0) - ps)) end
      shifted[#shifted + 1] = curve
    end
    same = math.max(same, energy, forces, apart / size)
    print(("%3d   [%.2f, %.2f]   %10.3e   x = %.2f  %10.3e   %.0e   %.0e   %.0e"):format(n, (segment[1] - 1) / n, segment[2] / n, ps, node, pt, energy, forces, apart / size))
  end
end

-- 2. (b) A cylinder's facets.
local function round(x) return Z - math.sqrt(Z * Z - (x - C)^2) end
local function w1(_, z) return z - Z end
local function w3(x) return C - x end
local balanced <const> = 1.5 * (0.5 - C + 0.8 / 12) / (Z - 1) -- fx whose load has no moment about the axis
local function run(n, moment)
  local h <const> = 1 / n
  local function integral(v) return functional(n, round, 1, n, w1, w3, v) end
  local pr <const> = integral(function(x, z) return w1(x, z), 0, w3(x) end) -- r = (x3 − Z, 0, C − x1)
  local function solve(mu, kernel)
    local scene <const>, contact <const>, upper <const> = two_bodies(n, round, balanced - moment / (Z - 1)) -- S(r) = moment
    upper:part("strip", function(_, y, z, _, _, nz) return y < h and nz < -0.5 and z < 0.5 end):load(function(x, y, z)
      local c <const> = mu * (4 - 6 * y / h) / h
      return c * w1(x, z), 0, c * w3(x)
    end)
    if not scene:balance().solvable then return nil end
    local s <const> = (kernel and dotyk.solver.pdas{ kernel = kernel } or pdas):solve(scene)
    assert(s.converged, s.reason)
    return s, integral(function(x, z) return s:displacement(upper, x, 0, z) end), contact
  end
  local free <const>, turn <const>, contact <const> = solve(0)
  local mu = -moment / pr -- the cylinder's
  local s, p, touch = solve(mu)
  local mu_last, p_last = mu + 1e-3, nil
  _, p_last = solve(mu_last)
  for _ = 1, 20 do
    if math.abs(p) < 1e-11 * pr then break end
    mu, mu_last, p_last = mu - p * (mu - mu_last) / (p - p_last), mu, p
    s, p, touch = solve(mu)
  end
  assert(math.abs(p) < 1e-11 * pr, "p(u) = 0 is not reached")
  return { h = h, free = free, turn = turn and turn / pr, apart = free and forces_apart(s:contact(touch).nodes, free:contact(contact).nodes), M = mu * pr,
           screws = free and solve(0, "screws").screws, energy = free and s.energy / free.energy - 1 }
end
local function carried(n) -- the greatest moment that facets carry, by rigid statics
  return common.boundary(1e-3, 1, function(m) return two_bodies(n, round, balanced - m / (Z - 1)):balance().solvable end, 1e-3)
end
local fit <const> = include "../../lib/least_squares.lua"
print "\n(b) a cylinder's facets: S(r) is the load's moment about the axis, M that of the support p(v) = 0; p(u)/p(r) and screws without p"
print " S(r)   n   greatest S(r)        M     M + S(r)   without p: det   p(u)/p(r)   to it with p: energy   forces"
local limit_curve <const> = common.curve "greatest S(r)"
local turned <const>, forces_curve <const>, energy_curve <const> = common.curve("turn p(u)/p(r)", { axis = "right" }), common.curve "contact forces", common.curve "energy"
local errors <const>, orders <const>, refused, limits = {}, {}, 0, {}
for i, moment in ipairs{ 0, 0.1 } do
  errors[i] = common.curve(("M + S(r), S(r) = %g"):format(moment))
  for _, n in ipairs{ 4, 6, 8, 12, 16 } do
    if n <= finest then
      local r <const> = run(n, moment)
      limits[n] = limits[n] or carried(n)
      assert((r.free ~= nil) == (moment < limits[n]), "balance() and the limit disagree")
      errors[i]:add(r.h, math.abs(r.M + moment))
      local text <const> = ("%5g  %2d  %14.4f  %8.4f  %10.3e"):format(moment, n, limits[n], r.M, r.M + moment)
      if r.free then
        print(text .. ("   %14.4f  %10.4f  %20.0e  %7.2f"):format(r.screws[#r.screws].determinant, r.turn, math.abs(r.energy), r.apart))
      else
        refused = refused + 1
        print(text .. "   refused: the facets do not carry it")
      end
      if moment == 0 then
        limit_curve:add(r.h, limits[n])
        turned:add(r.h, math.abs(r.turn)); forces_curve:add(r.h, r.apart); energy_curve:add(r.h, math.abs(r.energy))
      end
    end
  end
  orders[i] = fit.order(errors[i].x, errors[i].y)
end
local limit_order <const>, energy_order <const> = fit.order(limit_curve.x, limit_curve.y), fit.order(energy_curve.x, energy_curve.y)
print(("orders in h: M + S(r) %.2f and %.2f, greatest moment %.2f, energy %.2f"):format(orders[1], orders[2], limit_order, energy_order))

dotyk.chart{ file = "images/papers_normalisation.png", columns = 3, size = { 2100, 800 }, panels = {
  { title = "(a) Fixed by p on γ₀", x = "x₁", y = "u₁ · 10⁵ on the front edge", x_range = { -0.05, 1.05 }, series = shifted },
  { title = "(b) Moments", x = "mesh size h", y = "moment", log = "xy", series = { errors[1], errors[2], limit_curve } },
  { title = "(c) Without p", x = "mesh size h", y = "relative difference", y_right = "turn", log = "xy", series = { forces_curve, energy_curve, turned } } } }
print "images/papers_normalisation.png"
common.verdict(same < 1e-11 and math.min(orders[1], orders[2]) > 1.8 and limit_order > 0.5 and energy_order > 1.8 and refused > 0, (
  "in (a) p chooses one of the solutions, the program's up to a translation (differences %.0e); in (b) it is a support: it bears the load's moment, as the facets do not on finer "
  .. "meshes, and of a load without moment one that falls like h^%.1f"):format(same, orders[1]))
