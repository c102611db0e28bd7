-- The alternating algorithm with ρ as the report scales it (TR965, 2.1.3, (2.19)–(2.22), and 1.1.5: ρ from 10³ to 10⁴).
--
--   ./dotyk scripts/papers/tr965/report_scaling.lua [FINEST]
--
-- The report's multipliers are a pressure M_j and a part Λ_j of the bound g. In nodal forces its ρ is ρκ_j on a row of pressure, κ_j the
-- length or area of the row, and ρ(∫g)² on a row of friction (unit = "report"). With one ρ for all forces (unit = "force/displacement")
-- the greatest ρ for which all runs converge is near 2/λ_max of the compliance of the rows. What is that limit in the report's units, and
-- does one ρ serve all meshes?
-- 1. Two blocks in the plane, the report's multipliers on n edges, bounds g of 0.5 to 50: the greatest power of 10 with which the
--    algorithm converges, in both units, and Uzawa's bound in each. For small g the rows of pressure decide: κ_j λ_max(W) does not
--    depend on the mesh, and nor does the bound. For great g those of friction do, with (∫g)² = (g h)²: the bound is like n/g². So one ρ
--    serves all meshes in the report's units, as it does not in forces (the bound is like 1/n), but none serves all g; and 10³
--    is beyond the bound of most scenes here.
-- 2. In space the same with cells of area H². With n = 12 and g = 5 stick and slip go round for every ρ, in either unit.
-- The solution does not depend on ρ nor on its unit: forces as Newton's.
-- Prints tables and draws images/papers_report_scaling.png.

local finest <const> = tonumber(arg[1]) or 64
local scenes <const>, common <const> = include "../../lib/friction.lua", include "../../lib/common.lua"
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

local below = math.huge
local function sweep(title, sizes, bounds, build)
  print(("\n%s: greatest power of 10 that converges, Uzawa's bound, fewest iterations\n  n      g        force/displacement                 the report's"):format(title))
  local series = {}
  for _, g in ipairs(bounds) do
    local own <const> = { { name = ("scaled, g = %g"):format(g), x = {}, y = {} }, { name = "unscaled, every g", x = {}, y = {} } }
    for _, n in ipairs(sizes) do
      local line = ("%3d  %5g"):format(n, g)
      for k, unit in ipairs{ "force/displacement", "report" } do
        local greatest <const>, bound <const>, fewest <const> = limits(build(n, dotyk.friction.tresca(g)), unit)
        line = line .. ("    %7.0e  %9.3g  %6.0f"):format(greatest, bound, fewest)
        if greatest > 0 then below = math.min(below, greatest * 10 / bound) end
        table.insert(own[3 - k].x, n)
        table.insert(own[3 - k].y, bound)
      end
      print(line)
    end
    if #series == 0 then series[1] = own[2] end
    series[#series + 1] = own[1]
  end
  return series
end
local sizes = {}
for _, n in ipairs{ 8, 16, 32, 64 } do sizes[#sizes + 1] = n <= finest and n or nil end
local of <const> = sweep("two blocks in the plane", sizes, { 0.5, 5, 50 }, function(n, law) return scenes.blocks(n, law, function(x) return x < 1 and 0.9 or -0.9, -10 end, "P1-P0") end)
sweep("a punch in space", finest >= 64 and { 8, 12 } or { 8 }, { 5, 50 }, function(n, law) return scenes.cube(n, law, "P1-P0") end)
local function ratio(y) return y[#y] / y[1] end
local flat <const>, falls <const>, steep <const> = ratio(of[2].y), 1 / ratio(of[1].y), ratio(of[4].y)
print(dotyk.chart{ file = "images/papers_report_scaling.png", log = "xy", x = "cells along a side", y = "bound 2/λ_max of ρ", series = of })
local finer <const> = sizes[#sizes] / sizes[1]
common.verdict(math.abs(flat - 1) < 0.05 and math.abs(falls / finer - 1) < 0.2 and math.abs(steep / finer - 1) < 0.2 and below > 0.5, (
  "from n = %d to %d the bound of one rho for all forces falls %.1f times; in the report's units it changes by %.0f %% for a small g and grows %.1f times for "
  .. "a great one; all runs below the bound converge but those in which stick and slip go round in space"):format(
  sizes[1], sizes[#sizes], falls, 100 * (flat - 1), steep))
