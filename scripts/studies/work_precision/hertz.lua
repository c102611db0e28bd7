-- Work and precision on Hertz's line contact: the error in the energy norm, and the pressure's in L2 beside the closed form.
--
--   ./dotyk scripts/studies/work_precision/hertz.lua [LEVELS]
--
-- A disc on a rigid plane, without friction. What the charts say: all methods find the solution of the mesh. Condensed on the
-- contact boundary, pdas costs one linear solve and projected gradients little more; the same active sets with a factorisation in
-- each step cost several times that. The displacement gets nearer with every mesh, the pressure by luck: as the contact's edge
-- happens to lie between the nodes. images/work_precision_hertz.png, images/work_precision_hertz_pressure.png.

local levels <const> = tonumber(arg[1]) or 6
local hertz <const> = include "../../lib/hertz.lua"
local solver <const> = dotyk.solver
local sizes <const> = { 8, 12, 16, 24, 32, 48, 96 } -- cells along the radius; LEVELS + 1 of them

for _, case in ipairs{ { "", "energy", "Hertz's line contact" },
  { "_pressure", hertz.line_error, "Hertz's line contact: pressure", "distance from the closed form in L², relative" } } do
  print(case[3])
  dotyk.work_precision{
    scene = function(level) return hertz.disc(sizes[level]) end,
    levels = levels,
    methods = { { name = "pdas, condensed", method = solver.pdas{} }, { name = "pdas, whole system", method = solver.pdas{ reduced = false } },
      solver.interior_point{}, solver.projected_cg{}, solver.uzawa{} },
    error = case[2], label = case[4], slopes = { -0.5 }, title = case[3],
    file = ("images/work_precision_hertz%s.png"):format(case[1]) }
end
