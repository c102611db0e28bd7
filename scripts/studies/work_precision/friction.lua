-- Work and precision of methods for friction: two blocks under a traction, given (T2) and Coulomb's friction (C2).
--
--   ./dotyk scripts/studies/work_precision/friction.lua [LEVELS]
--
-- The error in the energy norm against one level more. What the charts say: Newton's method and the loop over given friction
-- stay at the cost of the factorisation on every mesh; Uzawa's method leaves them as soon as its steps, which grow with the number
-- of nodes along the interface, cost more. images/work_precision_tresca.png, images/work_precision_coulomb.png.

local levels <const> = tonumber(arg[1]) or 5
local blocks <const> = include "../../lib/friction.lua".blocks
local solver <const> = dotyk.solver
local many <const> = { max_iterations = 1000000 }

for _, case in ipairs{ { "tresca", "given", dotyk.friction.tresca(2.5) }, { "coulomb", "Coulomb's", dotyk.friction.coulomb(0.3) } } do
  local name <const>, shown <const>, law <const> = table.unpack(case)
  print(("two blocks with %s friction"):format(shown))
  dotyk.work_precision{
    scene = function(level) return blocks(4 << level, law) end,
    levels = levels,
    methods = { solver.newton{}, solver.coulomb_loop(many), solver.projected_cg(many), solver.psor(many), solver.uzawa(many),
      solver.uzawa_pdas(many) },
    slopes = { -0.5 }, budget = 10,
    title = ("Two blocks with %s friction"):format(shown),
    file = ("images/work_precision_%s.png"):format(name) }
end
