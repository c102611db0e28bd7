-- Many systems with one stiffness: the sensitivities of a cantilever's displacement (Vondrák, ODAM 2001, tables 2 and 3).
--
--   ./dotyk scripts/papers/vondrak/iter.lua [CELLS]
--
-- A cantilever of 9 × 9 × 34 hexahedra (10 × 10 × 35 nodes) with a lateral load at its end: ITER is slender, ITER2 four times as
-- wide. Six design variables: the height of its section at the fixed end, in the middle and at the free end (a quadratic
-- Bernstein profile along the beam), and the same of its width. First K u = f (Anal.), then K ∂u/∂α_i = ∂f/∂α_i − (∂K/∂α_i) u;
-- both derivatives are exact, the end's traction stays. Iterations and seconds of Cholesky, conjugate gradients alone (CG),
-- started from the conjugate directions of the first system (SCG) and from its lowest Lanczos eigenvectors (CGLAN), and with all
-- six sensitivities at once (block CG), with SSOR by Eisenstat's trick and with incomplete Cholesky. Below, the paper's own
-- tables, of variables of its own; two of them moved nothing.
-- What the tables show. With CG each system costs about as many iterations as the first. SCG needs 0.07 of CG's for ITER's
-- sensitivities and a quarter for ITER2's: the slender beam's first system takes more directions, which span more. CGLAN, with
-- 10 to 14 vectors, needs 0.26 to 0.31 for either beam. SCG pays in the first system, for conjugation and memory, more than
-- CGLAN; block CG takes fewest iterations, of six products each. For seven systems of this size a Cholesky factor costs least
-- time; where one system is all there is, CG may.
-- The order of methods. Work is counted in products with K. The paper's counts of iterations and its memory for the factor give its
-- order by seconds but for one or two of 21 pairs. Ours is another for two reasons. By its work the factor is no better here than there,
-- but dense kernels do an operation of it in a fraction of the time of one of CG; in the paper an operation of the solves with the
-- factor takes 4.5 times as long as one of CG. And SCG and CGLAN orthogonalise in full here, for which the paper's times of the first
-- system leave no room: for ITER's 272 directions this costs more products than the iterations of all seven systems.
-- CELLS: across the section, 9. Draws images/iter.png.

local cells <const> = tonumber(arg[1]) or 9
local length <const>, tolerance <const> = 10, 1e-6

-- 1. The beams, and how the variables move their points.
local function beam(width)
  local body <const> = dotyk.body{ name = "beam", material = dotyk.material{ E = 2.1e5, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { length, width, width }, element = "Q1",
                           cells = { (34 * cells + 4) // 9, cells, cells } } }
  body:part"left":fix()
  body:part"right":load{ 0, 0, -1 / width^2 }
  local velocities <const> = {}
  for _, bernstein in ipairs{ function(t) return (1 - t)^2 end, function(t) return 2 * t * (1 - t) end, function(t) return t^2 end } do
    velocities[#velocities + 1] = function(x, y, z) return 0, 0, (z - width / 2) * bernstein(x / length) end
    velocities[#velocities + 1] = function(x, y, z) return 0, (y - width / 2) * bernstein(x / length), 0 end
  end
  return dotyk.scene{ body }, velocities
end

local methods <const> = { { "LL'", "cholesky" } }
for _, method in ipairs{ { "CG", "cg" }, { "SCG", "scg" }, { "CGLAN", "cglan" }, { "block", "block_cg" } } do
  for _, preconditioner in ipairs{ "ssor", "ic" } do
    methods[#methods + 1] = { ("%s %s"):format(method[1], preconditioner == "ic" and "IC" or "SSOR"), method[2], preconditioner }
  end
end

local function solve(scene, velocities, method)
  local start <const> = os.clock()
  local r <const> = dotyk.repeated_systems{ scene = scene, velocities = velocities, method = method[2], tol = tolerance,
    preconditioner = method[3] }
  assert(r.converged)
  local sums <const> = { sensitivities = 0, seconds = 0, total = os.clock() - start } -- the first two of the sensitivities
  for k = 2, #r.systems do
    sums.sensitivities = sums.sensitivities + r.systems[k].iterations
    sums.seconds = sums.seconds + r.systems[k].seconds
  end
  if method[2] == "block_cg" then -- its steps are shared
    sums.sensitivities = 0
    for k = 2, #r.systems do sums.sensitivities = math.max(sums.sensitivities, r.systems[k].iterations) end
  end
  return r, sums
end

-- Greatest distance of nodal values from the direct solution's, relative to their greatest.
local function distance(r, direct, system)
  local off, size = 0, 0
  local exact <const> = direct:nodes(system)
  for k, node in ipairs(r:nodes(system)) do
    for i = 4, 6 do off, size = math.max(off, math.abs(node[i] - exact[k][i])), math.max(size, math.abs(exact[k][i])) end
  end
  return off / size
end

-- 2. The tables.
local function line(name, entries) print(("%-7s"):format(name) .. table.concat(entries)) end
local function table_of(name, width)
  local scene <const>, velocities <const> = beam(width)
  local results <const>, sums <const>, worst = {}, {}, 0
  for k, method in ipairs(methods) do
    results[k], sums[k] = solve(scene, velocities, method)
    for system = 1, #results[k].systems do worst = math.max(worst, distance(results[k], results[1], system)) end
  end
  local across <const>, along <const> = cells + 1, (34 * cells + 4) // 9 + 1
  print(("\n%s, %g x %g x %g, %d components, %d of them fixed: seconds, iterations"):format(name, length, width, width,
    3 * along * across^2, 3 * along * across^2 - results[1].unknowns))
  local function each(entry)
    local entries <const> = {}
    for k in ipairs(methods) do entries[k] = entry(k) end
    return entries
  end
  local function cell(seconds, iterations) return ("%8.2f %4s"):format(seconds, iterations or "") end
  line("", each(function(k) return ("   %-10s"):format(methods[k][1]) end))
  line("setup", each(function(k) return cell(results[k].setup_seconds) end))
  for system = 1, #results[1].systems do
    line(system == 1 and "Anal." or tostring(system - 1), each(function(k)
      local s <const> = results[k].systems[system]
      return cell(s.seconds, k > 1 and s.iterations)
    end))
  end
  local function iterations(k) return k > 1 and results[k].systems[1].iterations + sums[k].sensitivities end
  local function seconds(k) return results[k].systems[1].seconds + sums[k].seconds end
  line("Sum1", each(function(k) return cell(results[k].setup_seconds + seconds(k), iterations(k)) end))
  line("Sum2", each(function(k) return cell(seconds(k), iterations(k)) end))
  line("Sum3", each(function(k) return cell(sums[k].seconds, k > 1 and sums[k].sensitivities) end))
  line("Total", each(function(k) return cell(sums[k].total) end))
  line("MB", each(function(k) return cell(results[k].bytes / 1e6) end))
  line("kept", each(function(k) return ("%8d     "):format(results[k].kept) end))
  print(("solutions within %.0e of Cholesky's"):format(worst))
  assert(worst < 1e-4)
  return sums, results
end
print "Setup: factor or preconditioner. MB: of factor, preconditioner and vectors, at their greatest; kept: vectors for a next system."
print "Sum1: all; Sum2: without setup; Sum3: the sensitivities; Total: processor's seconds of all with the assembly. Block: its steps are common to the six."
local slender <const>, slender_results <const> = table_of("ITER", 1)
local wide <const>, wide_results <const> = table_of("ITER2", 4)

-- The paper's: seconds of LL', then seconds and iterations of CG, SCG, CGLAN, each with SSOR and IC.
local function paper(name, rows)
  print(("\n%s, the paper's tables: seconds, iterations; 1 to 6 are its own variables"):format(name))
  line("", { "   LL'          CG SSOR      CG IC        SCG SSOR     SCG IC       CGLAN SSOR   CGLAN IC" })
  for k, row in ipairs{ "Anal.", "1", "2", "3", "4", "5", "6", "Sum1", "Sum2", "Sum3", "Total" } do
    local entries <const> = { ("%8d     "):format(rows[k][1]) }
    for i = 2, #rows[k], 2 do entries[#entries + 1] = ("%8d %4s"):format(rows[k][i], rows[k][i + 1] or "") end
    line(row, entries)
  end
  return rows
end
-- Work in products with K, 2 operations an entry. `run`: method, unknowns, entries of K and of the factor, iterations of the first system
-- and of all later ones, number of these, vectors kept by CGLAN, orthogonalised in full or not. A step of CG costs one product by
-- Eisenstat's trick, two with IC. A factor of c_j entries in column j costs Σ c_j², at least (Σ c_j)²/n, which is taken, and 4 Σ c_j a solve;
-- Σ c_j is estimated by its memory. A start from m vectors costs 6 n m, full orthogonalisation of m vectors 2 n m², k combinations of them 2 n m k.
local function work(run)
  local kind <const>, n <const>, m <const> = run.method[2], run.n, run.first
  if kind == "cholesky" then return (run.factor^2 / n + 4 * run.factor * (run.later + 1)) / (2 * run.entries) end
  local vectors <const> = kind == "scg" and m or kind == "cglan" and run.kept or 0
  local operations = 6 * n * vectors * run.later + (kind == "cglan" and 2 * n * m * vectors or 0)
  if run.full and vectors > 0 then operations = operations + 2 * n * m^2 end
  return (run.first + run.rest) * (run.method[3] == "ic" and 2 or 1) + operations / (2 * run.entries)
end
local function entries(along, across) return 9 * (3 * along - 2) * (3 * across - 2)^2 end
local function ranked(values)
  local texts <const> = {}
  for k, value in ipairs(values) do
    local rank = 1
    for _, other in ipairs(values) do if other < value then rank = rank + 1 end end
    texts[k] = ("%11.4g (%d)"):format(value, rank)
  end
  return texts
end
local function order(name, results, sums, rows)
  local seconds <const>, ours <const> = {}, {}
  local n <const> = results[1].unknowns
  for k = 1, 7 do
    seconds[k] = sums[k].total
    ours[k] = work{ method = methods[k], n = n, entries = entries((34 * cells + 4) // 9, cells + 1), factor = results[1].bytes / 8,
      first = results[k].systems[1].iterations, rest = sums[k].sensitivities, later = 6, kept = results[k].kept, full = true }
  end
  print(("\n%s: order of methods (rank)"):format(name))
  local head <const> = {}
  for k = 1, 7 do head[k] = ("%15s"):format(methods[k][1]) end
  local function row(label, values) print(("%-34s"):format(label) .. table.concat(values)) end
  row("", head)
  if rows then -- the paper's table: n = 10500, a factor of 24.899 MB, two of the six variables without work, at least 10 vectors of CGLAN
    local printed <const>, counted <const>, factor <const> = {}, {}, 24.899e6 / 8
    for k = 1, 7 do
      printed[k] = rows[9][k == 1 and 1 or 2 * k - 2]
      counted[k] = work{ method = methods[k], n = 10500, entries = entries(35, 10), factor = factor, first = k > 1 and rows[1][2 * k - 1],
        rest = k > 1 and rows[10][2 * k - 1], later = k == 1 and 6 or 4, kept = 10 }
    end
    row("paper, seconds (Sum2)", ranked(printed))
    row("paper, work from its counts", ranked(counted))
    local inverted = 0
    for k = 1, 7 do for l = 1, k - 1 do if (printed[k] - printed[l]) * (counted[k] - counted[l]) < 0 then inverted = inverted + 1 end end end
    print(("  of 21 pairs %d are in another order by work than by seconds"):format(inverted))
    assert(inverted <= 2)
    local product <const> = 2 * entries(35, 10)
    local step <const> = printed[2] / counted[2]
    local solve <const> = rows[10][1] / 6 / (4 * factor / product) / step
    print(("  an operation takes, relative to one of CG with SSOR: of the factorisation %.2f, of a solve with the factor %.1f"):format(
      rows[1][1] / (factor^2 / 10500 / product) / step, solve))
    assert(solve > 4)
  end
  row("here, processor's seconds, assembly too", ranked(seconds))
  row("here, work", ranked(ours))
  local product <const>, factor <const> = 2 * entries((34 * cells + 4) // 9, cells + 1), results[1].bytes / 8
  local step <const> = (results[2].systems[1].seconds + sums[2].seconds) / ours[2]
  local factorisation <const>, solve <const> = results[1].setup_seconds / (factor^2 / n / product) / step, sums[1].seconds / 6 / (4 * factor / product) / step
  print(("  an operation takes, relative to one of CG with SSOR: of the factorisation %.2f, of a solve with the factor %.2f"):format(factorisation, solve))
  local m <const> = results[4].systems[1].iterations
  print(("  full orthogonalisation of SCG SSOR's %d directions costs %.0f products, its iterations %d"):format(m, 2 * n * m^2 / product, m + sums[4].sensitivities))
  assert(cells < 9 or factorisation < 1 and solve < 1)
  assert(not rows or name ~= "ITER" or 2 * n * m^2 / product > m + sums[4].sensitivities)
end

local none <const> = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }
local function row(cholesky, others) return table.move(others, 1, #others, 2, { cholesky }) end
local function total(all)
  local entries <const> = { all[1] }
  for i = 2, 7 do entries[2 * i - 2], entries[2 * i - 1] = all[i], false end
  return entries
end
local slender_paper, wide_paper
if cells == 9 then
  slender_paper = paper("ITER", { row(83, { 55, 251, 63, 175, 60, 251, 65, 175, 87, 251, 83, 175 }),
    row(8, { 39, 189, 57, 161, 8, 10, 7, 8, 4, 13, 7, 16 }), row(9, { 46, 217, 62, 173, 9, 11, 8, 8, 9, 37, 13, 34 }),
    row(8, { 41, 200, 57, 161, 9, 10, 8, 8, 6, 23, 8, 19 }), row(8, { 46, 217, 61, 173, 9, 11, 8, 7, 9, 39, 14, 36 }),
    row(9, none), row(8, none),
    row(133, { 227, 1074, 324, 843, 95, 293, 120, 206, 115, 363, 149, 280 }),
    row(133, { 227, 1074, 300, 843, 95, 293, 96, 206, 115, 363, 125, 280 }),
    row(50, { 172, 823, 237, 668, 35, 42, 31, 31, 28, 112, 42, 105 }), total{ 288, 329, 425, 211, 239, 221, 259 } })
  wide_paper = paper("ITER2", { row(83, { 19, 86, 16, 44, 20, 86, 18, 44, 29, 86, 22, 44 }),
    row(8, { 17, 80, 15, 42, 5, 17, 4, 8, 5, 18, 6, 13 }), row(9, { 17, 80, 12, 32, 5, 15, 4, 7, 5, 17, 5, 13 }),
    row(8, { 13, 58, 13, 34, 5, 17, 4, 7, 5, 17, 5, 13 }), row(8, { 17, 83, 15, 43, 6, 20, 5, 9, 5, 20, 9, 24 }),
    row(9, none), row(8, none),
    row(133, { 83, 387, 95, 195, 41, 155, 59, 75, 49, 158, 71, 107 }),
    row(133, { 83, 387, 71, 195, 41, 155, 35, 75, 49, 158, 47, 107 }),
    row(50, { 64, 301, 55, 151, 21, 69, 17, 31, 20, 72, 25, 63 }), total{ 288, 185, 200, 145, 165, 152, 177 } })
end

order("ITER", slender_results, slender, slender_paper)
order("ITER2", wide_results, wide, wide_paper)

-- 3. What earlier systems are worth.
print ""
for k, method in ipairs(methods) do
  if method[2] == "scg" or method[2] == "cglan" then
    local alone <const> = method[3] == "ssor" and 2 or 3
    local function share(sums) return sums[k].sensitivities / sums[alone].sensitivities end
    print(("%-10s: %.3f of the iterations of CG alone for the sensitivities of ITER, %.3f for those of ITER2"):format(method[1],
      share(slender), share(wide)))
    assert(share(slender) <= 1 / 3, method[1])
  end
end

-- 4. The chart: what a number of systems has cost. Block CG solves the last six together; Cholesky has no iterations.
local function curves(results, named)
  local series <const> = {}
  for k = 2, #methods do
    local method <const> = methods[k]
    local x, y, sum = {}, {}, 0
    for system, s in ipairs(results[k].systems) do
      sum = (method[2] == "block_cg" and system > 2) and math.max(sum, y[1] + s.iterations) or sum + s.iterations
      x[system], y[system] = system, sum
    end
    if method[2] == "block_cg" then x, y = { 1, #y }, { y[1], y[#y] } end
    series[#series + 1] = { name = named and method[3] == "ssor" and (method[1]:gsub(" SSOR", "")) or nil, x = x, y = y, twin = method[3] == "ic" }
  end
  return series
end
dotyk.chart{ file = "images/iter.png", title = "Solid: SSOR, dashed: incomplete Cholesky", x = "systems solved", size = { 1000, 1000 }, panels = {
  { title = "Slender beam, 10 × 1 × 1", y = "iterations so far", log = "y", x_range = { 0.75, 7.25 }, series = curves(slender_results, true) },
  { title = "Thick beam, 10 × 4 × 4", y = "iterations so far", log = "y", x_range = { 0.75, 7.25 }, series = curves(wide_results) } } }
