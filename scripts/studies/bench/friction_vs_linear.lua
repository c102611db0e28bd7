-- What friction costs: the whole solve with Coulomb friction against one linear solve of the same bodies.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/friction_vs_linear.lua [RUNS] [N_PLANE] [N_SPACE]
--
-- C2, two blocks in the plane, against the two glued together and against one block of their size; S3C, a
-- paraboloid pressed into a cube, against the cube under a load. Assembly to recovered stress. The runs of a
-- comparison are taken in turn; medians and the median of the ratios.

local runs <const> = tonumber(arg[1]) or 5
local n_plane <const>, n_space <const> = tonumber(arg[2]) or 512, tonumber(arg[3]) or 24
local friction <const> = include "../../lib/friction.lua"
local punch <const> = include "../../lib/punch_scenes.lua"
local median <const>, coulomb <const> = punch.median, dotyk.friction.coulomb(0.3)
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }

local function two_blocks(n) return (friction.blocks(n, coulomb)) end

local function one_block(n)
  local block = dotyk.body{ name = "both", material = material,
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 2}, cells = {n, n} } }
  block:part"bottom":fix()
  block:part"top":load{ 2, -10 }
  return dotyk.scene{ block }
end

local function glued(n)
  local scene = friction.blocks(n)
  local lower, upper = scene.bodies[1], scene.bodies[2]
  local together = dotyk.scene{ lower, upper }
  together:glue{ upper:part"bottom", lower:part"top" }
  return together
end

local function cube(n) return (friction.cube(n, coulomb)) end

local function loaded_cube(n)
  local body, scene = punch.space(n)
  body:part"bottom":fix()
  body:part"top":load{ 0, 0, -1 }
  return scene
end

local function timed(make, n)
  local scene = make(n)
  local s = dotyk.solve(scene)
  assert(s.converged, s.reason)
  s:error_estimate() -- recovers the stress of every body
  return s.time.total, s
end

local function compare(name, n, limit, with, ...)
  local ratios, seconds, s = {}, {}
  timed(with, n) -- warms caches up; not counted
  for k = 1, runs do
    seconds[k], s = timed(with, n)
    for j, without in ipairs{ ... } do
      ratios[j] = ratios[j] or {}
      ratios[j][k] = seconds[k] / timed(without.make, n)
    end
  end
  print(("%s, n = %d, %d unknowns: %.3f s, %d iterations (medians of %d)"):format(name, n, s.unknowns, median(seconds), s.iterations, runs))
  for j, without in ipairs{ ... } do
    print(("  against %-34s %.2f   asked: at most %.1f"):format(without.name, median(ratios[j]), limit))
  end
end

compare("C2 (plane)", n_plane, 2.2, two_blocks, { name = "the blocks as one body, linear", make = one_block },
  { name = "the blocks glued", make = glued })
compare("S3C (space)", n_space, 2.5, cube, { name = "the cube, linear", make = loaded_cube })
