-- How much a second process helps: strong and weak scaling of multigrid.
--
--   ./dotyk scripts/studies/scaling.lua [N] [RUNS] [RANKS] [REFINE]
--
-- S3, a rigid paraboloid on a cube of N³ cells. Strong: the same cube on 1 process and on RANKS. Weak: on RANKS processes a row of so many cubes, which are
-- one body, each under a paraboloid of its own: N³ cells for each process, the same cells and levels. Also a cube of so many cells more: its levels are
-- others, and Newton's method may take another number of steps. Each process has one core. Runs take turns, since machines change their speed; medians of
-- the seconds and of each run's efficiencies.
-- Cells are cut REFINE times (1; 0: rank 0 makes the whole mesh and shares it out).
-- What memory allows is measured beside it: RANKS processes that know nothing of each other, each with a cube of its own.
-- Seconds count from before the mesh is made until the answer is known: several ranks refine their shares within the solve, one process before it. Each process does
-- that three times; the faster of the last two counts. The first takes memory from the system, and on several ranks the second still takes some: 0.1 GB cost
-- a virtual machine up to 0.4 s. One process uses the cores in turn.
-- Prints the seconds and the efficiency: seconds of one process, times the cells' ratio, over RANKS times the seconds. The clock has steps of 0.01 s, so N should be 32 or more.

local n <const>, runs <const>, ranks <const> = tonumber(arg[1]) or 32, tonumber(arg[2]) or 4, tonumber(arg[3]) or 2
local refine <const> = tonumber(arg[4]) or 1
local program <const> = io.popen("readlink /proc/$PPID/exe"):read "l"
local here <const> = arg[0]:match "(.*/)" or "./"
local median <const> = include "../lib/punch_scenes.lua".median

local child <const> = os.tmpname()
do
  local out <const> = assert(io.open(child, "w"))
  out:write(([[
local scenes = dofile "%s../lib/scale_scenes.lua"
local ranks, n, row = tonumber(arg[1]), tonumber(arg[2]), tonumber(arg[3])
if ranks > 1 then dotyk.ranks(ranks) end
local function now() -- seconds, to a hundredth
  local uptime <close> = io.open "/proc/uptime"
  return uptime:read "n"
end
local s, seconds = nil, math.huge
for run = 1, 3 do
  s = nil
  collectgarbage() -- the next solution takes the memory of this one
  local from <const> = now()
  s = dotyk.solver.multigrid{}:solve(scenes.cube(n, { row = row, refine = tonumber(arg[4]) }))
  if run > 1 then seconds = math.max(math.min(seconds, now() - from), 0.01) end
end
assert(s.converged, s.reason)
print(("%%d %%.17g %%d %%d %%.17g"):format(s.unknowns, seconds, s.multigrid.newton, s.multigrid.cg, s.energy / row))
]]):format(here))
  out:close()
end

local function start(processes, cells, row, core)
  return io.popen(("OPENBLAS_NUM_THREADS=1 taskset -c %s '%s' '%s' %d %d %d %d 2>&1"):format(core, program, child, processes, cells, row, refine))
end
local function finish(pipe)
  local line <const> = pipe:read "a"
  pipe:close()
  local unknowns, seconds, newton, cg, energy = line:match "^(%d+) (%S+) (%d+) (%d+) (%S+)\n$"
  if not unknowns then error("scaling: " .. line, 0) end
  return { unknowns = tonumber(unknowns), seconds = tonumber(seconds), newton = tonumber(newton), cg = tonumber(cg), energy = tonumber(energy) }
end

-- The cores that this process may use.
local cores = {}
for first, last in io.popen("grep Cpus_allowed_list /proc/self/status | cut -f2 | tr ',' '\\n' | sed 's/^[0-9]*$/&-&/'"):read "a":gmatch "(%d+)-(%d+)" do
  for core = first, last do cores[#cores + 1] = ("%d"):format(core) end
end
if #cores < ranks then error(("scaling: %d processes need a core each, and this machine gives %d"):format(ranks, #cores), 0) end
local all_cores <const> = table.concat(cores, ",", 1, ranks)
local step <const> = 2 << refine
local larger <const> = step * math.floor(n * ranks^(1 / 3) / step + 0.5)
local cases <const> = {
  { "one process", function(run) return finish(start(1, n, 1, cores[run % ranks + 1])) end },
  { "strong", function() return finish(start(ranks, n, 1, all_cores)) end, cells = 1 },
  { "weak, a row", function() return finish(start(ranks, n, ranks, all_cores)) end, cells = ranks },
  { "weak, a cube", function() return finish(start(ranks, larger, 1, all_cores)) end, cells = (larger / n)^3 },
  { "apart", function()
    local all, slowest = {}, nil
    for k = 1, ranks do all[k] = start(1, n, 1, cores[k]) end
    for k = 1, ranks do
      local one <const> = finish(all[k])
      if not slowest or one.seconds > slowest.seconds then slowest = one end
    end
    return slowest
  end, cells = ranks },
}
for _, case in ipairs(cases) do case.seconds = {} end
for run = 1, runs do
  for _, case in ipairs(cases) do
    case.last = case[2](run)
    table.insert(case.seconds, case.last.seconds)
  end
end
os.remove(child)

local alone <const> = cases[1].last
assert(math.abs(cases[2].last.energy / alone.energy - 1) < 1e-9, "the answer depends on the number of processes")
print(("%d processes, medians of %d runs"):format(ranks, runs))
print "               unknowns  steps  iterations  seconds (least to most)     efficiency"
for _, case in ipairs(cases) do
  local time <const>, efficiencies <const> = median(case.seconds), {}
  for run, seconds in ipairs(case.seconds) do efficiencies[run] = cases[1].seconds[run] * (case.cells or 0) / (ranks * seconds) end
  print(("%-14s %8d %6d %11d %8.2f (%.2f to %.2f) %18s"):format(case[1], case.last.unknowns, case.last.newton, case.last.cg, time,
    math.min(table.unpack(case.seconds)), math.max(table.unpack(case.seconds)), case.cells and ("%.2f"):format(median(efficiencies)) or ""))
end
