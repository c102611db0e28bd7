-- Work and precision on five blocks that nothing but contact holds.
--
--   ./dotyk scripts/studies/work_precision/semicoercive.lua [LEVELS]
--
-- The stiffness is singular. The error in the energy norm against one level more. What the chart says: singular or not, the
-- methods that change many rows in a step cost little more than a factorisation; changing one row in a step costs as many KKT
-- systems as there are rows; a penalty of ten times the rows' stiffness is soft, and still nearer than the mesh.
-- images/work_precision_semicoercive.png.

local levels <const> = tonumber(arg[1]) or 4
local blocks <const> = include "../../lib/semicoercive.lua"[2]
local solver <const> = dotyk.solver

dotyk.work_precision{
  scene = function(level) return blocks.make(4 << level) end,
  levels = levels,
  methods = { solver.pdas{}, { name = "one row a step", method = solver.active_set{ change = "one" } },
    { name = "many rows a step", method = solver.active_set{ change = "many" } }, solver.interior_point{},
    { name = "penalty 10", method = solver.penalty{ factor = 10 } }, { name = "feti", method = solver.feti{} } },
  slopes = { -0.5 }, budget = 5,
  title = "Five blocks apart",
  file = "images/work_precision_semicoercive.png" }
