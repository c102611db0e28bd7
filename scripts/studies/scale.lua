-- How far each method carries: seconds and memory against unknowns, and what multigrid's iterations grow with.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/scale.lua [N…]
--
-- S3, a rigid paraboloid on a cube of N³ cells of six tetrahedra: by factors (pdas), by FETI on cubes of 8³ cells, by multigrid with levels of
-- aggregates (algebraic) and of coarser meshes (geometric). Then contact against one linear solve by the same hierarchy, assembly on neither side:
-- frictionless, with Coulomb's friction, and two blocks whose meshes do not match. Then iterations of conjugate gradients a Newton step against the
-- size, the contact, friction, contrast, Poisson's ratio and stretched cells: multigrid loses its speed with nearly incompressible material and with cells
-- that are long in one direction, as theory says of point smoothers (Trottenberg, Oosterlee, Schüller 2001, §5.1). Energies agree to 1e-9. Last, on paper,
-- what a billion unknowns need on a thousand ranks.

local sizes = {}
for _, n in ipairs(arg) do sizes[#sizes + 1] = tonumber(n) end
if #sizes == 0 then sizes = { 8, 16, 24, 32 } end
local last <const> = sizes[#sizes]
local S <const> = dotyk.solver

-- 1. Scenes.
local scenes <const> = include "../lib/scale_scenes.lua"
local cube <const>, blocks <const> = scenes.cube, scenes.blocks

local function solved(method, scene)
  local s <const> = method:solve(scene)
  assert(s.converged, s.reason)
  return s
end

-- 2. Seconds and memory.
local multigrid <const> = S.multigrid{}
local methods <const> = {
  { "factors", function() return S.pdas{} end, most = 32 },
  { "FETI", function(n) return S.feti{ subdomains = { n // 8, n // 8, n // 8 } } end },
  { "aggregates", function() return S.multigrid{ levels = "aggregates" } end },
  { "coarser meshes", function() return multigrid end },
}
for _, method in ipairs(methods) do method.series = { name = method[1], x = {}, y = {} } end
print "Seconds, and megabytes of what solves linear systems"
do
  local head = "  n  unknowns"
  for _, method in ipairs(methods) do head = head .. ("%24s"):format(method[1]) end
  print(head)
end
for _, n in ipairs(sizes) do
  local line, energy, unknowns = "", nil, 0
  for _, method in ipairs(methods) do
    if n <= (method.most or math.huge) and n >= 8 then
      local s <const> = solved(method[2](n), cube(n))
      energy, unknowns = energy or s.energy, s.unknowns
      assert(math.abs(s.energy / energy - 1) < (method[1] == "FETI" and 1e-6 or 1e-9), "the methods do not agree")
      line = line .. ("%13.2f s %6.0f MB"):format(s.time.total, s.factor_bytes / 1e6)
      table.insert(method.series.x, s.unknowns)
      table.insert(method.series.y, s.time.total)
    else
      line = line .. (" "):rep(24)
    end
  end
  print(("%3d%10d"):format(n, unknowns) .. line)
end
if #sizes > 1 then
  local series = {}
  for _, method in ipairs(methods) do series[#series + 1] = method.series end
  dotyk.chart{ file = "images/scale.png", title = "A rigid paraboloid on a cube", x = "unknowns", y = "seconds", log = "xy", series = series, slopes = { 1, 2 } }
end

-- 3. Contact against one linear solve by the same hierarchy.
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
local function row(what, values, scene)
  local line = ("%-28s"):format(what)
  for _, value in ipairs(values) do
    local ok <const>, s = pcall(multigrid.solve, multigrid, scene(value))
    line = line .. ("%8s: "):format(value) .. (ok and s.converged and ("%3d (%d)"):format(s.multigrid.cg, s.multigrid.newton) or "   fails")
  end
  print(line)
end
local n <const> = math.min(last, 16)
row("cells along an edge", sizes, cube)
row("depth of the paraboloid", { 0.002, 0.02, 0.1, 0.3 }, function(depth) return cube(n, { depth = depth }) end)
row("Coulomb's coefficient", { 0.1, 0.3, 0.6, 1.0 }, function(mu) return cube(n, { friction = mu }) end)
row("contrast of two blocks", { 1, 10, 100, 1000 }, function(contrast) return blocks(n, { contrast = contrast }) end)
row("Poisson's ratio", { 0.3, 0.45, 0.49, 0.499 }, function(nu) return cube(n, { nu = nu }) end)
row("height of the cells", { 1, 2, 4, 8 }, function(stretch) return cube(n, { height = stretch }) end)

-- 5. A billion unknowns on a thousand ranks, on paper: P1 in space, a cube, what one process needs measured here, what a network takes assumed.
do
  local s <const> = solved(multigrid, cube(last))
  local unknowns <const>, its <const> = s.unknowns, s.multigrid.cg
  local iteration <const> = s.time.iterate / its / unknowns
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
  local bytes <const> = include "../lib/peak_memory.lua"() * 1e9 / unknowns
  print(("\nA billion unknowns on %d ranks, from the cube of %d³ cells (%d unknowns)"):format(ranks, last, unknowns))
  print(("memory            %8.1f GB a rank at most, %.2f kB an unknown, by the peak of this process, which has run the other methods too"):format(own * bytes / 1e9, bytes / 1e3))
  print(("arithmetic        %8.2f Gflop an iteration and rank, %.2f s as fast as here (%.1f Gflop/s, bound by memory)"):format(own * flops / 1e9, own * iteration,
    flops / iteration / 1e9))
  print(("messages          %8d an iteration and rank on %d levels, %.1f MB; %.4f s at %g µs a message and %g GB/s (assumed)"):format(messages, levels, halo / 1e6,
    network, latency * 1e6, bandwidth / 1e9))
  print(("coarse levels     %8.0f unknowns and fewer, whole on each rank: %.4f s an iteration, as fast as here"):format(whole, whole * iteration))
  print(("iterations        %8d in %d steps, if they stay as here: %.0f s"):format(its, s.multigrid.newton, its * (own * iteration + whole * iteration + network)))
  print(("contact           %8.0f of %d ranks have nodes of the top; their share of rows decides about the other ranks' waiting"):format(ranks^(2 / 3), ranks))
  local layers <const> = 3 * 6 / (all / 3)^(1 / 3) -- of nodes at the boundary, a part of all nodes
  print(("What breaks first: without refine rank 0, which has the mesh and the numbers of all unknowns, some 90 bytes an unknown more than the others (measured on two ranks "
    .. "at 9.9e6), 190 with two bodies that do not match (at 9.6e6): 90 and 190 GB. With refine it has three layers of nodes at the boundary, %.1f %% of all, at some 180 bytes an "
    .. "unknown (21 of all at 9.9e6): %.1f GB. Then latency: on the coarsest level that is shared a rank has %.0f nodes, but sends more messages than on the finest"):format(
    100 * layers, layers * all * 180 / 1e9, 8 * whole / 3 / ranks))
end
