-- Work and precision on a beam: five one-sided supports, bending stiffness that varies.
--
--   ./dotyk scripts/studies/work_precision/beam.lua [LEVELS]
--
-- The error by energies, against one level more; cubic elements, so it falls as h². What the chart says: a beam has a handful of
-- rows, so every method costs the assembly and the factorisation; the first-order ones pay for their steps only where the
-- factorisation is cheap. images/work_precision_beam.png.

local levels <const> = tonumber(arg[1]) or 6
local beam <const> = include "../../lib/beam.lua"
local solver <const> = dotyk.solver

dotyk.work_precision{
  scene = function(level) return beam(dotyk.law.signorini(), 2 << level, function(x) return 1 + 0.5 * math.sin(2 * x) end) end,
  levels = levels,
  methods = { solver.pdas{}, solver.newton{}, solver.interior_point{}, solver.psor{}, solver.uzawa{ max_iterations = 100000 } },
  repeats = 7, slopes = { -2 },
  title = "A beam resting on five supports",
  file = "images/work_precision_beam.png" }
