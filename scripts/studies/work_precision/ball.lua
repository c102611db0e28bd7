-- Work and precision in space: a rigid ball pressed into a block (Hertz's point contact, a quarter of it).
--
--   ./dotyk scripts/studies/work_precision/ball.lua [LEVELS]
--
-- The error in the energy norm against 24³ cells, which refine all the others. What the chart says: in space the factorisation is
-- nearly all of the time, so methods that need one of it lie on one curve, and the iteration is free.
-- images/work_precision_ball.png.

local levels <const> = tonumber(arg[1]) or 4
local ball <const> = include "../../lib/hertz.lua".ball
local solver <const> = dotyk.solver
local sizes <const> = { 4, 6, 8, 12, 24 } -- LEVELS + 1 of them

dotyk.work_precision{
  scene = function(level) return ball.scene(sizes[level]) end,
  levels = levels,
  methods = { { name = "pdas, condensed", method = solver.pdas{} }, { name = "pdas, whole system", method = solver.pdas{ reduced = false } },
    solver.interior_point{}, solver.projected_cg{}, { name = "penalty 100", method = solver.penalty{ factor = 100 } } },
  slopes = { -0.25 },
  title = "A ball pressed into a block",
  file = "images/work_precision_ball.png" }
