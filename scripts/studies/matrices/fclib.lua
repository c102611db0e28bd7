-- Frictional contact problems of the FCLIB and siconos collections, every file by every method.
--
--   ./dotyk scripts/studies/matrices/fclib.lua [SECONDS [PATTERN...]]
--
-- Reads the files of ../shared/reference/fclib (HDF5, and plain text in its folder dat), those whose name matches one
-- of the Lua patterns where any are given (Rover: all files with Rover in their names), and solves each by every
-- method on rows, for at most SECONDS (5). Compared is the natural-map residual |r - P(r - rho u^)| / |r| (see
-- help "contact_problem_result"), the same for all methods; 1e-8 counts as solved. Most of the files hold more contact
-- forces than motions (rank W < rows), so that the forces are not unique; the velocities of a solution are shown by |u|.
-- images/fclib.png: how many problems are solved after how many seconds; images/fclib_history.png: one hard one.

local limit <const> = tonumber(arg[1]) or 5
local solved_at <const> = 1e-8
local folder <const> = (arg[0]:match "^(.*)/[^/]*$" or ".") .. "/../../../../shared/reference/fclib/"

-- 1. The files, and what they are.
local function picked(name)
  for k = 2, #arg do
    if name:find(arg[k]) then return true end
  end
  return #arg < 2
end
local found = 0
local function files(sub, ending)
  local list, names = io.popen("ls '" .. folder .. sub .. "' 2>/dev/null"), {}
  for name in list:lines() do
    if name:sub(-#ending) == ending then
      found = found + 1
      if picked(name) then names[#names + 1] = sub .. name end
    end
  end
  list:close()
  return names
end
local hdf5 <const>, text <const> = files("", ".hdf5"), files("dat/", ".dat")
if found == 0 then
  print("no problems in " .. folder .. ": nothing to solve")
  return
end
if #hdf5 + #text == 0 then
  error(("none of the %d files of %s matches '%s'"):format(found, folder, table.concat(arg, "' or '", 2)), 0)
end

local problems, refused = {}, {}
for _, list in ipairs{ hdf5, text } do
  for _, name in ipairs(list) do
    local fine, p = pcall(dotyk.fclib, folder .. name)
    if fine then
      problems[#problems + 1] = { problem = p, text = list == text }
    else
      refused[#refused + 1] = name:match "[^/]*$" .. ":" .. tostring(p):match "^.*[%d'](:.*)$":sub(2)
    end
  end
end
if #problems == 0 then error("none can be read: " .. table.concat(refused, "; "), 0) end

-- 2. Every method on every file.
local methods <const> = { "proximal", "newton", "psor", "projected_cg", "uzawa", "uzawa_pdas", "coulomb_loop" }
local function solve(p, name)
  local from <const> = os.clock()
  local keys <const> = { tol = 1e-11, max_iterations = 1000000, on_iteration = function() return os.clock() - from < limit end }
  local method <const> = dotyk.solver[name](keys)
  local r <const> = method:solve(p)
  return { name = name, residual = r.residual, iterations = r.iterations, seconds = r.seconds, result = r,
           solved = r.residual <= solved_at }
end
for _, entry in ipairs(problems) do
  entry.runs = {}
  for _, name in ipairs(methods) do
    local run <const> = solve(entry.problem, name)
    entry.runs[name] = run
    if not entry.best or run.residual < entry.best.residual then entry.best = run end
  end
end

-- 3. The HDF5 files in full, the text files in a line each.
local function velocity(u)
  local sum = 0
  for _, x in ipairs(u) do sum = sum + x * x end
  return math.sqrt(sum)
end
for _, entry in ipairs(problems) do
  if entry.text then goto continue end
  local p <const> = entry.problem
  print(("%s: %s, %d contacts, rank W %d of %d%s"):format(p.name, p.kind, p.contacts, p.rank_W, p.rows,
    p.unsymmetry > 1e-12 and ((", %s unsymmetric by %.0e"):format(p.kind == "local" and "W" or "M", p.unsymmetry)
      .. (p.symmetrised and ", symmetrised" or ", taken as it is")) or ""))
  print "                 residual  iterations  seconds   open  stick  slip      sum r_N           |u|"
  for _, name in ipairs(methods) do
    local run <const> = entry.runs[name]
    local r <const>, normal = run.result, 0
    for k = 1, p.rows, p.dimension do normal = normal + r.r[k] end
    print(("  %-12s  %9.1e  %10d  %7.3f  %5d  %5d %5d  %14.9e  %.10g%s"):format(name, run.residual, run.iterations, run.seconds,
      r.open, r.stick, r.slip, normal, velocity(r.u), run.solved and "" or "  not solved"))
  end
  ::continue::
end

local heading = ("\n%-40s %8s %6s %7s"):format("text files: residuals", "contacts", "rank W", "of rows")
for _, name in ipairs(methods) do heading = heading .. ("  %12s"):format(name) end
print(heading .. "   best")
for _, entry in ipairs(problems) do
  if not entry.text then goto continue end
  local p <const> = entry.problem
  local line = ("%-40s %8d %6d %7d"):format(p.name, p.contacts, p.rank_W, p.rows)
  for _, name in ipairs(methods) do line = line .. ("  %12.0e"):format(entry.runs[name].residual) end
  print(line .. ("   %.0e %s"):format(entry.best.residual, entry.best.name))
  ::continue::
end
for _, words in ipairs(refused) do print("refused: " .. words) end

-- 4. How many are solved.
local series, longest = {}, limit
for _, entry in ipairs(problems) do
  for _, run in pairs(entry.runs) do longest = math.max(longest, run.seconds) end
end
print(("\n%d problems, residual <= %.0e within %g s each:"):format(#problems, solved_at, limit))
for _, name in ipairs(methods) do
  local times = {}
  for _, entry in ipairs(problems) do
    local run <const> = entry.runs[name]
    if run.solved then times[#times + 1] = math.max(run.seconds, 1e-5) end
  end
  table.sort(times)
  local x, y = { 1e-5 }, { 0 }
  for k, t in ipairs(times) do
    x[#x + 1], y[#y + 1] = t, k - 1
    x[#x + 1], y[#y + 1] = t, k
  end
  x[#x + 1], y[#y + 1] = longest, #times
  series[#series + 1] = { name = name, x = x, y = y, style = "line" }
  print(("  %-12s %d solved"):format(name, #times))
end
dotyk.chart{ file = "images/fclib.png", x = "seconds", y = "problems solved, of " .. #problems, log = "x", series = series, size = {1000, 700} }
print "images/fclib.png"

-- 5. The residual on the way, on one that sweeps hardly solve (the first where that one is not picked).
local hard = problems[1]
for _, entry in ipairs(problems) do
  if entry.problem.name:match "^local_problem_test" then hard = entry end
end
local curves = {}
for _, name in ipairs(methods) do
  local x, y, next = {}, {}, 0
  local history <const> = hard.runs[name].result.history
  for k, one in ipairs(history) do
    if (one.time >= next or k == #history) and one.residual > 0 then  -- equally spaced on the axis
      x[#x + 1], y[#y + 1] = math.max(one.time, 1e-5), math.max(one.residual, 1e-17)
      next = one.time * 1.05
    end
  end
  curves[#curves + 1] = { name = name, x = x, y = y, style = #x > 1 and "line" or "points" }
end
dotyk.chart{ file = "images/fclib_history.png", x = "seconds", y = "relative residual of the method's map", log = "xy",
             title = hard.problem.name .. ": rank W " .. hard.problem.rank_W .. " of " .. hard.problem.rows, series = curves, size = {1000, 700} }
print "images/fclib_history.png"
local solved = 0
for _, entry in ipairs(problems) do solved = solved + (entry.runs.proximal.solved and 1 or 0) end
assert(solved == #problems or limit < 5, "the proximal method leaves a problem unsolved")
