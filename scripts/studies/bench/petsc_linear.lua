-- Contact by dotyk's multigrid against one linear solve by PETSc's own, PCMG, of the same cube.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/petsc_linear.lua [N=64] [RUNS=3]
--
-- S3, a rigid paraboloid on a cube of N³ cells of six tetrahedra, frictionless and with Coulomb's coefficient 0.3, and two blocks of the same size, on one
-- process. PETSc's program, ../shared/reference/petsc_linear3.c, presses the same cube by a load: conjugate gradients, levels down to 4 cells, or as far as
-- numbers of cells are even, one sweep of Gauss and Seidel, to 1e-8. It needs mpicc and PETSc's headers (libpetsc-real-dev). Seconds without assembly on either side, PETSc's with
-- its set-up; taken in turn, medians.

local n <const>, runs <const> = tonumber(arg[1]) or 64, tonumber(arg[2]) or 3
local scenes <const>, median <const> = include "../../lib/scale_scenes.lua", include "../../lib/punch_scenes.lua".median
local here <const> = arg[0]:match "(.*/)" or "./"
local source <const> = here .. "../../../../shared/reference/petsc_linear3.c"
local reference <close> = io.open(source)
if not reference then
  print("skipped: there is no " .. source)
  return
end
local petsc <const> = "/usr/lib/petscdir/petsc-real"
local binary <const> = os.tmpname()
assert(os.execute(("mpicc -O3 -I%s/include '%s' -L%s/lib -lpetsc_real -lm -o %s"):format(petsc, source, petsc, binary)), "PETSc's program was not built")

local levels, coarse = 1, n
while coarse % 2 == 0 and coarse > 4 do levels, coarse = levels + 1, coarse // 2 end
local command <const> = ("OPENBLAS_NUM_THREADS=1 %s -n %d -levels %d -mg_levels_ksp_type richardson -mg_levels_pc_type sor -mg_levels_ksp_max_it 1 -ksp_rtol 1e-8"):format(
  binary, n, levels)
local function by_petsc()
  local pipe <close> = io.popen(command)
  local told <const> = pipe:read "a"
  local unknowns <const>, setup <const>, solve <const>, its <const> = told:match "unknowns=(%d+).-setup=(%S+) solve=(%S+) its=(%d+)"
  if not its then error("petsc_linear: " .. told, 0) end
  return tonumber(setup) + tonumber(solve), tonumber(unknowns), tonumber(its)
end
local multigrid <const> = dotyk.solver.multigrid{}
multigrid:solve(scenes.cube(4)) -- MPI starts
local function by_dotyk(scene)
  local s <const> = multigrid:solve(scene)
  assert(s.converged, s.reason)
  return s.time.total - s.time.assembly, s.unknowns, s.multigrid.cg, s.multigrid.newton
end

local cases <const> = {
  { "PCMG, one linear solve", by_petsc }, { "frictionless", function() return by_dotyk(scenes.cube(n)) end },
  { "Coulomb 0.3", function() return by_dotyk(scenes.cube(n, { friction = 0.3 })) end }, { "two blocks", function() return by_dotyk(scenes.blocks(n)) end } }
for _, case in ipairs(cases) do case.seconds = {} end
for run = 1, runs do
  for _, case in ipairs(cases) do
    local seconds
    seconds, case.unknowns, case.cg, case.newton = case[2]()
    case.seconds[run] = seconds
  end
end
os.remove(binary)
print(("n = %d, medians of %d runs\n                         unknowns  seconds  against PCMG  steps  iterations"):format(n, runs))
for _, case in ipairs(cases) do
  print(("%-24s %8d %8.2f %13.2f %6s %11d"):format(case[1], case.unknowns, median(case.seconds), median(case.seconds) / median(cases[1].seconds), case.newton or "", case.cg))
end
