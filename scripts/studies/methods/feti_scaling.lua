-- How FETI scales: with the number of subdomains, with their size, and against the direct method.
--
--   OPENBLAS_NUM_THREADS=1 ./dotyk scripts/studies/methods/feti_scaling.lua [subdomains | size | direct] [MOST] [CELLS]
--
-- A cube (in the plane a square) fixed at its left side, pressed from above, its bottom over a rigid plane that it
-- meets in part; cut into equal cubes with total FETI.
-- The penalty is 30 |PFP| here: outer steps are few, and inner ones about as many for every number of subdomains.
-- subdomains: N² and N³ of them with H/h = 8: steps stay bounded, and preconditioners save some;
--             images/feti_subdomains.png. MOST: N in the plane, at least 16. CELLS: H/h.
-- size:       condition of PFP and steps for H/h = 4 … 32 against C·H/h; images/feti_size.png. MOST: H/h.
-- direct:     time and memory against pdas, each solve in a process of its own, up to 1.46 million unknowns (pdas:
--             440 000 in 12 GB); images/feti_direct.png. MOST: subdomains along an edge.

local part <const>, most <const>, cells_given <const> = arg[1] or "all", tonumber(arg[2]), tonumber(arg[3])
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
  local given = { subdomains = boxes(dimension, count), tol = 1e-6 }
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
local preconditioners <const> = { "none", "lumped", "dirichlet" }
local shown <const> = { none = "no preconditioner", lumped = "lumped", dirichlet = "Dirichlet" }
local counts <const> = { [2] = { 2, 4, 8, 16, 32 }, [3] = { 2, 3, 4, 5, 6 } }

-- The numbers of subdomains along an edge, and the steps for each preconditioner.
local function steps_of(dimension, cells)
  local x, steps = {}, { none = {}, lumped = {}, dirichlet = {} }
  for k, count in ipairs(counts[dimension]) do
    if most and counts[2][k] > most then break end
    x[k] = count^dimension
    for _, name in ipairs(preconditioners) do
      local s <const> = solved(feti(dimension, count, { preconditioner = name }), dimension, cells * count)
      steps[name][k] = s.feti.inner
      print(("%d-D %-9s %7d  %9d  %9d  %6d  %7d  %5d  %11d  %8d  %7.2f"):format(dimension, name, s.feti.subdomains,
        s.unknowns, s.feti.rows, s.feti.kernel, s.feti.factors, s.iterations, s.feti.inner, s.feti.products, s.time.total))
    end
  end
  return x, steps
end

-- Bounded: the last takes at most 1.5 times the steps of the third, the first after the smallest two. In the plane, κ small,
-- preconditioners save little beside the steps that find the contact.
local function check_steps(dimension, steps)
  for _, name in ipairs(preconditioners) do
    local y <const> = steps[name]
    assert(#y > 3, "give at least 16 subdomains along an edge")
    print(("%d-D %s: steps of the last against the third %.2f"):format(dimension, name, y[#y] / y[3]))
    assert(y[#y] <= 1.5 * y[3], "the number of steps grows")
  end
  for k, plain in ipairs(steps.none) do
    assert(steps.dirichlet[k] <= (dimension == 2 and 1 or 0.9) * plain, "the Dirichlet preconditioner saves too little")
    assert(dimension == 2 or steps.lumped[k] < plain, "the lumped preconditioner saves none")
  end
end

local function by_subdomains()
  local cells <const> = cells_given or 8
  print(("H/h = %d     subdomains  unknowns  dual rows  coarse  factors  outer  inner steps  products  seconds"):format(cells))
  local series, all = {}, {}
  for _, dimension in ipairs{ 2, 3 } do
    local x <const>, steps <const> = steps_of(dimension, cells)
    all[dimension] = steps
    for _, name in ipairs(preconditioners) do
      series[#series + 1] = { name = ("%d-D, %s"):format(dimension, shown[name]), x = x, y = steps[name] }
    end
  end
  dotyk.chart{ file = "images/feti_subdomains.png", x = ("subdomains, H/h = %d"):format(cells),
               y = "steps of conjugate gradients and projections", log = "x", series = series, size = { 1000, 700 } }
  for _, dimension in ipairs{ 2, 3 } do check_steps(dimension, all[dimension]) end
end

-- 2. Larger subdomains, one number of them: 4² and 2³. The condition grows as C H/h - c, C its slope between the first two.
local slack <const> = 1.05
local function by_size()
  print "\nH/h        condition of PFP   inner steps   condition/(H/h)   unknowns   seconds"
  local series = {}
  for _, dimension in ipairs{ 2, 3 } do
    local x, condition, guide = {}, {}, {}
    local along <const> = dimension == 2 and 4 or 2
    for _, cells in ipairs{ 4, 8, 12, 16, 24, 32 } do
      if most and cells > most then break end
      local s <const> = solved(feti(dimension, along, { spectrum = true }), dimension, cells * along)
      x[#x + 1], condition[#condition + 1] = cells, s.feti.condition
      print(("%d-D %4d  %16.2f  %12d  %16.2f  %9d  %8.1f"):format(dimension, cells, s.feti.condition, s.feti.inner,
        s.feti.condition / cells, s.unknowns, s.time.total))
    end
    local C <const> = slack * (condition[2] - condition[1]) / (x[2] - x[1])
    for k, size in ipairs(x) do
      guide[k] = C * size
      assert(condition[k] <= guide[k], "the condition of PFP grows faster than H/h")
    end
    series[#series + 1] = { name = dimension == 2 and "2-D, 4² subdomains" or "3-D, 2³ subdomains", x = x, y = condition }
    series[#series + 1] = { name = ("%.1f H/h"):format(C), x = x, y = guide, reference = true }
  end
  dotyk.chart{ file = "images/feti_size.png", x = "H/h", y = "condition of PFP", log = "xy", series = series, size = { 900, 700 } }
end

-- 3. Against the direct method: this script again, for one solve, with the most memory it held.
local cubes <const> = { { 2, 3 }, { 2, 5 }, { 2, 8 }, { 2, 13 }, { 3, 13 }, { 4, 13 }, { 5, 13 }, { 6, 13 } }  -- along an edge: subdomains, cells of each
local largest_direct <const> = 4 * 13
local same_energy <const> = 1e-6  -- relative, tol of both; seen: 6e-8

local function one(method, count, cells)
  local n <const> = cells * count
  local s <const> = method == "feti" and solved(feti(3, count), 3, n) or solved(solvers.pdas{ tol = 1e-6 }, 3, n)
  local status <const> = assert(io.open "/proc/self/status"):read "a"
  print(("RESULT %d %.3f %d %.9e"):format(s.unknowns, s.time.total, tonumber(status:match "VmHWM:%s*(%d+)") * 1024, s.energy))
end

local program <const> = io.popen("readlink /proc/$PPID/exe"):read "l"
-- Runs it, small cubes thrice: unknowns, least seconds, GB, energy; nil where it is not solved.
local function measured(method, count, cells)
  local unknowns, seconds, held, energy
  for _ = 1, count * cells <= 26 and 3 or 1 do
    local process <const> = io.popen(("'%s' '%s' %s %d %d"):format(program, arg[0], method, count, cells))
    local said <const> = process:read "a"
    process:close()
    local numbers <const> = { said:match "RESULT (%d+) (%S+) (%d+) (%S+)" }
    if #numbers == 0 then
      print(("%-6s  %d³ cells: not solved: %s"):format(method, count * cells, (said:gsub("%s+", " "))))
      return
    end
    unknowns, held, energy = tonumber(numbers[1]), tonumber(numbers[3]) / 2^30, tonumber(numbers[4])
    seconds = math.min(seconds or math.huge, tonumber(numbers[2]))
  end
  print(("%-6s %9d  %7.2f  %11.2f   %.9e"):format(method, unknowns, seconds, held, energy))
  return unknowns, seconds, held, energy
end

-- Where two curves of like sizes cross, by straight lines between the logarithms; nil where they do not.
local function crossing(direct, cut)
  for k = #direct.x, 2, -1 do
    local a <const>, b <const> = math.log(direct.y[k - 1] / cut.y[k - 1]), math.log(direct.y[k] / cut.y[k])
    if a < 0 and b >= 0 then
      local t <const> = -a / (b - a)
      local function between(u, v) return math.exp(math.log(u) + t * (math.log(v) - math.log(u))) end
      return between(direct.x[k - 1], direct.x[k]), between(direct.y[k - 1], direct.y[k])
    end
  end
end

local function against_direct()
  print "\nmethod  unknowns  seconds  memory [GB]   energy"
  local time, memory = {}, {}
  for _, method in ipairs{ "pdas", "feti" } do
    time[method] = { name = method, x = {}, y = {} }
    memory[method] = { name = method, x = time[method].x, y = {} }
  end
  local ends = {}
  for k, cube in ipairs(cubes) do
    local count <const>, cells <const> = cube[1], cube[2]
    if count > (most or 6) then break end
    local energies = {}
    for _, method in ipairs{ "pdas", "feti" } do  -- in turn: both see the machine alike
      local unknowns, seconds, held
      if not ends[method] and (method == "feti" or count * cells <= largest_direct) then
        unknowns, seconds, held, energies[method] = measured(method, count, cells)
      end
      ends[method] = not unknowns
      time[method].x[k], time[method].y[k], memory[method].y[k] = unknowns, seconds, held
    end
    assert(k > 1 or energies.pdas and energies.feti, "not even the smallest cube was solved")
    assert(not (energies.pdas and energies.feti) or math.abs(energies.feti / energies.pdas - 1) < same_energy, "the two methods differ")
  end
  local panels <const> = {}
  for k, panel in ipairs{ { "as fast", time, "seconds" }, { "as much memory", memory, "memory [GB]" } } do
    local what <const>, of <const>, label <const> = table.unpack(panel)
    panels[k] = { y = label, log = "xy", series = { of.pdas, of.feti } }
    local x <const>, y <const> = crossing(of.pdas, of.feti)
    if x then
      print(("%s at %.0f unknowns"):format(what, x))
      panels[k].notes = { { x = x, y = y, text = ("%s: %d00 unknowns"):format(what, math.floor(x / 100 + 0.5)) } }
    end
  end
  dotyk.chart{ file = "images/feti_direct.png", x = "unknowns", panels = panels, size = { 1000, 1000 } }
  if most then return end
  local last <const> = #time.feti.x
  assert(time.feti.x[last] >= 1.2e6, "not solved with 1.2 million unknowns")
  assert(time.feti.y[last] < 15 * 60 and memory.feti.y[last] < 12, "15 minutes and 12 GB are not enough")
end

if part == "feti" or part == "pdas" then
  one(part, most, cells_given)
  return
end
if part == "all" or part == "subdomains" then by_subdomains() end
if part == "all" or part == "size" then by_size() end
if part == "all" or part == "direct" then against_direct() end
print "images/feti_subdomains.png, images/feti_size.png, images/feti_direct.png"
