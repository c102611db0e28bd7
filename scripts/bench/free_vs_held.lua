-- What a free body costs: contact of a body held by contact alone, against the same body held by a support.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/bench/free_vs_held.lua [RUNS] [N_PLANE] [N_SPACE]
--
-- Scenes S2 and S3 of contact_vs_linear.lua; in the free version the far side is loaded instead of held,
-- so that contact alone stops the motion across. Runs in turn, median of the pairs' ratios.

local runs <const> = tonumber(arg[1]) or 5
local n_plane <const>, n_space <const> = tonumber(arg[2]) or 512, tonumber(arg[3]) or 24
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }

local function median(values)
  local sorted = table.move(values, 1, #values, 1, {})
  table.sort(sorted)
  return sorted[(#sorted + 1) // 2]
end

local function plane(n, free)
  local block = dotyk.body{ material = material,
    mesh = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {n, n // 2} } }
  if free then
    block:part"left":fix "x"
    block:part"bottom":pressure(7)
  else
    block:part"bottom":fix()
  end
  local scene = dotyk.scene{ block }
  scene:contact{ block:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 - 0.02 end } }
  return scene
end

local function space(n, free)
  local cube = dotyk.body{ material = material,
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n} } }
  if free then
    cube:part"left":fix "x"
    cube:part"front":fix "y"
    cube:part"bottom":pressure(4)
  else
    cube:part"bottom":fix()
  end
  local scene = dotyk.scene{ cube }
  scene:contact{ cube:part"top", rigid = dotyk.rigid.gap{ normal = {0, 0, 1},
    gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.02 end } }
  return scene
end

local function compare(name, make, n)
  local held, free, ratio = {}, {}, {}
  dotyk.solve(make(n, false)) -- warms caches up; not counted
  local h, f
  for k = 1, runs do
    h, f = dotyk.solve(make(n, false)), dotyk.solve(make(n, true))
    held[k], free[k] = h.time.total, f.time.total
    ratio[k] = free[k] / held[k]
  end
  print(("%s, n = %d: held %.3f s (%d unknowns, %d iterations), free %.3f s (%d unknowns, %d iterations), free / held %.2f"):format(
    name, n, median(held), h.unknowns, h.iterations, median(free), f.unknowns, f.iterations, median(ratio)))
end

compare("plane", plane, n_plane)
compare("space", space, n_space)
