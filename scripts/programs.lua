-- The quadratic programs of the Maros–Mészáros collection in ../shared/reference/qp.
--
--   ./dotyk scripts/programs.lua [LARGEST]
--
-- Solves every file (with at most LARGEST unknowns) by the active-set method, changing one row of the
-- working set in a step, and many; shows objective, its error relative to the value listed with the
-- collection, the violation of the rows, iterations and singular KKT systems, and checks each solution by its
-- duality gap. "it" counts KKT systems solved for a step; "ip" the interior-point iterations that chose the first
-- working set of larger programs. VALUES is not convex and has to be refused.

local largest <const> = tonumber(arg[1]) or math.huge
local folder <const> = (arg[0]:match "^(.*)/[^/]*$" or ".") .. "/../../shared/reference/qp/"
local index <const> = io.open(folder .. "maros_meszaros_index.csv")
if not index then
  print("no programs in " .. folder .. ": nothing to solve")
  return
end

-- 1. The list: name, size and the optimal value printed with the collection.
local list, refused = {}, { VALUES = "not_convex" }
index:read "l"
for line in index:lines() do
  local field = {}
  for text in (line .. ","):gmatch "([^,]*)," do field[#field + 1] = text end
  if tonumber(field[2]) <= largest then list[#list + 1] = { name = field[1], optimum = tonumber(field[12]) } end
end
index:close()

-- 2. Both variants on every program.
local function relative(value, reference) return math.abs(value - reference) / (1 + math.abs(reference)) end

local function verdict(one, entry, r)
  if refused[entry.name] then return r.status == refused[entry.name] and "refused: " .. r.status or "NOT REFUSED" end
  if not r.converged then return "FAILED: " .. r.status end
  local res = r.residual
  if res.feasibility > 1e-6 then return "FAILED: rows violated" end
  if one.error <= 1e-6 then return "optimal" end
  -- Feasible and without a duality gap, it is the optimum of the file, whatever value is listed.
  if math.max(res.feasibility, res.stationarity, res.complementarity) < 1e-10 then
    return ("proved: duality gap %.0e, so the listed value is off by %.1e"):format(res.complementarity, one.error)
  end
  return "FAILED: objective"
end

print "                                                                one row a step            many rows a step"
print "name          n      m       objective    error   violation    it  ip  sing  seconds    it  sing  seconds"
local count = { optimal = 0, proved = 0, refused = 0, FAILED = 0, NOT = 0 }
local total, singular, survived, zigzags = { one = 0, many = 0 }, 0, 0, 0
for _, entry in ipairs(list) do
  local program = dotyk.qp(folder .. "maros_meszaros/" .. entry.name .. ".mat")
  local r, many = program:solve{ change = "one" }, program:solve{ change = "many" }
  local one = { error = relative(r.objective, entry.optimum) }
  local words = verdict(one, entry, r)
  local other = verdict({ error = relative(many.objective, entry.optimum) }, entry, many)
  if words:match "^%a+" ~= other:match "^%a+" then words = "FAILED: many rows a step: " .. other end
  count[words:match "^%a+"] = count[words:match "^%a+"] + 1
  total.one, total.many = total.one + r.seconds, total.many + many.seconds
  singular, survived = singular + r.singular + many.singular, survived + r.survived + many.survived
  zigzags = zigzags + r.repeats + many.repeats
  print(("%-9s %5d  %5d  %14.7e  %7.0e  %9.0e  %5d %3d %5d  %7.2f %5d %5d  %7.2f  %s"):format(program.name, program.unknowns,
    program.rows, r.objective, one.error, r.residual.feasibility, r.iterations, r.predictor_iterations, r.singular, r.seconds,
    many.iterations, many.singular, many.seconds, words))
end

-- 3. In one line.
print(("%d programs: %d optimal to 1e-6 of the listed value, %d optimal by its duality gap where that value is off, %d refused"):format(
  #list, count.optimal, count.proved, count.refused))
print(("as they should be, %d failed; %.1f s changing one row a step, %.1f s changing many"):format(count.FAILED + count.NOT, total.one, total.many))
print(("%d singular KKT systems met, %d of them survived; zigzagging noticed %d times"):format(singular, survived, zigzags))
assert(count.FAILED + count.NOT == 0)
