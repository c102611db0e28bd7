-- Work and precision on a plate: a square lying on one-sided edges under a uniform load, whose corners lift off.
--
--   ./dotyk scripts/studies/work_precision/plate.lua [LEVELS]
--
-- The error of the curvatures in the energy norm, against HCT's element on one level more. What the chart says: the element decides, not the
-- method: HCT's, of order h² but for the ends of contact (where u ~ r^5/2 leaves h^3/2), overtakes Morley's, of order h, at once; on the edge's few
-- rows every method costs little beside the factorisation, but for those whose steps grow with the rows.
-- images/work_precision_plate.png.

local levels <const> = tonumber(arg[1]) or 4
local solver <const> = dotyk.solver

local function plate(element)
  return function(level)
    local n <const> = 4 << level
    return dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } }, element = element, load = -1,
      edge = { deflection = dotyk.law.signorini() } }
  end
end

local reference <const> = dotyk.solve(plate "hct"(levels + 1))
for _, element in ipairs{ "morley", "hct" } do
  dotyk.work_precision{
    scene = plate(element),
    levels = levels,
    methods = { solver.pdas{}, solver.newton{ max_iterations = 200 }, solver.uzawa_pdas{ max_iterations = 200 }, solver.interior_point{},
      solver.projected_cg{ max_iterations = 20000 } },
    reference = reference, slopes = { element == "hct" and -0.75 or -0.5 },
    title = ("A plate on one-sided edges, %s element"):format(element == "hct" and "HCT's" or "Morley's"),
    file = ("images/work_precision_plate_%s.png"):format(element) }
end
