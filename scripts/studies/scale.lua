-- How far each method carries: seconds and bytes against unknowns, where the methods cross, and what multigrid's iterations grow with.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/scale.lua [N…]
--
-- S3, a rigid paraboloid on a cube of N³ cells of six tetrahedra: by factors (pdas), by FETI on cubes of 8³ cells, by multigrid with levels of
-- aggregates (algebraic) and of coarser meshes (geometric). Each solution has a process of its own. Its bytes are the most memory that this process takes:
-- program, mesh, results and all. Its seconds are those of the solution: of two runs the faster one counts, where they take less than 5 s.
-- A small cube before it takes the time in which MPI starts (0.2 s). Energies agree to 1e-9 of their size, FETI's to 1e-6. Then contact against one linear
-- solve by the same hierarchy, assembly on neither side: frictionless, with Coulomb's friction, and two blocks whose meshes do not match. Then iterations of
-- conjugate gradients a Newton step against the size, ranks, the depth of the contact, friction, contrast, Poisson's ratio and stretched cells: multigrid loses
-- its speed with nearly incompressible material and with cells that are long in one direction, as theory says of point smoothers (Trottenberg, Oosterlee,
-- Schüller 2001, §5.1). Last, on paper, what a billion unknowns need on a thousand ranks. Draws images/scale.png.

local scenes <const> = include "../lib/scale_scenes.lua"
local cube <const>, blocks <const> = scenes.cube, scenes.blocks
local S <const> = dotyk.solver

local function solved(method, scene)
  local s <const> = method:solve(scene)
  assert(s.converged, s.reason)
  return s
end

-- 1. One solution in a process of its own.
local multigrid <const> = S.multigrid{}
local methods <const> = {
  { "coarser meshes", function() return multigrid end },
  { "aggregates", function() return S.multigrid{ levels = "aggregates" } end },
  { "FETI", function(n) return S.feti{ subdomains = { (n + 4) // 8, (n + 4) // 8, (n + 4) // 8 } } end },
  { "factors", function() return S.pdas{} end, most = 40 },
}
local own_process <const> = include "../lib/own_process.lua"
local function one(method, n, ranks, refine) return own_process(arg[0], "one", method, n, ranks or 1, refine or 0) end
if arg[1] == "one" then -- this is such a process
  local method <const>, n <const>, ranks <const>, refine <const> = methods[tonumber(arg[2])][2], tonumber(arg[3]), tonumber(arg[4]), tonumber(arg[5])
  if ranks > 1 then dotyk.ranks(ranks) end
  solved(method(8), cube(4))
  local s
  for _ = 1, tonumber(arg[7] or 1) do
    s = nil
    collectgarbage() -- the next solution takes the memory of this one
    s = solved(method(n), cube(n, { refine = refine, friction = tonumber(arg[6]) }))
  end
  local cg <const>, newton <const> = s.multigrid and s.multigrid.cg or 0, s.multigrid and s.multigrid.newton or 0
  -- The peaks of the other ranks, which are grandchildren of this one.
  local status <const> = io.popen "cd /proc; for p in $(cat $PPID/task/*/children); do for r in $(cat $p/task/*/children); do cat $r/status; done; done 2>&1"
  local others = 0
  for kilobytes in status:read "a":gmatch "VmHWM:%s*(%d+)" do others = others + kilobytes * 1e3 end
  print(("return { unknowns = %d, energy = %.17g, seconds = %.17g, iterate = %.17g, bytes = %.17g, others = %.17g,"):format(s.unknowns, s.energy, s.time.total,
    s.time.iterate, include "../lib/peak_memory.lua"() * 1e9, others), ("multigrid = { cg = %d, newton = %d }, converged = true }"):format(cg, newton))
  return
end

-- 2. Seconds and bytes, and where they cross.
local sizes = {}
for _, n in ipairs(arg) do sizes[#sizes + 1] = tonumber(n) end
if #sizes == 0 then sizes = { 8, 16, 24, 32, 40, 64 } end
table.sort(sizes)
local last <const>, middle <const> = sizes[#sizes], math.min(sizes[#sizes], 32)
io.write "Seconds, megabytes, and kilobytes an unknown\n  n  unknowns"
for k, method in ipairs(methods) do
  local name <const> = ({ "multigrid (meshes)", "multigrid (aggregates)" })[k] or method[1]
  method.seconds, method.bytes = { name = name, x = {}, y = {} }, { name = name, x = {}, y = {} }
  io.write(("%29s"):format(method[1]))
end
local worst, found = 0, {} -- found: what the first method has found, by size
for i, n in ipairs(sizes) do
  local line = ""
  for k, method in ipairs(methods) do
    if n <= (method.most or n) then
      local s <const> = one(k, n)
      if s.seconds < 5 then s.seconds = math.min(s.seconds, one(k, n).seconds) end
      found[n] = found[n] or s
      local differs <const> = math.abs(s.energy / found[n].energy - 1)
      assert(differs < (method[1] == "FETI" and 1e-6 or 1e-9), "the methods do not agree")
      worst = math.max(worst, differs)
      line = line .. ("%9.2f s %6.0f MB %6.2f kB"):format(s.seconds, s.bytes / 1e6, s.bytes / s.unknowns / 1e3)
      for _, what in ipairs{ "seconds", "bytes" } do method[what].x[i], method[what].y[i] = s.unknowns, s[what] end
    end
  end
  io.write(("\n%3d%10d"):format(n, found[n].unknowns), line)
end
print(("\nEnergies differ by %.0e of their size at most"):format(worst))

-- From how many unknowns on b takes less than a, and how much there, by straight lines between logarithms. 0: at all sizes; nil: not at the last that both have.
local function crossing(a, b)
  local x, y, lost = a.y[1] and 0
  for i = 1, math.min(#a.y, #b.y) do
    local gain <const> = math.log(a.y[i] / b.y[i])
    if gain < 0 then
      x = nil
    elseif not x then
      local t <const> = lost / (lost - gain)
      x, y = a.x[i - 1]^(1 - t) * a.x[i]^t, a.y[i - 1]^(1 - t) * a.y[i]^t
    end
    lost = gain
  end
  return x, y
end
local panels <const> = {}
for p, what in ipairs{ "seconds", "bytes" } do
  local series <const>, marks <const> = {}, { name = "crossings", x = {}, y = {}, style = "points" }
  print("\nFewer " .. what)
  for k, method in ipairs(methods) do
    series[k] = method[what]
    for other = math.max(k + 1, 3), 4 do
      local x <const>, y <const> = crossing(methods[other][what], method[what])
      local from <const> = not x and "not at the last size of both" or x == 0 and "at all sizes" or ("from %.0f unknowns on"):format(x)
      print(("%-14s than %-7s  %s"):format(method[1], methods[other][1], from))
      if x and x > 0 then marks.x[#marks.x + 1], marks.y[#marks.y + 1] = x, y end
    end
  end
  if marks.x[1] then series[#series + 1] = marks end
  panels[p] = { y = what, log = "xy", series = series, slopes = { 1, p == 1 and 2 or 4 / 3 } } -- 2 and 4/3: factors of a cube, in theory
end
if #sizes > 1 then
  dotyk.chart{ file = "images/scale.png", title = "A rigid paraboloid on a cube", x = "unknowns", panels = panels, size = { 1000, 1200 } }
end

-- 3. Contact against one linear solve by the same hierarchy.
solved(multigrid, cube(4)) -- MPI starts
local function seconds(s) return s.time.total - s.time.assembly end
print(("\nContact against one linear solve, both by multigrid, n = %d, seconds without assembly"):format(last))
for _, case in ipairs{ { "frictionless", cube, {} }, { "Coulomb 0.3", cube, { friction = 0.3 } }, { "two blocks", blocks, {} } } do
  local linear <const> = solved(multigrid, case[2](last, { linear = true }))
  local s <const> = solved(multigrid, case[2](last, case[3]))
  print(("%-14s linear %7.2f (%d iterations)  contact %7.2f (%d steps, %d iterations)  ratio %.2f"):format(case[1], seconds(linear), linear.multigrid.cg,
    seconds(s), s.multigrid.newton, s.multigrid.cg, seconds(s) / seconds(linear)))
end

-- 4. What iterations grow with: of all linear systems, a step.
print "\nIterations of conjugate gradients (Newton's steps)"
local function row(what, values, solution, scene)
  local line = ("%-28s"):format(what)
  for _, value in ipairs(values) do
    local ok <const>, s = pcall(solution, scene and scene(value) or value)
    line = line .. ("%8s: "):format(value) .. (ok and s.converged and ("%3d (%d)"):format(s.multigrid.cg, s.multigrid.newton) or "   fails")
  end
  print(line)
end
local function alone(scene) return multigrid:solve(scene) end
local n <const> = math.min(last, 16)
row("cells along an edge", sizes, function(cells) return found[cells] end)
row(("ranks, %d cells"):format(middle), { 1, 2, 4 }, function(ranks) return one(1, middle, ranks) end)
row("depth of the paraboloid", { 0.002, 0.02, 0.1, 0.3 }, alone, function(depth) return cube(n, { depth = depth }) end)
row("Coulomb's coefficient", { 0.1, 0.3, 0.6, 1.0 }, alone, function(mu) return cube(n, { friction = mu }) end)
row("contrast of two blocks", { 1, 10, 100, 1000 }, alone, function(contrast) return blocks(n, { contrast = contrast }) end)
row("Poisson's ratio", { 0.3, 0.45, 0.49, 0.499 }, alone, function(nu) return cube(n, { nu = nu }) end)
row("height of the cells", { 1, 2, 4, 8 }, alone, function(stretch) return cube(n, { height = stretch }) end)

-- 5. A billion unknowns on a thousand ranks, on paper: P1 in space, a cube, what one process needs measured here, what a network takes assumed.
do
  local s <const> = found[last]
  local unknowns <const>, its <const> = s.unknowns, s.multigrid.cg
  local iteration <const> = s.iterate / its / unknowns
  local ranks <const>, all <const> = 1000, 1e9
  local own <const> = all / ranks
  local edge <const> = (own / 3)^(1 / 3)  -- nodes
  local levels <const> = math.ceil(math.log(all / 1e4, 8))  -- that are shared. The next one has 10 000 unknowns at most, and each rank has it whole
  local whole <const> = all / 8^levels
  -- A level has an eighth of the unknowns of the finer one. Each sends its faces twice in a sweep, and in an interpolation up and down: 6 times on the two finest
  -- levels, 10 times below, where there are four sweeps. The finest level sends them once more for a product.
  local neighbours <const>, latency <const>, bandwidth <const> = 26, 2e-6, 1e10
  local flops <const> = 45 * 2 * (1 + 2 * 8 / 7)  -- 45 entries a row: a product on the finest level, two sweeps; without interpolation and borders
  local halo <const> = 6 * edge^2 * 3 * 8 * (7 + 6 / 4 + 10 / 16 * 4 / 3)
  local messages <const> = neighbours * (7 + 6 + 10 * (levels - 2))
  local rounds <const> = math.ceil(math.log(ranks, 2))
  local sums <const>, gathered <const> = 3 * rounds * latency, rounds * latency + 8 * whole / bandwidth
  local network <const> = messages * latency + halo / bandwidth + sums + gathered
  local bytes <const> = s.bytes / unknowns
  print(("\nA billion unknowns on %d ranks, from the cube of %d³ cells (%d unknowns)"):format(ranks, last, unknowns))
  print(("memory            %8.2f GB a rank, %.2f kB an unknown, as the process here had at most"):format(own * bytes / 1e9, bytes / 1e3))
  print(("arithmetic        %8.2f Gflop an iteration and rank, %.2f s as fast as here (%.1f Gflop/s)"):format(own * flops / 1e9, own * iteration,
    flops / iteration / 1e9))
  print(("messages          %8d an iteration and rank on %d levels, %.1f MB; %.4f s at %g µs a message and %g GB/s (assumed)"):format(messages, levels, halo / 1e6,
    network, latency * 1e6, bandwidth / 1e9))
  print(("coarse levels     %8.0f unknowns and fewer, whole on each rank: %.4f s an iteration, as fast as here"):format(whole, whole * iteration))
  print(("iterations        %8d in %d steps, if they stay as here: %.0f s"):format(its, s.multigrid.newton, its * (own * iteration + whole * iteration + network)))
  print(("contact           %8.0f nodes of the top, whose rows rank 0 makes and follows alone, while the others wait"):format((all / 3)^(2 / 3)))
  local function surplus(refine) -- of rank 0 over the other one of two
    local s <const> = one(1, last, 2, refine)
    assert(s.others > 0, "the other rank is not found")
    return (s.bytes - s.others) / 1e9
  end
  local without <const>, with <const> = surplus(0), surplus(last < 32 and 1 or 2)
  print "What breaks first"
  print(("rank 0            %8.0f GB more than the others, if that grows as the unknowns do: it has the whole mesh. Here %.3f GB on two ranks"):format(
    without * all / unknowns, without))
  local numbers <const> = 4 * all * 8 / 7 / 1e9 -- an int for each row of all levels
  print(("with refine       %8.1f GB more: %.1f, if that grows as the boundary does (here %.3f), and %.1f of numbers of all unknowns"):format(
    with * (all / unknowns)^(2 / 3) + numbers, with * (all / unknowns)^(2 / 3), with, numbers))
  print(("each rank         %8.1f GB more: the product for a coarser level keeps 12 bytes for each of its nodes, on every rank"):format(12 * all / 3 / 7 / 1e9))
  print(("then latency      %8.0f nodes a rank on the coarsest level that is shared, which sends more messages than the finest"):format(8 * whole / 3 / ranks))
end
