-- A rigid parabola pressed into a block, in the plane and in space.
--
--   ./dotyk scripts/examples/punch.lua [CELLS]
--
-- Energy, force and iterations under refinement, from a cold start and from the coarser mesh's
-- solution; images/punch.png. The same problem is solved by other public codes (tests/scene compares).

local finest <const> = tonumber(arg[1]) or 256
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }

-- 1. The block (-1,1) x (-1,0), held below; on top u_y <= x²/4 - 0.02.
local function plane(n)
  local mesh = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {n, n // 2} }
  local block = dotyk.body{ name = "block", mesh = mesh, material = material }
  block:part"bottom":fix()
  local scene = dotyk.scene{ block }
  local punch = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 - 0.02 end }
  return scene, scene:contact{ block:part"top", rigid = punch }
end

-- 2. The unit cube, held below; on top u_z <= ((x-½)² + (y-½)²)/2 - 0.02.
local function space(n)
  local mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n} }
  local cube = dotyk.body{ name = "cube", mesh = mesh, material = material }
  cube:part"bottom":fix()
  local scene = dotyk.scene{ cube }
  local punch = dotyk.rigid.gap{ normal = {0, 0, 1},
                                 gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.02 end }
  return scene, scene:contact{ cube:part"top", rigid = punch }
end

-- 3. Refinement: the coarser solution starts the finer one.
local function refine(name, make, sizes)
  print(name)
  print "    n  unknowns          energy           force  closed  iterations cold/warm  seconds"
  local coarse
  for _, n in ipairs(sizes) do
    local scene, contact = make(n)
    local cold = dotyk.solve(scene)
    local warm = coarse and dotyk.solve(scene, { start = coarse })
    local c = cold:contact(contact)
    print(("%5d %9d  %.12f  %14.10f  %6d  %10d / %-7s  %8.3f"):format(
      n, cold.unknowns, cold.energy, -c.force[#c.force], c.closed, cold.iterations,
      warm and warm.iterations or "–", cold.time.total))
    coarse = cold
  end
  return coarse
end

local sizes = {}
for k = 4, 0, -1 do
  if finest >> k >= 16 then sizes[#sizes + 1] = finest >> k end
end
local s = refine("plane:", plane, sizes)
refine("space:", space, finest >= 256 and { 8, 16, 24 } or { 4, 6 })
print(s)

-- 4. The figure, on a mesh whose cells can be seen.
local shown = dotyk.solve((plane(math.min(64, finest))))
shown:render{ file = "images/punch.png", field = "von_mises", units = { length = "mm", stress = "MPa" }, supports = true, isolines = true }
print "images/punch.png"
