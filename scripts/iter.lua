-- Many systems with one stiffness: the sensitivities of a cantilever's displacement (Vondrák, ODAM 2001, tables 2 and 3).
--
--   ./dotyk scripts/iter.lua [CELLS]
--
-- A cantilever of 9 × 9 × 34 hexahedra (10 × 10 × 35 nodes) with a lateral load at its end: ITER is slender, ITER2 four times as
-- wide. Six design variables: the height of its section at the fixed end, in the middle and at the free end (a quadratic
-- Bernstein profile along the beam), and the same of its width. First K u = f (Anal.), then K ∂u/∂α_i = -(∂K/∂α_i) u; the
-- derivative of K is exact, the end's total force stays. Iterations and seconds of Cholesky, conjugate gradients alone (CG),
-- started from the conjugate directions of the first system (SCG) and from its lowest Lanczos eigenvectors (CGLAN), and with all
-- six sensitivities at once (block CG), with SSOR by Eisenstat's trick and with incomplete Cholesky. The line "paper" has the
-- sums of the sensitivities there, four of them (two were zero), of variables of its own.
-- CELLS: across the section, 9. What the chart says: with CG each system costs what the first did; once the first is solved, SCG
-- and CGLAN have little left to do, the more so the slenderer the beam. At this size a Cholesky factor beats them all. images/iter.png.

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
  local r <const> = dotyk.repeated_systems{ scene = scene, velocities = velocities, method = method[2], tol = tolerance,
    preconditioner = method[3] }
  assert(r.converged)
  local sums <const> = { sensitivities = 0, seconds = 0 } -- of the sensitivities
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
local function table_of(name, width, paper)
  local scene <const>, velocities <const> = beam(width)
  local results <const>, sums <const>, worst = {}, {}, 0
  for k, method in ipairs(methods) do
    results[k], sums[k] = solve(scene, velocities, method)
    for system = 1, #results[k].systems do worst = math.max(worst, distance(results[k], results[1], system)) end
  end
  print(("\n%s, %g x %g x %g, %d unknowns: seconds, iterations"):format(name, length, width, width, results[1].unknowns))
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
  if cells == 9 then line("paper", each(function(k) return paper[k] and cell(paper[k][1], paper[k][2]) or "" end)) end
  line("MB", each(function(k) return cell(results[k].bytes / 1e6) end))
  line("kept", each(function(k) return ("%8d     "):format(results[k].kept) end))
  print(("solutions within %.0e of Cholesky's"):format(worst))
  assert(worst < 1e-4)
  return sums, results
end
print "Setup: factor or preconditioner. MB: of factor, preconditioner and vectors, at their greatest; kept: vectors for a next system."
print "Sum1: all; Sum2: without setup; Sum3: the sensitivities. Block: its steps are common to the six."
local slender <const>, slender_results <const> = table_of("ITER", 1,
  { { 50 }, { 172, 823 }, { 237, 668 }, { 35, 42 }, { 31, 31 }, { 28, 112 }, { 42, 105 } })
local _ <const>, wide_results <const> = table_of("ITER2", 4,
  { { 50 }, { 64, 301 }, { 55, 151 }, { 21, 69 }, { 17, 31 }, { 20, 72 }, { 25, 63 } })

-- 3. What earlier systems are worth.
print ""
for k, method in ipairs(methods) do
  if method[2] == "scg" or method[2] == "cglan" then
    local alone <const> = method[3] == "ssor" and 2 or 3
    local share <const> = slender[k].sensitivities / slender[alone].sensitivities
    print(("ITER, %-10s: %.3f of the iterations of CG alone for the sensitivities"):format(method[1], share))
    assert(share <= 1 / 3, method[1])
  end
end

-- 4. The chart: what a number of systems has cost. Block CG and Cholesky solve the last six together.
local function curves(results, cost)
  local series <const> = {}
  for k, method in ipairs(methods) do
    local together <const> = method[2] == "block_cg" or method[2] == "cholesky"
    local spent <const> = cost(results[k], together)
    local x <const> = together and { 1, #spent } or { 1, 2, 3, 4, 5, 6, 7 }
    for i, system in ipairs(x) do spent[i] = spent[system] end
    series[#series + 1] = { name = method[1], x = x, y = table.move(spent, 1, #x, 1, {}), twin = method[3] == "ic" }
  end
  table.insert(series, table.remove(series, 1)) -- Cholesky last: colours are the same without it
  return series
end
local function seconds(r)
  local sums <const>, sum = {}, r.setup_seconds
  for system, s in ipairs(r.systems) do
    sum = sum + s.seconds
    sums[system] = sum
  end
  return sums
end
local function iterations(r, together)
  local sums <const>, sum = {}, 0
  for system, s in ipairs(r.systems) do
    sum = (together and system > 2) and math.max(sum, sums[1] + s.iterations) or sum + s.iterations
    sums[system] = sum
  end
  return sums
end
local panels <const> = {}
for _, beam in ipairs{ { "ITER, 10 × 1 × 1", slender_results }, { "ITER2, 10 × 4 × 4", wide_results } } do
  panels[#panels + 1] = { title = beam[1], y = "iterations so far", series = curves(beam[2], iterations) }
  panels[#panels + 1] = { y = "seconds so far", series = curves(beam[2], seconds) }
end
for _, panel in ipairs{ panels[1], panels[3] } do table.remove(panel.series) end -- Cholesky has no iterations
dotyk.chart{ file = "images/iter.png", x = "systems solved: the displacement, then its six sensitivities", panels = panels, size = { 1000, 1600 } }
