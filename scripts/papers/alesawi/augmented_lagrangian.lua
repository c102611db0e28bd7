-- Augmented Lagrangians with adaptive precision: the experiment of Alesawi (ODAM 2001, 5–14).
--
--   ./dotyk scripts/papers/alesawi/augmented_lagrangian.lua [NODES]
--
-- Two unit squares side by side, −Δu = P on each, held on the far sides and glued along x = 1 by the rows
-- Dx = 0. The glue is solved for by the method of multipliers and with the least-squares update, for inner
-- precisions M and first penalties ρ₀ over many decades. Draws the ten graphs of the paper as two figures,
-- images/augmented_lagrangian_cg.png and images/augmented_lagrangian_outer.png, and prints the table
-- behind them and what it says of large penalties.

local nodes <const> = tonumber(arg[1]) or 21 -- a side of each square
local h <const> = 1 / (nodes - 1)

-- 1. Five-point differences as an energy, and P in the middle of each cell as loads of its corners.
local B <const>, D <const>, unknown <const> = include "../../lib/two_squares.lua"(nodes)
local function load_density(x, y)
  if x < 1 then return y > 0.5 and -1 or 0 end
  return y < 0.5 and 2 or 0
end
local c <const> = {}
for k = 1, 2 * (nodes - 1) * nodes do c[k] = 0 end
for square = 1, 2 do
  for i = 0, nodes - 2 do
    for j = 0, nodes - 2 do
      local P <const> = load_density(square - 1 + (i + 0.5) * h, (j + 0.5) * h)
      for _, corner in ipairs{ {i, j}, {i + 1, j}, {i, j + 1}, {i + 1, j + 1} } do
        local k <const> = unknown(square, table.unpack(corner))
        if k then c[k] = c[k] + P * h^2 / 4 end
      end
    end
  end
end
local glued <const> = dotyk.qp{ B = B, c = c, D = D }
print(glued)

-- 2. All M and ρ₀, both updates, against the exact solution.
local exact <const> = glued:solve{ method = "active_set" }
local function relative_error(x)
  local error, size = 0, 0
  for k = 1, #x do
    error, size = math.max(error, math.abs(x[k] - exact.x[k])), math.max(size, math.abs(exact.x[k]))
  end
  return error / size
end

local updates <const> = { "multiplier", "least_squares" }
local precisions <const> = { 0.1, 1, 10, 100, 1000 }
local results = { multiplier = {}, least_squares = {} } -- [update][M][power of ρ₀ + 1]
print "                 first order                          least squares"
print "     M     rho0  outer   CG  last rho  error of x      outer   CG  last rho  error of x"
for _, M in ipairs(precisions) do
  for power = 0, 10 do
    local line = ("%6g  %7.0e"):format(M, 10.0^power)
    for _, update in ipairs(updates) do
      local r = glued:solve{ method = update, M = M, rho = 10.0^power, alpha = 0.1, beta = 10, eta = 1,
                             gradient_tol = 1e-5, feasibility_tol = 1e-8 }
      assert(r.converged, r.reason)
      results[update][M] = results[update][M] or {}
      results[update][M][power + 1] = { rho = 10.0^power, outer = r.iterations, cg = r.cg, last = r.penalty, error = relative_error(r.x) }
      line = line .. ("  %5d %4d  %8.0e    %8.1e  "):format(r.iterations, r.cg, r.penalty, relative_error(r.x))
    end
    print(line)
  end
end

-- 3. Large penalties in words.
local function over(update, powers, key)
  local least, most = math.huge, -math.huge
  for _, M in ipairs(precisions) do
    for power = powers[1], powers[2] do
      local value = results[update][M][power + 1][key]
      least, most = math.min(least, value), math.max(most, value)
    end
  end
  return least, most
end
local differ = 0
for _, M in ipairs(precisions) do
  for power = 6, 10 do
    local a, b = results.multiplier[M][power + 1], results.least_squares[M][power + 1]
    if a.outer ~= b.outer or a.cg ~= b.cg then differ = differ + 1 end
  end
end
local raised = {}
for _, M in ipairs(precisions) do
  for power = 0, 10 do
    if results.multiplier[M][power + 1].last > 10.0^power then raised[#raised + 1] = ("(%g, 1e%d)"):format(M, power) end
  end
end
local o1, o2 = over("multiplier", {6, 10}, "outer")
local c1, c2 = over("multiplier", {6, 10}, "cg")
local p1, p2 = over("multiplier", {0, 2}, "outer")
local q1, q2 = over("multiplier", {0, 2}, "cg")
print(("For rho0 >= 1e6 every run takes %d or %d outer and %d to %d CG iterations, whatever M; the updates differ in %d of %d runs."):format(
  o1, o2, c1, c2, differ, 5 * #precisions))
print(("For rho0 <= 1e2 it is %d to %d outer and %d to %d CG iterations."):format(p1, p2, q1, q2))
print(("The paper: few outer iterations for large penalties whatever the update. %s (at most %d)."):format(
  math.max(o2, (select(2, over("least_squares", {6, 10}, "outer")))) <= 3 and "So it is" or "Not so", o2))
print(("No growth of CG, for D adds only as many large eigenvalues as it has rows. %s (%d against %d)."):format(
  c2 <= q2 and "So it is" or "Not so", c2, q2))
print(("Where there is one outer iteration no multiplier is used at all: that is the penalty method, here right to %.0e."):format(select(2, over("multiplier", {8, 10}, "error"))))
print("The penalty was raised (first order) for (M, rho0) = " .. table.concat(raised, " ") .. ".")

-- 4. The ten graphs as two figures, a cell for each run.
local function draw(file, key, label)
  local panels <const>, penalties <const> = {}, {}
  for power = 0, 10 do penalties[power + 1] = 10.0^power end
  for k, update in ipairs(updates) do
    local values <const> = {}
    for j, M in ipairs(precisions) do
      values[j] = {}
      for i = 1, #penalties do values[j][i] = results[update][M][i][key] end
    end
    panels[k] = { title = update == "multiplier" and "First-order update" or "Least-squares update", y = "precision M", log = "xy",
                  map = { x = penalties, y = precisions, values = values, label = label } }
  end
  dotyk.chart{ file = file, x = "first penalty ρ₀", panels = panels, size = { 1000, 1000 } }
end
draw("images/augmented_lagrangian_cg.png", "cg", "CG iterations")
draw("images/augmented_lagrangian_outer.png", "outer", "outer iterations")
print "images/augmented_lagrangian_cg.png, images/augmented_lagrangian_outer.png"
