-- What contact costs: the whole contact solve against one linear solve on the same mesh, and that
-- against bare CHOLMOD (scripts/studies/bench/linear_limit.cpp, built here if there is a compiler).
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/contact_vs_linear.lua [RUNS] [N_PLANE] [N_SPACE]
--
-- Scenes: the rigid parabola on a block in the plane (S2) and in space (S3), assembly to recovered
-- stress. The runs of the two are taken in turn; medians and the median of the pairs' ratios.

local runs <const> = tonumber(arg[1]) or 5
local n_plane <const>, n_space <const> = tonumber(arg[2]) or 512, tonumber(arg[3]) or 24
local here <const> = arg[0]:match "^(.*)/[^/]*$" or "."
local scenes <const> = include "../../lib/punch_scenes.lua"
local median <const> = scenes.median

-- 1. The two scenes; without contact they carry a load instead.
local function finish(block, scene, punch, contact, load)
  block:part"bottom":fix()
  if contact then
    scene:contact{ block:part"top", rigid = punch }
  else
    block:part"top":load(load)
  end
  return scene
end

local function plane(n, contact)
  local block, scene, punch = scenes.plane(n)
  return finish(block, scene, punch, contact, { 0, -1 }), function(s) return s:stress(block, 0, -0.1) end
end

local function space(n, contact)
  local cube, scene, punch = scenes.space(n)
  return finish(cube, scene, punch, contact, { 0, 0, -1 }), function(s) return s:stress(cube, 0.5, 0.5, 0.9) end
end

-- 2. One solve, stress included, and its clock.
local function timed(make, n, contact)
  local scene, recover = make(n, contact)
  local s = dotyk.solve(scene)
  local displaced = s.time.total
  recover(s)
  local time = s.time
  return { total = time.total, displaced = displaced, assembly = time.assembly, ordering = time.ordering, factor = time.factor,
           iterate = time.iterate, recover = time.recover, unknowns = s.unknowns,
           iterations = s.iterations, order = s.ordering, megabytes = s.factor_bytes / 1e6 }
end

-- 3. Bare CHOLMOD: a function that solves once by each ordering; nil without a compiler.
local program <const> = os.tmpname()
local built <const> = os.execute(("g++ -O3 -I/usr/include/suitesparse '%s/linear_limit.cpp' -lcholmod "
  .. "-L/usr/lib/$(uname -m)-linux-gnu/openblas-pthread -lopenblas -o %s 2>/dev/null"):format(here, program))
local function bare(dimension, n)
  if not built then return nil end
  local seconds = {}
  for line in io.popen(("%s %d %d 1"):format(program, dimension, n)):lines() do
    local order, value = line:match "(%S+) (%S+)"
    seconds[order] = tonumber(value)
  end
  return seconds
end

local function row(name, runs_of)
  local function of(key)
    local values = {}
    for k, run in ipairs(runs_of) do values[k] = run[key] end
    return median(values)
  end
  local last = runs_of[#runs_of]
  print(("  %-28s %8.3f s  (assembly %.3f, ordering %.3f, factor %.3f, iterate %.3f, recover %.3f; %s, %d iterations, factor %.0f MB)"):format(
    name, of "total", of "assembly", of "ordering", of "factor", of "iterate", of "recover", last.order,
    last.iterations, last.megabytes))
  return of "total"
end

local function compare(name, dimension, make, n)
  local linear, contact, amd, metis, limit_ratio, ratio = {}, {}, {}, {}, {}, {}
  timed(make, n, false) -- warms caches up; not counted
  for k = 1, runs do -- in turn, so that a drift of the machine's speed falls on all alike
    local limit = bare(dimension, n)
    linear[k], contact[k] = timed(make, n, false), timed(make, n, true)
    ratio[k] = contact[k].total / linear[k].total
    if limit then
      amd[k], metis[k] = limit.AMD, limit.METIS
      limit_ratio[k] = linear[k].displaced / math.min(limit.AMD, limit.METIS)
    end
  end
  print(("%s, n = %d, %d unknowns, medians of %d:"):format(name, n, linear[1].unknowns, runs))
  if built then
    print(("  bare CHOLMOD, AMD on nodes   %8.3f s"):format(median(amd)))
    print(("  bare CHOLMOD, METIS on nodes %8.3f s"):format(median(metis)))
  else
    print "  (no compiler: bare CHOLMOD is not measured)"
  end
  row("dotyk, linear", linear)
  row("dotyk, contact", contact)
  if built then
    print(("  linear, without stress / bare CHOLMOD's better   %.2f"):format(median(limit_ratio)))
  end
  print(("  contact / linear                                 %.2f"):format(median(ratio)))
end

compare("S2 (plane)", 2, plane, n_plane)
compare("S3 (space)", 3, space, n_space)
os.remove(program)
