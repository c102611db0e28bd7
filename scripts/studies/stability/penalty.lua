-- Stability atlas: the penalty factor between too soft and too stiff.
--
--   ./dotyk scripts/studies/stability/penalty.lua [FINEST]
--
-- Springs, factor times as stiff as a contact node, in place of the contact. Too soft, the bodies overlap: the forces
-- are off by a/factor. Added to the stiffness matrix, springs make its condition grow like factor, and rounding takes
-- b·factor of the forces, b of the size of the machine's ε = 2.2e-16 times the node's stiffness over the least one of
-- the body: a V with its foot at factor = √(a/b). a is fitted on the left branch, b on the right one (geometric
-- means), the foot of the curve is compared with √(a/b), mesh by mesh. On the contact rows, forces as unknowns, there
-- is no right branch.
-- Draws images/stability_penalty.png.

local finest <const> = tonumber(arg[1]) or 64
local common <const>, fit <const> = include "../../lib/common.lua", include "../../lib/least_squares.lua"


-- Error of the contact forces in the mean square.
local function off(s, exact, contact)
  local sum, size, nodes = 0, 0, exact:contact(contact).nodes
  for k, node in ipairs(s:contact(contact).nodes) do
    sum, size = sum + (node.force - nodes[k].force)^2, size + nodes[k].force^2
  end
  return math.sqrt(sum / size)
end

local series, wrong, worst_left, worst_right, worst_foot, least_rows = {}, 0, 0, 0, 0, 0
print "   n        a         b  slope left  slope right  foot in theory   found  error there  converged up to  rows at 1e14"
for n = 16, finest do
  if n & (n - 1) == 0 then
    local scene, contact = common.punch(n)
    local exact = dotyk.solver.pdas{}:solve(scene)
    local classical, rows = common.curve("n = " .. n), common.curve(nil, { twin = true })
    local foot, lowest, left, right = 1, math.huge, { x = {}, y = {} }, { x = {}, y = {} }
    local last, highest
    for quarter = 0, 56 do
      local factor = 10^(quarter / 4)
      local c = dotyk.solver.penalty{ factor = factor, reduced = false }:solve(scene)
      local error = off(c, exact, contact)
      if quarter % 2 == 0 then classical:add(factor, error) end
      if c.converged then
        highest = factor
        if error > 5 * c.penalty.energy / exact.energy + 1e-5 then wrong = wrong + 1 end -- 1e-6 out of equilibrium passes
      end
      if error < lowest then foot, lowest = factor, error end
      if factor >= 1e3 and factor <= 1e5 then left.x[#left.x + 1], left.y[#left.y + 1] = factor, error end
      if factor >= 1e10 and factor <= 1e13 then right.x[#right.x + 1], right.y[#right.y + 1] = factor, error end
      -- What is called converged is the problem with springs: off by what the method itself says of its energy.
      if quarter % 4 == 0 then
        local r = dotyk.solver.penalty{ factor = factor }:solve(scene)
        last = off(r, exact, contact)
        rows:add(factor, last)
        if not r.converged or last > 5 * r.penalty.energy / exact.energy + 1e-12 then wrong = wrong + 1 end
      end
    end
    local function coefficient(branch, power) -- geometric mean of error·factor^power
      local sum = 0
      for k = 1, #branch.x do sum = sum + math.log(branch.y[k] * branch.x[k]^power) end
      return math.exp(sum / #branch.x)
    end
    local a, b = coefficient(left, 1), coefficient(right, -1)
    local slope_left, slope_right = fit.order(left.x, left.y), fit.order(right.x, right.y)
    worst_left, worst_right = math.max(worst_left, math.abs(slope_left + 1)), math.max(worst_right, math.abs(slope_right - 1))
    worst_foot = math.max(worst_foot, math.abs(math.log(foot / math.sqrt(a / b), 10)))
    least_rows = math.max(least_rows, last)
    print(("%4d  %7.2g  %8.1e  %10.3f  %11.3f  %14.1e  %6.0e  %11.0e  %15.0e  %12.0e"):format(n, a, b, slope_left, slope_right, math.sqrt(a / b), foot, lowest, highest, last))
    series[#series + 1], series[#series + 2] = classical, rows
  end
end
dotyk.chart{ file = "images/stability_penalty.png", title = "Penalty; dashed: forces as unknowns",
  x = "stiffness of springs / of contact nodes", y = "relative error of forces",
  log = "xy", slopes = { -1, 1 }, series = series }
print "images/stability_penalty.png"
common.verdict(worst_left < 0.05 and worst_right < 0.25 and worst_foot < 0.5 and least_rows < 1e-13 and wrong == 0, ("soft springs lose 1/factor of the forces "
  .. "(slope within %.2f %%), springs in the stiffness matrix lose factor times rounding (slope within %.0f %%), best at √(a/b) (found within a factor of %.1f); "
  .. "dotyk has the forces as unknowns, %.0e left at 1e14, and calls no classical run converged that rounding keeps from its estimate by 1e-5"):format(100 * worst_left, 100 * worst_right, 10^worst_foot, least_rows))
