-- What an obstacle under a plate costs: the whole solve against that of the plate without it, refined.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/plate_obstacle.lua [RUNS] [FINEST]
--
-- A simply supported square, D = 1, load 100 downwards, flat obstacle at -0.1; every vertex is a row. Solved in turn with and without
-- it; medians of the times without assembly, and of the pairs' ratios. FINEST: cells along a side.

local runs <const>, finest <const> = tonumber(arg[1]) or 5, tonumber(arg[2]) or 128
local median <const> = include "../../lib/punch_scenes.lua".median

local function timed(n, element, obstacle)
  local s <const> = dotyk.solve(dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } }, element = element,
    load = -100, edge = { deflection = dotyk.law.prescribed() }, obstacle = obstacle })
  assert(s.converged, s.reason)
  return s.time.total - s.time.assembly, s
end

print " element  cells  unknowns   linear [s]   obstacle [s]   ratio   energy          how"
for _, element in ipairs{ "morley", "hct" } do
  local n = 16
  while n <= finest do
    local without, with, ratio, s = {}, {}, {}
    timed(n, element) -- warms caches up; not counted
    for k = 1, runs do
      without[k] = timed(n, element)
      with[k], s = timed(n, element, -0.1)
      ratio[k] = with[k] / without[k]
    end
    print((" %-7s  %5d  %8d   %10.3f   %12.3f   %5.1f   %.9f   %d iterations of %s; %s"):format(
      element, n, s.unknowns, median(without), median(with), median(ratio), s.energy, s.iterations, s.method, s.reason))
    n = 2 * n
  end
end
