-- How FETI scales: with the number of subdomains, with their size, and against the direct method.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/feti_scaling.lua [subdomains | size | direct] [MOST]
--
-- A cube (in the plane a square) fixed at its left side, pressed from above, its bottom over a rigid plane that it
-- meets in part; cut into equal cubes with total FETI.
-- The penalty is 30 |PFP| here: outer steps are few, and inner ones about as many for every number of subdomains.
-- subdomains: N² and N³ of them with H/h = 8: steps stay bounded; images/feti_subdomains.png. MOST: N in the plane.
-- size:       condition of PFP and steps for H/h = 4 … 32 against C·H/h; images/feti_size.png. MOST: H/h.
-- direct:     time and memory against pdas, each solve in a process of its own, up to 1.48 million unknowns;
--             images/feti_direct.png. MOST: subdomains along an edge of 13 cells each.

local part <const>, most <const> = arg[1] or "all", tonumber(arg[2])
local rubber <const> = dotyk.material{ E = 200, nu = 0.3 }
local solvers <const> = dotyk.solver

-- A cube of n cells along each edge, or a square.
local function scene(dimension, n)
  local space <const> = dimension == 3
  local mesh <const> = space and dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n}, element = "Q1" }
    or dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, n}, element = "Q1" }
  local body <const> = dotyk.body{ name = "block", mesh = mesh, material = rubber }
  body:part "left":fix()
  body:part "top":load(space and { 0, 0, -2 } or { 0, -2 })
  local s <const> = dotyk.scene{ body }
  s:contact{ body:part "bottom", rigid = dotyk.rigid.gap{ normal = space and {0, 0, -1} or {0, -1}, gap = function() return 0.01 end } }
  return s
end

local function boxes(dimension, count)
  return dimension == 3 and { count, count, count } or { count, count }
end

local function feti(dimension, count, options)
  local given = { subdomains = boxes(dimension, count), tol = 1e-6, rho = 30 }
  for key, value in pairs(options or {}) do given[key] = value end
  return solvers.feti(given)
end

-- One solve, in this process.
local function solved(method, dimension, n)
  local s <const> = method:solve(scene(dimension, n))
  assert(s.converged, s.reason)
  return s
end

-- 1. More subdomains of one size.
local function by_subdomains()
  print "H/h = 8     subdomains  unknowns   dual rows  coarse  factors  outer  inner steps  seconds"
  local series, bounded = {}, true
  for _, dimension in ipairs{ 2, 3 } do
    local x, steps = {}, { none = {}, lumped = {}, dirichlet = {} }
    local counts <const> = dimension == 2 and { 2, 4, 8, 16, 32 } or { 2, 3, 4, 5, 6 }
    for _, count in ipairs(counts) do
      if most and count > (dimension == 2 and most or math.max(2, most // 2)) then break end
      x[#x + 1] = count^dimension
      for _, name in ipairs{ "none", "lumped", "dirichlet" } do
        local s <const> = solved(feti(dimension, count, { preconditioner = name }), dimension, 8 * count)
        table.insert(steps[name], s.feti.inner)
        print(("%d-D %-9s %7d  %9d  %9d  %6d  %7d  %5d  %11d  %7.2f"):format(dimension, name, s.feti.subdomains, s.unknowns,
          s.feti.rows, s.feti.kernel, s.feti.factors, s.iterations, s.feti.inner, s.time.total))
      end
    end
    for _, name in ipairs{ "none", "lumped", "dirichlet" } do
      local y <const> = steps[name]
      series[#series + 1] = { name = ("%d-D, %s"):format(dimension, name == "none" and "no preconditioner" or name), x = x, y = y }
      if #y > 3 then
        local ratio <const> = y[#y] / y[3]
        print(("%d-D %s: steps of the last against the third %.2f"):format(dimension, name, ratio))
        bounded = bounded and (name ~= "none" or ratio <= 1.5)
      end
    end
  end
  dotyk.chart{ file = "images/feti_subdomains.png", x = "subdomains, H/h = 8", y = "steps of conjugate gradients and projections",
               log = "x", series = series, size = { 1000, 700 } }
  assert(bounded, "the number of steps without preconditioner grows")
end

-- 2. Larger subdomains, one number of them.
local function by_size()
  print "\nH/h        condition of PFP   inner steps   condition/(H/h)"
  local series = {}
  for _, dimension in ipairs{ 2, 3 } do
    local x, condition = {}, {}
    for _, cells in ipairs(dimension == 2 and { 4, 8, 16, 32 } or { 4, 6, 8, 12, 16 }) do
      if most and cells > most then break end
      local s <const> = solved(feti(dimension, dimension == 2 and 4 or 3, { spectrum = true }), dimension, cells * (dimension == 2 and 4 or 3))
      x[#x + 1], condition[#condition + 1] = cells, s.feti.condition
      print(("%d-D %4d  %16.2f  %12d  %16.2f"):format(dimension, cells, s.feti.condition, s.feti.inner, s.feti.condition / cells))
    end
    series[#series + 1] = { name = ("%d-D"):format(dimension), x = x, y = condition }
  end
  dotyk.chart{ file = "images/feti_size.png", x = "H/h", y = "condition of PFP", log = "xy", series = series, slopes = { 1 }, size = { 900, 700 } }
end

-- 3. Against the direct method: this script again, for one solve, with the most memory it held.
local function one(method, count)
  local n <const> = 13 * count
  local s <const> = method == "feti" and solved(feti(3, count), 3, n) or solved(solvers.pdas{ tol = 1e-6 }, 3, n)
  local status <const> = assert(io.open "/proc/self/status"):read "a"
  print(("RESULT %d %.3f %d %.6e"):format(s.unknowns, s.time.total, tonumber(status:match "VmHWM:%s*(%d+)") * 1024, s.energy))
end

-- Where two curves of like sizes cross, by straight lines between the logarithms.
local function mark_crossing(series)
  local direct <const>, cut <const> = series[1], series[2]
  for k = 2, #direct.x do
    local a <const>, b <const> = math.log(direct.y[k - 1] / cut.y[k - 1]), math.log(direct.y[k] / cut.y[k])
    if a < 0 and b >= 0 then
      local t <const> = -a / (b - a)
      local function between(u, v) return math.exp(math.log(u) + t * (math.log(v) - math.log(u))) end
      local x <const>, y <const> = between(direct.x[k - 1], direct.x[k]), between(direct.y[k - 1], direct.y[k])
      print(("as fast as each other at %.0f unknowns (%.1f s)"):format(x, y))
      series[3] = { name = ("as fast at %.0f unknowns"):format(x), x = { x }, y = { y }, style = "points" }
    end
  end
end

local function against_direct()
  print "\nmethod  unknowns  seconds   memory [GB]   energy"
  local series, memory, table_ = {}, {}, {}
  for _, method in ipairs{ "pdas", "feti" } do
    local x, seconds, bytes = {}, {}, {}
    table_[method] = {}
    for count = 1, method == "pdas" and math.min(3, most or 6) or (most or 6) do
      local process <const> = io.popen(("'%s' '%s' %s %d"):format(arg[-1] or "./dotyk", arg[0], method, count))
      local said <const> = process:read "a"
      process:close()
      local unknowns, time, held, energy = said:match "RESULT (%d+) (%S+) (%d+) (%S+)"
      if not unknowns then
        print(("%-6s  %d³ cubes: not solved: %s"):format(method, count, (said:gsub("%s+", " "))))
        break
      end
      unknowns = tonumber(unknowns)
      print(("%-6s %9d  %7.1f  %12.2f   %s"):format(method, unknowns, time, held / 2^30, energy))
      x[#x + 1], seconds[#seconds + 1], bytes[#bytes + 1] = unknowns, tonumber(time), held / 2^30
      table_[method][count] = tonumber(energy)
      if table_.pdas[count] then
        assert(math.abs(tonumber(energy) / table_.pdas[count] - 1) < 1e-5, "the two methods differ")
      end
    end
    series[#series + 1] = { name = method .. ": seconds", x = x, y = seconds }
    memory[#memory + 1] = { name = method .. ": GB", x = x, y = bytes }
  end
  mark_crossing(series)
  dotyk.chart{ file = "images/feti_direct.png", x = "unknowns", y = "seconds, GB", log = "xy",
               series = { series[1], series[2], memory[1], memory[2], series[3] }, size = { 1000, 700 } }
end

if part == "feti" or part == "pdas" then
  one(part, most)
  return
end
if part == "all" or part == "subdomains" then by_subdomains() end
if part == "all" or part == "size" then by_size() end
if part == "all" or part == "direct" then against_direct() end
print "images/feti_subdomains.png, images/feti_size.png, images/feti_direct.png"
