-- Contact without a large factor: pdas on all unknowns, its linear systems solved by conjugate gradients, against the default method.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/linear_solvers.lua [N…]
--
-- S3, a rigid paraboloid on a cube of N³ cells of six tetrahedra, and a free block of about half its cells pressed on another whose meshes do not
-- match. Seconds of the whole solve and megabytes that the linear solver keeps beside the matrix: a factor's grow faster than the unknowns, those of
-- an incomplete factor and of a multigrid hierarchy as they do. The energies agree. Where PETSc is absent, its column is left out.

local sizes = {}
for _, n in ipairs(arg) do sizes[#sizes + 1] = tonumber(n) end
if #sizes == 0 then sizes = { 8, 16, 24, 32 } end
local punch <const> = include "../../lib/punch_scenes.lua"
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }

local function cube(n)
  local body, scene, gap = punch.space(n)
  body:part"bottom":fix()
  scene:contact{ body:part"top", rigid = gap, interference = true }
  return scene
end

local function two_blocks(n)
  local half <const> = n // 2
  local lower = dotyk.body{ name = "lower", material = material,
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 0.5}, cells = {n, n, half} } }
  local upper = dotyk.body{ name = "upper", material = material, force = { 0, 0, -1 },
    mesh = dotyk.mesh.box{ from = {0.2, 0.2, 0.5}, to = {0.8, 0.8, 1}, cells = {half + 1, half + 1, half} } }
  lower:part"bottom":fix()
  upper:part"left":slide()
  upper:part"front":slide()
  local scene = dotyk.scene{ lower, upper }
  scene:contact{ upper:part"bottom", lower:part"top" }
  return scene
end

local solvers <const> = {
  { "default", dotyk.solve },
  { "incomplete factor", function(scene) return dotyk.solver.pdas{ linear = "incomplete_factor" }:solve(scene) end },
}
do
  local multigrid <const> = dotyk.solver.multigrid{}
  local there <const>, why <const> = pcall(multigrid.solve, multigrid, cube(2))
  if there then solvers[#solvers + 1] = { "multigrid", function(scene) return multigrid:solve(scene) end } else print(why) end
end

for _, case in ipairs{ { "rigid paraboloid on a cube", cube }, { "two blocks that do not match", two_blocks } } do
  local head = "\n" .. case[1] .. "\n  n"
  for _, solver in ipairs(solvers) do head = head .. ("%24s"):format(solver[1]) end
  print(head .. "    energies differ by")
  for _, n in ipairs(sizes) do
    local line, energy, differs = ("%3d"):format(n), nil, 0
    for _, solver in ipairs(solvers) do
      local s <const> = solver[2](case[2](n))
      assert(s.converged, s.reason)
      energy = energy or s.energy
      differs = math.max(differs, math.abs(s.energy / energy - 1))
      line = line .. ("%13.2f s %6.0f MB"):format(s.time.total, s.factor_bytes / 1e6)
    end
    print(line .. ("%14.1e"):format(differs))
    assert(differs < 1e-9, "the methods do not agree")
  end
end
