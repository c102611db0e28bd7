-- What a one-sided edge costs a plate: the whole solve against one linear solve on the same mesh.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/bench/plate_vs_linear.lua [RUNS] [N_MORLEY] [N_HCT]
--
-- A uniformly loaded square, 1e5 unknowns: its edge held (dotyk.law.prescribed, linear), resting on a rigid one-sided support
-- (dotyk.law.signorini) that the corners leave, and the same where the edge does not rotate. Assembly to solution. The runs are
-- taken in turn; medians and the median of the pairs' ratios.

local runs <const> = tonumber(arg[1]) or 7
local cells <const> = { morley = tonumber(arg[2]) or 158, hct = tonumber(arg[3]) or 129 }
local median <const> = include "../../lib/punch_scenes.lua".median
local law <const> = dotyk.law
local keys <const> = { "total", "assembly", "ordering", "factor", "iterate", "recover" }

local function timed(element, deflection, rotation)
  local n <const> = cells[element]
  local s <const> = dotyk.solve(dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } }, element = element, nu = 0.3,
    load = -1, edge = { deflection = deflection, rotation = rotation } })
  assert(s.converged, s.reason)
  return s
end

local function row(name, solved)
  local of <const> = {}
  for k, key in ipairs(keys) do
    local values <const> = {}
    for i, s in ipairs(solved) do values[i] = s.time[key] end
    of[k] = median(values)
  end
  print(("  %-22s %7.3f s  (assembly %.3f, ordering %.3f, factor %.3f, iterate %.3f, recover %.3f; %d rows, %d iterations)"):format(name, of[1], of[2],
    of[3], of[4], of[5], of[6], solved[1].rows, solved[1].iterations))
end

for _, element in ipairs{ "morley", "hct" } do
  for _, turns in ipairs{ true, false } do
    local rotation <const> = not turns and law.prescribed() or nil
    local linear <const>, contact <const>, ratio <const> = {}, {}, {}
    timed(element, law.prescribed(), rotation) -- warms caches up; not counted
    for k = 1, runs do -- in turn, so that a drift of the machine's speed falls on both alike
      linear[k], contact[k] = timed(element, law.prescribed(), rotation), timed(element, law.signorini(), rotation)
      ratio[k] = contact[k].time.total / linear[k].time.total
    end
    print(("%s, %d cells along a side, edge %s, %d unknowns, medians of %d:"):format(element, cells[element],
      turns and "rotates" or "does not rotate", contact[1].unknowns, runs))
    row("held, linear", linear)
    row("one-sided", contact)
    print(("  one-sided / linear     %7.2f"):format(median(ratio)))
  end
end
