-- The penalties that the experiment of Alesawi (ODAM 2001, 5–14, section 6) raises, against the list in the paper.
--
--   ./dotyk scripts/papers/alesawi/raised_penalties.lua [NODES]
--
-- Two unit squares side by side, −Δu = P on each, u = 0 on the far sides, glued along x = 1 by the rows Dx = 0; 21 nodes a
-- side. The penalty ρ is multiplied by 10 after each outer step with ‖Dx‖ > η; η = 1 at first, and a tenth after every other
-- step. So the scale of the load decides which first penalties ρ₀ are raised, and the list tells which load the paper used:
-- P itself at each node, on the five-point stencil (4; −1, −1, −1, −1). The load of −Δu = P on this stencil is h²P, as in
-- scripts/papers/alesawi/augmented_lagrangian.lua; the list is then another (for M = 100 and ρ₀ = 100 rounding decides). The paper names
-- M = 0.1, 10 and 1000 in its list and has graphs for M = 1 and 100 too: M = 100 raises one penalty more than any reading of
-- it. Draws the ten graphs with the paper's load, images/papers_raised_penalties.png. Compared with the list at 21 nodes only.

local nodes <const> = tonumber(arg[1]) or 21 -- a side of each square

-- 1. Five-point differences of −Δ times h², and P at each node.
local B <const>, D <const>, unknown <const> = include "../../lib/two_squares.lua"(nodes)
local P <const> = {}
for square = 1, 2 do
  for i = 0, nodes - 1 do
    for j = 0, nodes - 1 do
      local here <const>, y <const> = unknown(square, i, j), j / (nodes - 1)
      if here then P[here] = square == 1 and (y > 0.5 and -1 or 0) or square == 2 and (y < 0.5 and 2 or 0) end
    end
  end
end

-- 2. Which first penalties are raised, as text: the powers of ten among them.
local function program(load, stiffness)
  local c, weights = {}, {}
  for k, value in ipairs(P) do c[k] = load * value end
  for k, value in ipairs(B.value) do weights[k] = (stiffness or 1) * value end
  return dotyk.qp{ B = { i = B.i, j = B.j, value = weights }, c = c, D = D }
end
local function run(q, update, M, power)
  local r = q:solve{ method = update, M = M, rho = 10.0^power, alpha = 0.1, beta = 10, eta = 1, gradient_tol = 1e-5, feasibility_tol = 1e-8 }
  assert(r.converged, r.reason)
  return r
end
local function raised(q, update, M)
  local powers = {}
  for power = 0, 5 do
    if run(q, update, M, power).penalty > 5 * 10.0^power then powers[#powers + 1] = "1e" .. power end
  end
  return powers[1] and table.concat(powers, " ") or "none"
end
local printed <const> = { [0.1] = "1e0 1e1", [10] = "1e0 1e1", [1000] = "1e0 1e1 1e2 1e3" } -- for both updates
local precisions <const> = { 0.1, 1, 10, 100, 1000 }
local function agrees(load) -- the three lines that are printed come out
  local q = program(load)
  for M, list in pairs(printed) do
    if raised(q, "multiplier", M) ~= list or raised(q, "least_squares", M) ~= list then return false end
  end
  return true
end

local paper <const>, consistent <const>, doubled <const> = program(1), program(1 / (nodes - 1)^2), program(1, 2)
print "ρ₀ that are raised      load P at each node, first order / least squares     first order: load h²P   stiffness doubled"
print "     M  printed                                                                                      (no ½, as printed)"
local others = { [consistent] = true, [doubled] = true } -- do they agree with what is printed?
for _, M in ipairs(precisions) do
  local lists = {}
  for q in pairs(others) do
    lists[q] = raised(q, "multiplier", M)
    if printed[M] and lists[q] ~= printed[M] then others[q] = false end
  end
  print(("%6g  %-16s  %-16s  / %-16s               %-16s  %s"):format(M, printed[M] or "not named", raised(paper, "multiplier", M), raised(paper, "least_squares", M),
    lists[consistent], lists[doubled]))
end
local agreed <const> = agrees(1)
if agreed then -- for which loads?
  local function boundary(inside, outside) -- by bisection, to 2 %
    while math.max(inside / outside, outside / inside) > 1.02 do
      local between = math.sqrt(inside * outside)
      if agrees(between) then inside = between else outside = between end
    end
    return inside
  end
  local least, most = boundary(1, 1 / 8), boundary(1, 8)
  print(("The printed lines come out for loads from %.2f P to %.2f P; there M = 100 raises ρ₀ = %s and %s."):format(least, most,
    raised(program(least), "multiplier", 100), raised(program(most), "multiplier", 100)))
end

-- 3. The ten graphs, a cell for each run.
local panels, penalties, same, large, most_outer = {}, {}, 0, 0, 0
for k, label in ipairs{ "CG iterations", "outer iterations" } do
  for i, update in ipairs{ "First-order update", "Least-squares update" } do
    panels[2 * k - 2 + i] = { title = update, x = "first penalty ρ₀", y = "precision M", log = "xy", map = { x = penalties, y = precisions, values = {}, label = label } }
  end
end
for k, M in ipairs(precisions) do
  for _, panel in ipairs(panels) do panel.map.values[k] = {} end
  for power = 0, 10 do
    local r = { run(paper, "multiplier", M, power), run(paper, "least_squares", M, power) }
    for i = 1, 2 do
      penalties[power + 1] = 10.0^power
      panels[i].map.values[k][power + 1], panels[2 + i].map.values[k][power + 1] = r[i].cg, r[i].iterations
      if power >= 6 then most_outer = math.max(most_outer, r[i].iterations) end
    end
    if r[1].cg == r[2].cg and r[1].iterations == r[2].iterations then same, large = same + 1, large + (power >= 6 and 1 or 0) end
  end
end
dotyk.chart{ file = "images/papers_raised_penalties.png", panels = panels, columns = 2, size = { 2100, 1200 } }
print "images/papers_raised_penalties.png"
print(("The updates take the same number of outer and CG steps in %d of 55 runs, in %d of 25 with ρ₀ ≥ 1e6, which take at most %d outer steps."):format(same, large, most_outer))
assert(large == 25 and most_outer <= 2, "large penalties tell the updates apart")
if nodes == 21 then
  assert(agreed and not others[consistent], "the verdict has changed")
  print(("verdict: the printed list of raised penalties comes out for both updates with P at each node of 21 × 21, does not with h²P, %s with P and no ½ in the functional"):format(
    others[doubled] and "does" or "does not"))
else
  print(("verdict: alike for large penalties; the printed list is for 21 nodes and not compared with %d"):format(nodes))
end
