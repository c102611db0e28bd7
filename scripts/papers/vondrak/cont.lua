-- Shape optimisation of two bodies in contact: exact derivatives against differences (Vondrák, ODAM 2001, problem "cont").
--
--   ./dotyk scripts/papers/vondrak/cont.lua
--
-- Two bodies of 41 × 21 nodes, E = 2.1e5 and 1e5, ν = 0.3, load -1000 per length. The paper's drawing is lost; here the upper body is
-- clamped at its left side, a gap above the lower one, and loaded on its top. Six control points of its lower edge (a cubic B-spline)
-- move vertically, from touching the other body to 0.25 upwards; the volume must not grow. The compliance is to be least, by sequential
-- linear programming. Forward differences solve six more scenes for each design, with conjugate gradients to 1e-6 as in the paper. These
-- supports leave 3320 unknowns; scripts/papers/vondrak/cont_table.lua has the paper's 3298.
-- Compliance is concave in the gap (its derivative is the pressure), so that designs end in corners of what is allowed, of which there are
-- several: where a run ends depends on its first steps. So every kind of derivative starts with seven trust regions, and the sums count;
-- figures show the best design. Lengths, forces per length: any consistent units.

local gap <const> = 0.025
local short <const> = arg[1] == "short"

-- 1. The scene.
local cont <const> = include "../../lib/two_bodies.lua"{
  gap = gap, height = 0.75, fix = { upper_left = "xy", lower_bottom = "xy" } }
local upper <const>, contact <const>, shape <const>, paper <const> = cont.upper, cont.contact, cont.shape, cont.paper
local cg <const> = dotyk.solver.projected_cg{ tol = 1e-6 }

-- 2. Derivatives of the vertical displacement at the first design: what differences leave of them. Small steps lose what the solves
--    are not precise in, large ones what lies between.
do
  local function sensitivities(method, h) -- at the nodes along the upper body's middle, a list a variable
    local designs <const> = shape(nil, method)
    local lists <const>, first <const> = {}, designs:design()
    for i = 1, designs.variables do
      local alpha <const>, list <const> = { 0, 0, 0, 0, 0, 0 }, {}
      alpha[i] = h
      local beside <const> = h and designs:design(alpha)
      for k = 0, 40 do
        local _, uy <const> = first:displacement(upper, k / 20, 0.375 + gap)
        local _, there = uy, uy
        if h then _, there = beside:displacement(upper, k / 20, 0.375 + gap) end
        list[k] = h and (there.value - uy.value) / h or uy.gradient[i]
      end
      lists[i] = list
    end
    return lists, first
  end
  local exact <const>, first <const> = sensitivities(dotyk.solver.pdas{})
  print(("first design: %d unknowns, %d contact nodes"):format(first.solution.unknowns, first.solution.rows))
  print "derivatives of the upper body's vertical displacement by each variable: greatest error of differences, relative to the greatest derivative"
  local function row(name, lists)
    local cells <const> = {}
    for i, list in ipairs(lists) do
      local off, most = 0, 0
      for k = 0, 40 do off, most = math.max(off, math.abs(list[k] - exact[i][k])), math.max(most, math.abs(exact[i][k])) end
      cells[i] = ("%.0e"):format(off / most)
    end
    print(("  %-36s %s"):format(name, table.concat(cells, "  ")))
    return tonumber(cells[6])
  end
  row("exact, solved by CG to 1e-6", sensitivities(cg))
  for _, h in ipairs{ "2.5e-2", "2.5e-3", "2.5e-5" } do row(("h = %s, solved by CG to 1e-6"):format(h), sensitivities(cg, tonumber(h))) end
  assert(row("h = 2.5e-5, solved directly", sensitivities(dotyk.solver.pdas{}, 2.5e-5)) < 1e-3)
end

-- 3. The optimisation, from seven radii of the first trust region.
local kinds <const> = { { name = "exact" }, { name = "h = 2.5 × 10⁻²", h = 2.5e-2 }, { name = "h = 2.5 × 10⁻³", h = 2.5e-3 }, { name = "h = 2.5 × 10⁻⁵", h = 2.5e-5 } }
local radii <const> = { 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.5 }
local variables <const> = shape().variables
print "\nfinal compliance (designs), by the first radius"
print((" "):rep(34) .. "         exact        h = 2.5e-2        h = 2.5e-3        h = 2.5e-5")
for _, kind in ipairs(kinds) do
  kind.designs, kind.compliance, kind.mean, kind.sum = {}, {}, 0, { designs = 0, seconds = 0, analysis_seconds = 0, derivative_seconds = 0, iterations = 0, derivative_iterations = 0 }
end
for k, radius in ipairs(radii) do
  local cells <const> = {}
  for i, kind in ipairs(kinds) do
    local optimum <const> = shape(kind.h):optimise{ max_designs = 200, radius = radius }
    kind.designs[k], kind.compliance[k] = #optimum.history, optimum.objective
    kind.first, kind.mean = optimum.history[1].objective, kind.mean + optimum.objective / #radii
    for key in pairs(kind.sum) do kind.sum[key] = kind.sum[key] + optimum.cost[key] end
    if not kind.best or optimum.objective < kind.best.objective then kind.best = optimum end
    cells[i] = ("%10.4f (%3d)  "):format(optimum.objective, #optimum.history)
  end
  print(("%-34s"):format(("  radius %g"):format(radius)) .. table.concat(cells, " "))
end
for _, kind in ipairs(kinds) do kind.per_variable = 1000 * kind.sum.derivative_seconds / (kind.sum.designs * variables) end

-- What u' itself costs: a linear solve a variable with the factor of the analysis (compliance needs none).
local per_displacement = math.huge
for _ = 1, 5 do
  local design <const> = shape(nil, dotyk.solver.pdas{}):design()
  local begun <const> = os.clock()
  design:displacement(upper, 1, 0.375 + gap)
  per_displacement = math.min(per_displacement, 1000 * (os.clock() - begun) / variables)
end

local function line(name, format, of, of_paper)
  local cells <const> = {}
  for k, kind in ipairs(kinds) do
    cells[k] = ("%12s"):format(format:format(of(kind))) .. ("%10s"):format(paper[k] and of_paper and ("(%s)"):format(of_paper(paper[k])) or k == 4 and of_paper and "(none)" or "")
  end
  print(("%-34s"):format(name) .. table.concat(cells))
end
print "\nSums over the radii. In brackets the paper's figures, of its own geometry; with h = 2.5e-5 it did not converge."
line("", "%s", function(k) return k.name end)
line("designs", "%d", function(k) return k.sum.designs end, function(p) return p[1] end)
line("first compliance", "%.4f", function(k) return k.first end, function(p) return p[2] end)
line("final compliance, mean", "%.4f", function(k) return k.mean end, function(p) return p[3] end)
line("  best", "%.4f", function(k) return k.best.objective end)
line("seconds", "%.3f", function(k) return k.sum.seconds end)
line("  of the analyses", "%.3f", function(k) return k.sum.analysis_seconds end)
line("  of the derivatives", "%.3f", function(k) return k.sum.derivative_seconds end)
line("derivative by one variable: ms (s)", "%.2f", function(k) return k.per_variable end, function(p) return p[4] end)
line("CG steps of the analyses", "%d", function(k) return k.sum.iterations end, function(p) return p[5] end)
line("CG steps of the derivatives", "%d", function(k) return k.sum.derivative_iterations end, function(p) return p[6] end)
print(("the displacement's derivative by one variable, exact: %.2f ms, %.0f times cheaper than the difference with h = 2.5e-3"):format(
  per_displacement, kinds[3].per_variable / per_displacement))

-- 4. Exact derivatives end lowest in the mean (but for the solver's tolerance), with no more designs in sum than differences that end as low,
-- at a quarter of the cost or less.
local exact <const> = kinds[1]
assert(exact.best.constraints[1] <= 1e-9)
for k = 2, #kinds do
  assert(exact.mean <= kinds[k].mean * (1 + 1e-6) and exact.best.objective <= kinds[k].best.objective * (1 + 1e-6), kinds[k].name)
  assert(exact.sum.designs <= kinds[k].sum.designs or exact.mean < kinds[k].mean * (1 - 1e-3), kinds[k].name)
  if not short then assert(4 * exact.per_variable <= kinds[k].per_variable and 4 * per_displacement <= kinds[k].per_variable, kinds[k].name) end
end

-- 5. The pressure, before and after.
local function pressures(solution)
  local x <const>, p <const>, sum, length, peak = {}, {}, 0, 0, 0
  for k, n in ipairs(solution:contact(contact).nodes) do
    x[k], p[k] = n.x, n.pressure
    if n.pressure > 0 then
      sum, length, peak = sum + n.force, length + n.weight, math.max(peak, n.pressure)
    end
  end
  return x, p, peak / (sum / length), length, peak
end
local first <const>, best <const> = shape():design().solution, exact.best.solution
local x <const>, before <const>, uneven <const>, short_contact <const>, peak_before <const> = pressures(first)
local _, after <const>, even <const>, long_contact <const>, peak_after <const> = pressures(best)
print(("\npeak over mean pressure %.2f before, %.2f after; peak %.0f and %.0f, contact over %.2f and %.2f of the length"):format(
  uneven, even, peak_before, peak_after, short_contact, long_contact))
assert(even < 0.8 * uneven and peak_after < 0.8 * peak_before)
if short then return end

local function edge(alpha) -- the lower edge above the other body
  local d <const> = shape():design(alpha)
  local y <const> = {}
  for k, n in ipairs(d:contact(contact)) do y[k] = n.y.value end
  return y
end
local lines <const> = {}
for k, kind in ipairs(kinds) do -- beside each other, as most numbers agree
  lines[k] = { name = kind.name, x = {}, y = kind.designs, style = "points" }
  for i, radius in ipairs(radii) do lines[k].x[i] = radius + 0.011 * (k - 2.5) end
end
print("wrote", dotyk.chart{ file = "images/cont.png", columns = 3, size = { 2100, 800 }, panels = {
  { title = "Pressure", x = "x", y = "pressure", series = { { name = "first design", x = x, y = before, style = "line" }, { name = "best design", x = x, y = after, style = "line" } } },
  { title = "Gap", x = "x", y = "gap at rest", series = { { name = "first design", x = x, y = edge(), style = "line" }, { name = "best design", x = x, y = edge(exact.best.alpha), style = "line" } } },
  { title = "Exact and by steps h", x = "first trust radius (points side by side)", y = "number of designs", y_range = { 1.5, 5.5 }, series = lines } } })
local look <const> = { field = "von_mises", deform = 1, range = { 0, 6000 }, window = { -0.1, -1.05, 2.15, 0.85 }, size = { 1200, 900 } }
for _, it in ipairs{ { first, "images/cont_first.png", "First design" }, { best, "images/cont_best.png", "Least compliance" } } do
  look.file, look.title = it[2], it[3]
  print("wrote", it[1]:render(look))
end
