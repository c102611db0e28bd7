-- A cube under a sphere: the problem of deal.II's tutorial step-42 (version 9.4), elastic.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/sphere_obstacle.lua [N…]
--
-- The unit cube of N³ cells of eight nodes, E = 200000, nu = 0.3, its bottom held, its sides free to move along z alone; the displacement along z of the
-- nodes of its top ends at a sphere of radius 0.6 which reaches 0.01 below it. For each N the contact force, which that program (with the yield stress
-- raised to 1e12) gives as 165.482, 232.356, 240.033 and 242.168 for N = 8, 16, 32 and 64, seconds of the whole solve, and iterations. With
-- dotyk --ranks R the work is shared, as with mpirun there.

local sizes = {}
for _, n in ipairs(arg) do sizes[#sizes + 1] = tonumber(n) end
if #sizes == 0 then sizes = { 8, 16, 32 } end
local known <const> = { [8] = 165.482, [16] = 232.356, [32] = 240.033, [64] = 242.168 }

local function scene(n)
  local cube <const> = dotyk.body{ material = dotyk.material{ E = 200000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n}, element = "Q1" } }
  cube:part"bottom":fix()
  for _, side in ipairs{ "left", "right", "front", "back" } do cube:part(side):displace{ x = 0, y = 0 } end
  local s <const> = dotyk.scene{ cube }
  local contact <const> = s:contact{ cube:part"top", rigid = dotyk.rigid.gap{ normal = {0, 0, 1}, gap = function(x, y)
    local square <const> = (x - 0.5)^2 + (y - 0.5)^2
    return square < 0.36 and 0.59 - math.sqrt(0.36 - square) or 1000
  end }, interference = true }
  return s, contact
end

print("   n  unknowns  contact force   active  Newton  iterations  seconds  ranks")
for _, n in ipairs(sizes) do
  local problem <const>, contact <const> = scene(n)
  local s <const> = dotyk.solver.multigrid{}:solve(problem)
  assert(s.converged, s.reason)
  local c <const> = s:contact(contact)
  local force, active = 0, 0
  for _, node in ipairs(c.nodes) do
    force = force + node.force
    if node.force > 0 then active = active + 1 end
  end
  print(("%4d %9d  %13.6g  %7d  %6d  %10d  %7.2f  %5d"):format(n, s.unknowns, force, active, s.iterations, s.multigrid.cg, s.time.total, dotyk.ranks()))
  if known[n] then assert(math.abs(force / known[n] - 1) < 1e-5, "the force is another one than deal.II's") end
end
