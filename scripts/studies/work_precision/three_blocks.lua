-- Work and precision in space with two floating bodies: three blocks of rock over an excavation, FETI beside the direct method.
--
--   ./dotyk scripts/studies/work_precision/three_blocks.lua [LEVELS]
--
-- The error in the energy norm against twice the cells of the finest level charted. What the chart says: at these sizes the factor
-- of whole bodies is cheap; FETI on them, which uses both cores, comes up to the direct method at the finest level, where it is
-- little faster on a quiet machine and slower on a busy one; subdomains pay later (see scripts/studies/methods/feti_scaling.lua). images/work_precision_three_blocks.png.

local levels <const> = tonumber(arg[1]) or 3
local three_blocks <const> = include "../../lib/three_blocks.lua"
local function feti(options)
  options.tol, options.supports = 1e-6, "stiffness"
  return dotyk.solver.feti(options)
end

dotyk.work_precision{
  scene = function(level)
    local n <const> = level <= levels and level or 2 * levels -- 2 · LEVELS refines the finest, not all the others
    return three_blocks({ 2 * n, 3 * n, 2 * n, 2 * n }, { 1 / 2, 2 / 3, 1 / 2 })
  end,
  levels = levels,
  methods = { dotyk.solver.pdas{}, dotyk.solver.interior_point{},
    { name = "feti, whole bodies", method = feti{} }, { name = "feti, lumped", method = feti{ preconditioner = "lumped" } },
    { name = "feti, 2 × 2 × 2, Dirichlet", method = feti{ preconditioner = "dirichlet", subdomains = { 2, 2, 2 } } } },
  title = "Three blocks over an excavation",
  file = "images/work_precision_three_blocks.png" }
