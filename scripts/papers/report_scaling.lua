-- The alternating algorithm with ρ as the report scales it (TR965, 2.1.3, (2.19)–(2.22), and 1.1.5: ρ from 10³ to 10⁴).
--
--   ./dotyk scripts/papers/report_scaling.lua [FINEST]
--
-- The report's multipliers are a pressure M_j and a part Λ_j of the bound g. In nodal forces its ρ is ρκ_j on a row of pressure, κ_j the
-- length or area of the row, and ρ(∫g)² on a row of friction (unit = "report"). With one ρ for all forces (unit = "force/displacement")
-- the greatest ρ for which all runs converge is near 2/λ_max of the compliance of the rows. What is that limit in the report's units, and
-- does one ρ serve all meshes?
-- 1. Two blocks in the plane, the report's multipliers on n edges, bounds g of 0.5 to 50: the greatest ρ of a row of decades with which the
--    algorithm converges, in both units, and Uzawa's bound in each. In the plane friction rows have (∫g)² = (g/n)²: the bound of
--    ρ grows with n and with 1/g², so that a fixed ρ that is small enough on a coarse mesh is small enough on all finer
--    ones, but takes ever more iterations where a force turns, and none serves all g.
-- 2. In space the same with cells of area H².
-- The solution does not depend on ρ nor on its unit: forces as Newton's.
-- Prints tables and draws images/papers_report_scaling.png.

local finest <const> = tonumber(arg[1]) or 64
local folder <const> = arg[0]:match "^(.*)/[^/]*$" or "."
local scenes <const>, common <const> = dofile(folder .. "/../scenes/friction.lua"), dofile(folder .. "/../stability/common.lua")
local most <const> = 2000

local function run(scene, rho, unit)
  local s <const> = dotyk.solver.uzawa_pdas{ rho = rho, unit = unit, max_iterations = most }:solve(scene)
  return s, tonumber(s.reason:match "bound 2/λ_max of ([%d%.e+-]+)")
end

local decades <const> = {}
for k = -2, 8 do decades[#decades + 1] = 10.0^k end
local function limits(scene, unit)
  local newton <const> = dotyk.solver.newton{}:solve(scene)
  local greatest, bound, fewest = 0, nil, math.huge
  for _, rho in ipairs(decades) do
    local s <const>, of = run(scene, rho, unit)
    bound = bound or of
    if s.converged then
      assert(s:distance(newton).displacement < 1e-6, s.reason)
      greatest, fewest = rho, math.min(fewest, s.iterations)
    elseif rho > bound then break
    end
  end
  return greatest, bound, fewest
end

local panels <const>, below = {}, math.huge
local function sweep(title, sizes, bounds, build)
  print(("\n%s: greatest power of 10 that converges, Uzawa's bound, fewest iterations\n  n      g        force/displacement                 the report's"):format(title))
  local series = {}
  for _, g in ipairs(bounds) do
    local own <const> = { { name = ("g = %g, the report's"):format(g), x = {}, y = {} }, { name = ("g = %g, one for all forces"):format(g), x = {}, y = {}, style = "points" } }
    for _, n in ipairs(sizes) do
      local line = ("%3d  %5g"):format(n, g)
      for k, unit in ipairs{ "force/displacement", "report" } do
        local greatest <const>, bound <const>, fewest <const> = limits(build(n, dotyk.friction.tresca(g)), unit)
        line = line .. ("    %7.0e  %9.3g  %6.0f"):format(greatest, bound, fewest)
        below = math.min(below, greatest > 0 and greatest * 10 / bound or 0)
        table.insert(own[3 - k].x, n)
        table.insert(own[3 - k].y, bound)
      end
      print(line)
    end
    series[#series + 1], series[#series + 2] = own[1], own[2]
  end
  panels[#panels + 1] = { title = title, log = "xy", x = "cells along a side", y = "bound 2/λ_max of rho", series = series }
end
local sizes = {}
for _, n in ipairs{ 8, 16, 32, 64 } do sizes[#sizes + 1] = n <= finest and n or nil end
sweep("two blocks in the plane", sizes, { 0.5, 5, 50 }, function(n, law) return scenes.blocks(n, law, nil, "P1-P0") end)
sweep("a punch in space", finest >= 64 and { 4, 6, 8 } or { 4 }, { 5, 50 }, function(n, law) return scenes.cube(n, law, "P1-P0") end)
print(dotyk.chart{ file = "images/papers_report_scaling.png", columns = 2, panels = panels })
