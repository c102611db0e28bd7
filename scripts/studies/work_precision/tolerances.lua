-- How precise is precise enough? Methods for Coulomb's friction on one mesh, tol from 1e-1 to 1e-10.
--
--   ./dotyk scripts/studies/work_precision/tolerances.lua [CELLS]
--
-- Two blocks (C2), CELLS cells along the interface; the distance from the solution of the same mesh in the energy norm. What the
-- chart says: from tol 1e-3 on Newton's method ends exactly; the others pay by the digit, Uzawa's method most. But what the mesh
-- lacks, which is printed, is more than any of them leaves at tol 1e-2: more digits buy nothing. images/work_precision_tolerances.png.

local n <const> = tonumber(arg[1]) or 128
local blocks <const> = include "../../lib/friction.lua".blocks
local solver <const> = dotyk.solver
local many <const> = { max_iterations = 1000000 }

local function scene(cells) return (blocks(cells, dotyk.friction.coulomb(0.3))) end
local exact <const> = solver.newton{ tol = 1e-13 }:solve(scene(n))
dotyk.work_precision{
  scene = function() return scene(n) end,
  levels = 1, reference = exact,
  methods = { solver.newton(many), solver.projected_cg(many), solver.psor(many), solver.uzawa(many) },
  tolerances = { 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10 },
  title = "Coulomb's friction on one mesh: tol 10⁻¹ to 10⁻¹⁰",
  file = "images/work_precision_tolerances.png" }
print(("what the mesh lacks, by the next finer one: %.1e"):format(exact:distance(dotyk.solve(scene(2 * n))).energy))
