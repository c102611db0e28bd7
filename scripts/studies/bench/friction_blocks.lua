-- Coulomb friction at many points: two blocks against rigid shapes by the default method, and what the plan expects.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/friction_blocks.lua [N] [M]
--
-- A cube of N³ cells against a rigid paraboloid, of whose top a tenth comes near; and a slab of M × M × M/8 cells pressed up against a rigid cylinder
-- that is almost flat, to all of which it comes near and on a part of which it closes. Rows, seconds, greatest memory of the process so far.

local n <const>, m <const> = tonumber(arg[1]) or 40, tonumber(arg[2]) or 64
local friction <const>, peak_memory <const> = include "../../lib/friction.lua", include "../../lib/peak_memory.lua"
local coulomb <const> = dotyk.friction.coulomb(0.3)

local function slab()
  local body = dotyk.body{ name = "slab", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {8, 8, 1}, cells = {m, m, m // 8} } }
  body:part"bottom":displace{ x = 0.01, y = 0, z = 0.006 }
  local scene = dotyk.scene{ body }
  scene:contact{ body:part"top", friction = coulomb,
    rigid = dotyk.rigid.gap{ normal = {0, 0, 1}, gap = function(x) return 0.005 + 0.01 * (x / 4 - 1)^2 end } }
  return scene
end

for _, case in ipairs{ { "cube", friction.cube(n, coulomb) }, { "slab", slab() } } do
  print(case[1] .. ": " .. case[2]:plan():match "method: ([^\n]*)")
  local s <const> = dotyk.solve(case[2])
  assert(s.converged, s.reason)
  local contact <const> = s:contact(case[2].contacts[1])
  local last <const> = s.history[#s.history]
  print(("  %d unknowns, %d rows, %d closed (%d stick, %d slip): %.1f s, %d iterations, %.2f GB, force %.6g"):format(
    s.unknowns, s.rows, last.active, last.stick, last.slip, s.time.total, s.iterations, peak_memory(), contact.force[3]))
end
