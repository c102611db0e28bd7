-- Stability atlas: Coulomb friction, from the loop that ceases to contract to several solutions.
--
--   ./dotyk scripts/studies/stability/coulomb.lua [FINEST]
--
-- 1. The loop over given friction, g := μ·pressure, on a foot dragged along a plane: while all its nodes slip, a step
--    is linear and contracts by μ times a constant, so it ends to converge at the μ where that is 1, on a half-plane
--    2(1 − ν)/(1 − 2ν), which the block comes near as its cells get small. The constant is measured at 0.9 of that, where the loop still ends; the place where the loop
--    ceases to converge is found by bisection. Newton's method has the coupling in its derivative: iterations at
--    every μ.
-- 2. A strut with one contact node. Its slip to one side lets the node follow the pressure, which a coefficient
--    beyond μ* = W_nn/|W_nt| over-compensates (W the compliance of the node, measured from two states): from there on
--    the open state and a slipping one solve the same problem, below there is one solution. μ* is found by bisection
--    on all solutions.
-- Draws images/stability_coulomb.png (1) and images/stability_coulomb_several.png (2).

local finest <const> = tonumber(arg[1]) or 128
local common <const>, scenes <const> = include "../../lib/common.lua", include "../../lib/friction.lua"

-- 1. The loop.
local wrong, worst, newton_most, newton_lost = 0, 0, 0, 0
local apart_at = {} -- from the half-plane, by n
local panels <const> = {}
print "   ν    n  contraction / μ  limit by it   found   off [%]   half-plane   Newton's iterations at most"
for _, nu in ipairs{ 0, 0.3 } do
  local theory = 2 * (1 - nu) / (1 - 2 * nu)
  local map <const> = common.map{ "converges", "does not converge" }
  local law, half_plane = common.curve("limit by contraction", { style = "points" }), common.curve("half-plane", { reference = true })
  for n = 16, finest do
    if n & (n - 1) == 0 then
      local newton_here = 0
      local function loop(mu)
        local scene, contact = scenes.foot(n, dotyk.friction.coulomb(mu), nu)
        local s = dotyk.solver.coulomb_loop{ max_iterations = 1500 }:solve(scene)
        local t = dotyk.solver.newton{}:solve(scene)
        if t.converged then newton_here = math.max(newton_here, t.iterations) else newton_lost = newton_lost + 1 end
        if s.converged and (not t.converged or common.apart(s, t, contact) > 1e-6) then wrong = wrong + 1 end
        if t.converged and common.residual(t) > 1e-8 then wrong = wrong + 1 end
        map:add(s.converged and "converges" or "does not converge", mu, n)
        return s
      end
      local constant = tonumber(loop(0.9 * theory).reason:match "multiplied by ([%d%.e+-]+) a step") / (0.9 * theory)
      for _, part in ipairs{ 0.25, 0.5, 0.75, 1.25, 1.5 } do loop(part * theory) end
      local at = common.boundary(0.5 * theory, 2 * theory, function(mu) return loop(mu).converged end, 0.01)
      law:add(1 / constant, n)
      half_plane:add(theory, n)
      worst, apart_at[n] = math.max(worst, math.abs(at * constant - 1)), math.max(apart_at[n] or 0, math.abs(at / theory - 1))
      newton_most = math.max(newton_most, newton_here)
      print(("%4g  %3d  %15.4f  %11.3f  %6.3f  %8.2f  %11.3f   %d"):format(nu, n, constant, 1 / constant, at, 100 * (at * constant - 1), theory, newton_here))
    end
  end
  local series = map:series()
  table.move({ law, half_plane }, 1, 2, #series + 1, series)
  panels[#panels + 1] = { title = ("ν = %g, half-plane: μ = %.4g"):format(nu, theory), y = "contact cells", log = "y", series = series }
end
dotyk.chart{ file = "images/stability_coulomb.png", x = "coefficient of friction μ", panels = panels, size = { 1000, 900 } }

-- 2. The strut, inclined by an angle to the floor; of its foot only the first node is near the floor.
local function strut(angle, friction, gap)
  local mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 6}, cells = {2, 12} }
  mesh:transform(function(x, y) return x + y / math.tan(math.rad(angle)), y end)
  local body = dotyk.body{ name = "strut", material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = mesh }
  body:part"top":fix()
  body:part"left":load{ -0.3, 0 }
  local scene = dotyk.scene{ body }
  local contact = scene:contact{ body:part"bottom", friction = friction,
    rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = function(x) return x < 0.01 and gap or 1e3 end } }
  return scene, contact, body
end
local function compliance(angle) -- W_nn, W_nt and the free node's displacement towards the floor
  local free_scene, _, free_body = strut(angle, nil, 1e3)
  local tx, ty = dotyk.solve(free_scene):displacement(free_body, 0, 0)
  local pressed, contact, body = strut(angle, nil, -ty - 0.1)
  local s = dotyk.solve(pressed)
  local force = s:contact(contact).nodes[1].force
  local x, y = s:displacement(body, 0, 0)
  return (y - ty) / force, (x - tx) / force, -ty
end
local several <const> = common.map{ "one solution", "several solutions" }
local found, limit = common.curve("boundary found", { style = "points" }), common.curve("theory, W_nn/|W_nt|", { reference = true })
local worst_several = 0
print "\nstrut at   μ* = W_nn/|W_nt|      found       off   Newton's method beyond it"
for angle = 40, 75, 5 do
  local nn, nt, towards = compliance(angle)
  local gap = towards + 1e-3 * math.abs(towards) -- open by a thousandth, if free
  local function count(mu)
    local scene = strut(angle, dotyk.friction.coulomb(mu), gap)
    return #dotyk.all_solutions(scene)
  end
  local star = nn / math.abs(nt)
  for tenth = 2, 20, 2 do
    local n = count(star * tenth / 10)
    several:add(n == 1 and "one solution" or "several solutions", angle, star * tenth / 10)
  end
  local at = common.boundary(0.5 * star, 2 * star, function(mu) return count(mu) == 1 end, 1e-4)
  found:add(angle, at)
  limit:add(angle, star)
  worst_several = math.max(worst_several, math.abs(at / star - 1))
  local scene = strut(angle, dotyk.friction.coulomb(1.5 * star), gap)
  local states, order = {}, {}
  for seed = 1, 10 do
    local s = dotyk.solver.newton{ seed = seed }:solve(scene)
    local name = s.converged and ("%.6g"):format(s.energy) or "none"
    if s.converged and common.residual(s) > 1e-8 then wrong = wrong + 1 end
    if not states[name] then order[#order + 1] = name end
    states[name] = (states[name] or 0) + 1
  end
  local text = {}
  for k, name in ipairs(order) do text[k] = states[name] .. " x energy " .. name end
  print(("%7d°   %16.6f   %8.6f   %7.0e   %s"):format(angle, star, at, at / star - 1, table.concat(text, ", ")))
end
local series = several:series()
series[#series + 1], series[#series + 2] = found, limit
dotyk.chart{ file = "images/stability_coulomb_several.png", x = "angle between strut and floor [degrees]", y = "coefficient of friction μ", series = series }
print "images/stability_coulomb.png, images/stability_coulomb_several.png"
local most_cells = 16
for n in pairs(apart_at) do most_cells = math.max(most_cells, n) end
common.verdict(worst < 0.05 and (most_cells < 128 or apart_at[most_cells] < 0.05) and worst_several < 0.05 and wrong == 0 and newton_lost == 0, ("the loop over given friction ends to converge where μ times its constant is 1 (found within %.1f %%; on %d cells %.0f %% from the half-plane's 2(1 − ν)/(1 − 2ν)), "
  .. "Newton's method converges beyond it in %d iterations at most; several solutions exist from μ = W_nn/|W_nt| on (found within %.0e), and each run ends at one of them"):format(
  100 * worst, most_cells, 100 * apart_at[most_cells], newton_most, worst_several))
