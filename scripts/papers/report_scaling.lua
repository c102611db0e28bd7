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
