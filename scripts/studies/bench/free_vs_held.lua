-- What a free body costs: contact of a body held by contact alone, against the same body held by a support.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/free_vs_held.lua [RUNS] [N_PLANE] [N_SPACE]
--
-- Scenes S2 and S3 of contact_vs_linear.lua; in the free version the far side is loaded instead of held,
-- so that contact alone stops the motion across. Runs in turn, median of the pairs' ratios.

local runs <const> = tonumber(arg[1]) or 5
local n_plane <const>, n_space <const> = tonumber(arg[2]) or 512, tonumber(arg[3]) or 24
local scenes <const> = include "../../lib/punch_scenes.lua"
local median <const> = scenes.median

local function plane(n, free)
  local block, scene, punch = scenes.plane(n)
  if free then
    block:part"left":fix "x"
    block:part"bottom":pressure(7)
  else
    block:part"bottom":fix()
  end
  scene:contact{ block:part"top", rigid = punch }
  return scene
end

local function space(n, free)
  local cube, scene, punch = scenes.space(n)
  if free then
    cube:part"left":fix "x"
    cube:part"front":fix "y"
    cube:part"bottom":pressure(4)
  else
    cube:part"bottom":fix()
  end
  scene:contact{ cube:part"top", rigid = punch }
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
