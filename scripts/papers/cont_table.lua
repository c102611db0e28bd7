-- Vondrák's problem "cont" (ODAM 2001, P7, section 5) with 3298 unknowns: figures 7 to 10 and table 4.
--
--   ./dotyk scripts/papers/cont_table.lua [CELLS]
--
-- Printed: 41 × 21 nodes a body, 3298 unknowns, E, ν, the load, the first compliance 25.1552. Lost with the drawing: lengths, gap, supports.
-- 1. 3444 − 3298 = 146 components are fixed. All choices of components on whole sides that fix 146 are counted, and five that hold both
--    bodies remain but for mirror images. Compliance goes with the square of the length of the whole, so each of them has lengths with 25.1552.
--    The final compliance, 8.7547 or 0.348 of the first, is reached by two of them only, where the bodies are 2 × 1 each: the upper body is
--    clamped on one side and slides on the other. That with the lower body on its bottom is used; the gap is the one with 25.1552.
-- 2. Sensitivities of the y-displacement at the first design, exact and by differences. Differences of displacements with relative errors ε
--    are wrong by ε·max|u|/(h·max|∂u|), so that ε is told at which h = 2.5e-2, 2.5e-3, 2.5e-5 leave an error of a tenth.
-- 3. Table 4: tolerances as in the paper (steps below 0.01 % of the ranges end a run, solves to 1e-6), from first trust regions of every size,
--    sought for the paper's counts of designs, 36, 87 and 46. A trust region doubles after a good step, so that none comes near.
-- 4. The same with move limits that never grow, the usual sequential linear programming of that time: each linear program has one constraint
--    beside the box and is solved by filling in the order of cost per volume. Limits halve where the compliance rises.
-- CELLS: along a body, 40. Draws images/papers_cont_table.png, images/papers_cont_sensitivities.png and images/papers_cont_scene.png.

local folder <const> = arg[0]:match "^(.*)/[^/]*$" or "."
local two_bodies <const> = dofile(folder .. "/two_bodies.lua")
local verdict <const> = dofile(folder .. "/../stability/common.lua").verdict
local cells <const> = tonumber(arg[1]) or 40
local full <const> = cells == 40
local pdas <const> = dotyk.solver.pdas{}

-- 1. Supports. Components fixed on the sides of a body of n × m nodes, corners counted once; x alone, y alone or both on each side.
local function fixed(n, m, left, right, bottom)
  local sum = 0
  for _, c in ipairs{ "x", "y" } do
    local l <const>, r <const>, b <const> = left:find(c) and 1 or 0, right:find(c) and 1 or 0, bottom:find(c) and 1 or 0
    sum = sum + m * (l + r) + n * b - b * (l + r)
  end
  return sum
end
local function holds(left, right, bottom) -- no rigid motion is left
  local sides <const> = left .. right
  return (sides .. bottom):find "x" and (sides .. bottom):find "y" and (sides:find "x" or bottom:find "y" or left:find "y" and right:find "y")
end
local choices <const>, supports <const>, total = { "", "x", "y", "xy" }, {}, 0
for _, ul in ipairs(choices) do for _, ur in ipairs(choices) do for _, ll in ipairs(choices) do for _, lr in ipairs(choices) do for _, lb in ipairs(choices) do
  if fixed(41, 21, ul, ur, "") + fixed(41, 21, ll, lr, lb) == 2 * 2 * 41 * 21 - 3298 then
    total = total + 1
    if #ul .. ul > #ur .. ur or ul == ur and ll >= lr then -- of two mirror images, one
      if holds(ul, ur, "") and holds(ll, lr, lb) then
        supports[#supports + 1] = { upper_left = ul, upper_right = ur, lower_left = ll, lower_right = lr, lower_bottom = lb }
      end
    end
  end
end end end end end
local function name(fix)
  local function side(key) return fix[key] == "" and "-" or fix[key] end
  return ("%-4s %-4s %-4s %-4s %-4s"):format(side "upper_left", side "upper_right", side "lower_left", side "lower_right", side "lower_bottom")
end
print(("%d choices of whole sides fix 146 components; those that hold both bodies, without mirror images:"):format(total))
print "upper l  r   lower l  r   b     first compliance, gap 0 to ∞   final / first for gaps of 0.005, 0.01, 0.02, 0.05, 0.1"
local function first_compliance(fix, gap) return two_bodies{ gap = gap, height = 1, fix = fix, cells = cells }.shape(nil, pdas):design().compliance.value end
local used, reach = nil, 0
for _, fix in ipairs(supports) do
  local row <const> = { ("%s   %6.2f to %6.2f             "):format(name(fix), first_compliance(fix, 1e-6), first_compliance(fix, 1)) }
  local least = 1
  for _, gap in ipairs{ 0.005, 0.01, 0.02, 0.05, 0.1 } do
    local found <const> = two_bodies{ gap = gap, height = 1, fix = fix, cells = math.min(cells, 20) }.shape(nil, pdas):optimise{ radius = 0.2 }
    local share <const> = found.objective / found.history[1].objective
    row[#row + 1], least = ("%.2f"):format(share), math.min(least, share)
  end
  print(table.concat(row, "  "))
  if least < 8.7547 / 25.1552 then
    reach = reach + 1
    if fix.lower_bottom == "y" then used = fix end
  end
end

local low, high = 1e-4, 0.1
while high / low > 1 + 1e-9 do
  local gap <const> = math.sqrt(low * high)
  if first_compliance(used, gap) < 25.1552 then low = gap else high = gap end
end
local gap <const> = high
local cont <const> = two_bodies{ gap = gap, height = 1, fix = used, cells = cells }
local first <const> = cont.shape(nil, pdas):design()
print(("used: %s  gap %.6f, %d unknowns, first compliance %.4f"):format(name(used), gap, first.solution.unknowns, first.compliance.value))
assert(not full or first.solution.unknowns == 3298)
assert(math.abs(first.compliance.value - 25.1552) < 1e-4)
first.solution:render{ file = "images/papers_cont_scene.png", field = "uy", deform = 1, size = { 1200, 1000 }, title = "Problem “cont” with 3298 unknowns: first design" }
print "images/papers_cont_scene.png"

-- 2. Sensitivities of the y-displacement along the upper body's lower edge.
local steps <const> = { "2.5e-2", "2.5e-3", "2.5e-5" }
local panels <const>, x = {}, {}
local function profile(design)
  local u <const> = {}
  for k = 0, cells do
    x[k + 1] = 2 * k / cells
    u[k + 1] = select(2, design:displacement(cont.upper, x[k + 1], gap))
  end
  return u
end
local exact <const>, most_u = profile(first), 0
for _, u in ipairs(exact) do most_u = math.max(most_u, math.abs(u.value)) end
print "\nvariable   max |∂u_y|   error of differences: h = 2.5e-2  2.5e-3  2.5e-5    error in u that spoils them by a tenth: 2.5e-2  2.5e-3  2.5e-5"
local cg <const> = cont.shape()
local worst <const>, least_needed <const> = { 0, 0, 0 }, { 1, 1, 1 }
for i = 1, 6 do
  local derivative <const>, most = {}, 0
  for k, u in ipairs(exact) do derivative[k], most = u.gradient[i], math.max(most, math.abs(u.gradient[i])) end
  local function named(text) return i == 1 and text or nil end -- one legend for all
  local series <const>, off <const>, needed <const> = { { name = named "exact", x = x, y = derivative, style = "line", front = true } }, {}, {}
  for j, h in ipairs(steps) do
    local alpha <const>, difference <const> = { 0, 0, 0, 0, 0, 0 }, {}
    alpha[i] = tonumber(h)
    local error = 0
    for k, u in ipairs(profile(cg:design(alpha))) do
      difference[k] = (u.value - exact[k].value) / alpha[i]
      error = math.max(error, math.abs(difference[k] - derivative[k]) / most)
    end
    off[j], needed[j] = ("%.0e"):format(error), ("%.0e"):format(0.1 * alpha[i] * most / most_u)
    worst[j], least_needed[j] = math.max(worst[j], error), math.min(least_needed[j], 0.1 * alpha[i] * most / most_u)
    if j < 3 then series[j + 1] = { name = named("h = " .. h), x = x, y = difference, style = "line", reference = j == 1 } end
  end
  print(("%5d %14.4f %33s  %6s  %6s %47s  %6s  %6s"):format(i, most, off[1], off[2], off[3], needed[1], needed[2], needed[3]))
  panels[i] = { title = ("variable %d"):format(i), x = "x", y = "∂u_y/∂α" .. utf8.char(0x2080 + i), series = series }
end
assert(worst[1] > worst[2] and worst[2] > worst[3] and worst[3] < 1e-3)
dotyk.chart{ file = "images/papers_cont_sensitivities.png", panels = panels, columns = 3, size = { 1700, 1000 },
  title = "∂u_y along the upper body's lower edge at the first design: exact and by differences" }
print "images/papers_cont_sensitivities.png"

-- 3. Table 4 from first trust regions of every size.
local kinds <const> = { { name = "exact" }, { name = "h = 2.5e-2", h = 2.5e-2 }, { name = "h = 2.5e-3", h = 2.5e-3 }, { name = "h = 2.5e-5", h = 2.5e-5 } }
print "\nfirst trust region: designs and final compliance      exact           h = 2.5e-2      h = 2.5e-3      h = 2.5e-5"
for _, kind in ipairs(kinds) do kind.radii, kind.designs, kind.final, kind.most, kind.best, kind.worst = {}, {}, {}, 0, math.huge, 0 end
for k = 0, full and 26 or 8 do
  local radius <const>, row <const> = 2^(-k / 2), {}
  for i, kind in ipairs(kinds) do
    row[i] = (" "):rep(14)
    if i == 1 or k % 4 == 0 then
      local found <const> = cont.shape(kind.h):optimise{ radius = radius, max_designs = 400, tol_design = 1e-4 }
      local n <const> = #found.history
      kind.radii[#kind.radii + 1], kind.designs[#kind.radii + 1], kind.final[#kind.radii + 1] = radius, n, found.objective
      kind.most, kind.best, kind.worst = math.max(kind.most, n), math.min(kind.best, found.objective), math.max(kind.worst, found.objective)
      row[i] = ("%3d  %9.4f"):format(n, found.objective)
    end
  end
  print(("%10.2e %40s"):format(radius, "") .. table.concat(row, "  "))
end
for i, kind in ipairs(kinds) do
  print(("%-12s at most %2d designs%-14s final compliance %.4f to %.4f%s"):format(kind.name, kind.most, cont.paper[i] and (" (paper %d),"):format(cont.paper[i][1]) or ",",
    kind.best, kind.worst, cont.paper[i] and (" (paper %.4f)"):format(cont.paper[i][3]) or ""))
end

-- 4. Move limits that never grow. The step: min g·d, a·d ≤ room, low ≤ d ≤ high.
local function filled(g, a, room, low, high)
  local d <const>, changes <const>, sum = {}, {}, 0
  for i = 1, #g do
    local other
    if g[i] > 0 then d[i], other = low[i], high[i] else d[i], other = high[i], low[i] end
    sum = sum + a[i] * d[i]
    if a[i] * (other - d[i]) < 0 then changes[#changes + 1] = { i, other - d[i], math.abs(g[i] / a[i]) } end
  end
  table.sort(changes, function(p, q) return p[3] < q[3] end)
  for _, change in ipairs(changes) do
    if sum <= room then break end
    local i <const>, whole <const> = change[1], change[2]
    local part <const> = math.min(1, (room - sum) / (a[i] * whole))
    d[i], sum = d[i] + part * whole, sum + part * a[i] * whole
  end
  return d
end
local function limited(kind, limit)
  local shape <const> = cont.shape()
  local lower <const>, upper <const>, volume <const> = shape.lower, shape.upper, first.volume.value
  local function evaluated(alpha)
    local design <const>, g <const> = shape:design(alpha), {}
    for i = 1, 6 do
      if kind.h then
        local beside <const> = { table.unpack(alpha) }
        beside[i] = beside[i] + kind.h
        g[i] = (shape:design(beside).compliance.value - design.compliance.value) / kind.h
      else
        g[i] = design.compliance.gradient[i]
      end
    end
    return { alpha = alpha, compliance = design.compliance.value, g = g, a = design.volume.gradient, room = volume - design.volume.value }
  end
  local best, designs, change = evaluated{ 0, 0, 0, 0, 0, 0 }, 1, 1
  while change > 1e-4 and limit > 1e-4 and designs < 200 do
    local low <const>, high <const>, alpha <const> = {}, {}, {}
    for i = 1, 6 do
      local box <const> = limit * (upper[i] - lower[i])
      low[i], high[i] = math.max(-box, lower[i] - best.alpha[i]), math.min(box, upper[i] - best.alpha[i])
    end
    change = 0
    for i, d in ipairs(filled(best.g, best.a, best.room, low, high)) do
      alpha[i] = best.alpha[i] + d
      change = math.max(change, math.abs(d) / (upper[i] - lower[i]))
    end
    if change > 1e-4 then
      local trial <const> = evaluated(alpha)
      designs = designs + 1
      if trial.compliance < best.compliance then best = trial else limit = limit / 2 end
    end
  end
  return designs, best.compliance
end
local limits <const>, as_paper = { x = {}, y = {} }, nil
print "\nmove limit that never grows: designs, final compliance (exact)"
for _, k in ipairs{ 5, 10, 15, 20, 30, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 60 } do
  local designs <const>, compliance <const> = limited(kinds[1], 1 / k)
  limits.x[#limits.x + 1], limits.y[#limits.y + 1] = 1 / k, designs
  print(("%6s %5d %9.4f"):format("1/" .. k, designs, compliance))
  if designs == 36 then as_paper = as_paper or k end
end
