-- Stability atlas: one script on several ranks, and what happens when one of them fails.
--
--   ./dotyk scripts/studies/stability/ranks.lua [FAULTS] [RANKS] [SEED]
--
-- 1. The same scenes at 1, 2, 3, 4 and 8 ranks: energies agree to 1e-9 of their size, the numbers of interface rows are equal. Iterations of conjugate
--    gradients may be a tenth more: sweeps of a rank know what others have from the second sweep of its border on, and aggregates end where a rank ends.
-- 2. Faults while processes of their own solve one scene after the other, started by dotyk.ranks and by mpirun in turn (where that is installed): a rank
--    is killed, also while the ranks start, rank 0 is killed, memory ends on a rank or on rank 0 (a limit of address space at what it has, while scenes grow), the disk is full where
--    rank 0 or another rank writes results, an exception on one rank (it cannot open its file). Each run must end within a minute, with a status other than
--    0, leave no process behind, and all answers that it has given must be right.

local faults <const>, most <const> = tonumber(arg[1]) or 20, tonumber(arg[2]) or 8
local program <const> = io.popen("readlink /proc/$PPID/exe"):read "l"
local here <const> = arg[0]:match "(.*/)" or "./"
local scenes <const> = include "../../lib/scale_scenes.lua"

local child <const> = ([[
local scenes = dofile "%s../../lib/scale_scenes.lua"
local ranks = tonumber(arg[1])
if ranks > 1 then dotyk.ranks(ranks) end
]]):format(here)
-- The file of a child that does this.
local function script(code)
  local file = os.tmpname()
  local out = assert(io.open(file, "w"))
  out:write(child, code)
  out:close()
  return file
end

-- 1. The same answers.
local answers <const> = script [[
local S = dotyk.solver
local function strip(n)
  local b = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, n} } }
  b:part"bottom":fix()
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"top", friction = dotyk.friction.coulomb(0.3), rigid = dotyk.rigid.ball{ center = {0.5, 2.98}, radius = 2 }, interference = true }
  return scene
end
local function graded(element, n, friction) -- stiffness that varies, springs, supports that move
  local b = dotyk.body{ material = dotyk.material{ E = function(x, y, z) return 1000 * (1 + 9 * x) end, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n}, element = element } }
  b:part"bottom":spring{ x = 500, y = 500, z = 2000 }
  b:part"left":displace{ x = 0.002, y = 0.001 }
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"top", friction = friction, interference = true, rigid = dotyk.rigid.ball{ center = {0.5, 0.5, 2.98}, radius = 2 } }
  return scene
end
local function floor(n) -- rows with the other sign, Coulomb friction
  local b = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n} } }
  b:part"top":displace{ x = 0.004, y = 0, z = -0.01 }
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"bottom", friction = dotyk.friction.coulomb(0.3), rigid = dotyk.rigid.plane{ point = {0, 0, 0}, normal = {0, 0, 1} }, interference = true }
  return scene
end
local function lid() -- contact alone holds a body, springs the other one; forces per volume; the ranks refine both
  local function box(name, from, to, n, k, E, force)
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3 }, mesh = dotyk.mesh.box{ from = from, to = to, cells = {n, n, 4} }, refine = k, force = force }
  end
  local lower, upper = box("lower", {0, 0, 0}, {1, 1, 0.5}, 8, 2, 1000, function(x, y, z) return 0, z, -20 * x end), box("upper", {0, 0, 0.5}, {1, 1, 1}, 6, 2, 500, {0, 0, -30})
  lower:part"bottom":spring{ x = 500, y = 500, z = 2000 }
  upper:part"left":slide()
  local scene = dotyk.scene{ lower, upper }
  scene:contact{ upper:part"bottom", lower:part"top", friction = dotyk.friction.coulomb(0.3) }
  return scene
end
for _, case in ipairs{
  { "cube", S.multigrid{}, scenes.cube(16) }, { "cube, coarse slices", S.multigrid{}, scenes.cube(28) }, { "cube, Coulomb", S.multigrid{}, scenes.cube(16, { friction = 0.3 }) },
  { "cube, aggregates", S.multigrid{ levels = "aggregates" }, scenes.cube(16, { friction = 0.3 }) },
  { "blocks, mortar", S.multigrid{}, scenes.blocks(24) }, { "blocks, mortar, Coulomb", S.multigrid{}, scenes.blocks(32, { friction = 0.3, contrast = 10 }) },
  { "blocks, aggregates", S.multigrid{ levels = "aggregates" }, scenes.blocks(24) }, { "blocks, glued", S.multigrid{}, scenes.blocks(24, { linear = true }) },
  { "plane, Coulomb", S.multigrid{}, strip(96) }, { "graded, Coulomb", S.multigrid{}, graded("P1", 14, dotyk.friction.coulomb(0.2)) },
  { "graded, order 2", S.multigrid{}, graded("P2", 10) }, { "floor, Coulomb", S.multigrid{}, floor(24) },
  { "refined cube", S.multigrid{}, scenes.cube(32, { refine = 2 }) }, { "refined cube, Coulomb", S.multigrid{}, scenes.cube(24, { refine = 1, friction = 0.3, element = "Q1" }) },
  { "refined blocks, Coulomb", S.multigrid{}, scenes.blocks(24, { refine = 1, friction = 0.3, contrast = 10 }) }, { "refined lid, forces", S.multigrid{}, lid() } } do
  local s = case[2]:solve(case[3])
  assert(s.converged, s.reason)
  print(("%s|%.17g|%d|%d|%d"):format(case[1], s.energy, s.rows, s.iterations, s.multigrid.cg))
  if case[1]:find "refined" then print(("%s|%.17g|%d|%d|%d"):format(case[1] .. ", estimate", s:error_estimate(), s.rows, 0, 0)) end
end
]]
local alone, worst, more = {}, 0, 0
print "scene                      ranks  energy                rows  Newton steps  iterations"
for _, ranks in ipairs{ 1, 2, 3, 4, 8 } do
  if ranks > most then break end
  local pipe = io.popen(("OPENBLAS_NUM_THREADS=1 timeout 300 '%s' '%s' %d 2>&1"):format(program, answers, ranks))
  local count = 0
  for line in pipe:lines() do
    local name, energy, rows, steps, cg = line:match "^(.-)|(.-)|(%d+)|(%d+)|(%d+)$"
    if not name then error("ranks: " .. line, 0) end
    energy, rows, cg, count = tonumber(energy), tonumber(rows), tonumber(cg), count + 1
    local first = alone[name] or { energy = energy, rows = rows, cg = cg }
    alone[name] = first
    assert(rows == first.rows, "the numbers of rows differ")
    worst = math.max(worst, math.abs(energy / first.energy - 1))
    more = math.max(more, cg / math.floor(1.1 * first.cg + 1e-9))
    print(("%-26s %5d  %-20.15g %5d  %12s  %10d"):format(name, ranks, energy, rows, steps, cg))
  end
  pipe:close()
  assert(count == 20, "a run has ended early")
end
print(("energies and estimates differ by %.0e of their size at most"):format(worst))

-- 2. Faults.
local many <const> = script [[
local file = arg[2]
io.stdout:setvbuf "line"
for n = 10, 100, 2 do
  local s = dotyk.solver.multigrid{}:solve(scenes.cube(n, { friction = 0.3, refine = n % 4 == 0 and 1 or 0 })) -- every second one refined by the ranks
  print(("answer %d %.12g"):format(n, s.energy))
  if file then s:write(file) end
  if file and n % 4 == 0 then s:write((file:gsub("vtu$", "pvtu"))) end -- all ranks write
end
]]
local nothing <const> = "" -- no file: writing checks memory first and refuses, so no allocation would fail
local limit <const> = "prlimit --pid $victim --as=$(awk '/VmSize/ { print $2 * 1024 }' /proc/$victim/status)"
local a_rank <const> = "victim=$(echo $workers | tr ' ' '\\n' | shuf -n 1); "
local kinds <const> = {
  { "a rank is killed", a_rank .. "kill -9 $victim" },
  { "rank 0 is killed", "kill -9 $zero" },
  { "memory ends on a rank", a_rank .. limit, nothing },
  { "memory ends on rank 0", "victim=$zero; " .. limit, nothing },
  { "the disk is full", "prlimit --pid $zero --fsize=4096" },
  { "full where a rank writes", a_rank .. "prlimit --pid $victim --fsize=4096" },
  { "killed while ranks start", "victim=$(echo $zero $workers | tr ' ' '\\n' | shuf -n 1); kill -9 $victim", early = true },
  { "an exception on a rank", "until mkdir ${out}_1.vtu; do rm -f ${out}_1.vtu; done" }, -- a folder is where its file should be, whatever is written meanwhile
}
-- How it is started, and the processes below $runner. By dotyk.ranks, rank 0's child is MPI's daemon, whose children are the other ranks. By mpirun, mpirun is the
-- daemon; its children are all ranks in order.
local starts <const> = {
  { "", "zero=$(children $runner); daemon=$(children $zero); workers=$(children $daemon)" },
  os.execute "command -v mpirun >/dev/null" and
    { "mpirun --allow-run-as-root --oversubscribe -n %d",
      "daemon=$(children $runner); set -- $(children $daemon); zero=$1; [ $# -eq 0 ] || shift; workers=$*" } }
-- Starts, waits and a moment more, does it, and tells the status, the seconds and how many processes are left: those whose environment has this FAULT.
local harness <const> = [[
out=%s; file=$out.vtu; began=$(date +%%s)
FAULT=$out OPENBLAS_NUM_THREADS=1 timeout -k 1 60 %s '%s' '%s' %d %s >$out 2>&1 & runner=$!
children() { echo $(cat /proc/$1/task/*/children 2>/dev/null); }
%s
sleep %.2f
{ %s; } 2>/dev/null
wait $runner; status=$?; took=$(($(date +%%s) - began))
living() { left=$(grep -las "FAULT=$out" /proc/[0-9]*/environ | wc -l); [ $left -gt 0 ]; }
for i in $(seq 50); do living || break; sleep 0.1; done  # a busy machine takes a while to end them
echo "status $status took $took left $left workers $(echo $workers | wc -w)"
rm -rf $file $out.pvtu ${out}_*
]]
local waits <const> = { -- for the first answer; for the first other rank
  "for i in $(seq 200); do grep -q '^answer' $out && break; sleep 0.05; done; %s",
  "for i in $(seq 1000); do %s; [ -n \"$workers\" ] && break; sleep 0.005; done" }
local right, wrong, hung, stayed, kept = {}, 0, 0, 0, 0
local done <const>, by_mpirun <const>, words <const> = {}, {}, {}
math.randomseed(tonumber(arg[3]) or 1)
for f = 1, faults do
  local kind, start = kinds[(f - 1) % #kinds + 1], starts[((f - 1) // #kinds + f) % #starts + 1]
  local ranks = math.random(2, math.max(2, math.min(4, most)))
  local out = os.tmpname()
  local code = harness:format(out, start[1]:format(ranks), program, many, ranks, kind[3] or "$file", waits[kind.early and 2 or 1]:format(start[2]), math.random() * (kind.early and 0.1 or 0.5), kind[2])
  local pipe = io.popen("sh -c '" .. code:gsub("'", "'\\''") .. "' 2>/dev/null")
  local told = pipe:read "a"
  pipe:close()
  local status, took, left, workers = told:match "status (%d+) took (%d+) left (%d+) workers (%d+)"
  workers = tonumber(workers)
  assert(workers == ranks - 1 or (kind.early and workers > 0), "the child has not started its ranks: " .. told)
  for line in io.lines(out) do
    local n, energy = line:match "^answer (%d+) (.*)"
    if n then
      right[n] = right[n] or dotyk.solver.multigrid{}:solve(scenes.cube(tonumber(n), { friction = 0.3, refine = n % 4 == 0 and 1 or 0 })).energy
      if math.abs(energy / right[n] - 1) > 1e-9 then wrong = wrong + 1 end
    end
    if not n and (line:find "dotyk:" or line:find "mpirun noticed") then words[kind[1]] = line:sub(1, 100) end
  end
  os.remove(out)
  local late = tonumber(took) >= 60
  if late or status == "0" or left ~= "0" then
    local by = start == starts[1] and "dotyk.ranks" or "mpirun"
    print(("not handled: %s, by %s, %d ranks, status %s, %s s, %s processes left"):format(kind[1], by, ranks, status, took, left))
  end
  if late then hung = hung + 1 end
  if status == "0" then kept = kept + 1 end
  if left ~= "0" then stayed = stayed + 1 end
  done[kind[1]] = (done[kind[1]] or 0) + 1
  by_mpirun[kind[1]] = (by_mpirun[kind[1]] or 0) + (start == starts[2] and 1 or 0)
  if f % 100 == 0 then io.stderr:write(f, " faults so far, ", hung + kept + stayed + wrong, " not handled\n") end
end
for _, kind in ipairs(kinds) do
  if done[kind[1]] then
    print(("%-24s %4d times, %3d by mpirun; the last words: %s"):format(kind[1], done[kind[1]], by_mpirun[kind[1]], words[kind[1]] or "none"))
  end
end
os.remove(answers)
os.remove(many)
print(("%d faults: %d hung, %d went on to the end, %d left processes behind, %d wrong answers"):format(faults, hung, kept, stayed, wrong))
assert(worst < 1e-9 and more <= 1, "ranks disagree")
assert(hung + kept + stayed + wrong == 0, "a fault was not seen")
