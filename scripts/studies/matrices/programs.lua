-- The quadratic programs of the Maros–Mészáros collection in ../shared/reference/qp.
--
--   ./dotyk scripts/studies/matrices/programs.lua [LARGEST] [START]
--
-- Solves every file (with at most LARGEST unknowns) by the active-set method, changing one row of the
-- working set in a step, and many. Each result is proved from x and y alone, in extended precision: the
-- objective at x, and the dual bound, below which no feasible point falls; "gap" is between them and "slack"
-- what the violation of rows may hide, both relative. "listed" is the value printed with the collection less
-- ours, relative: where it is beyond 1e-6 the two bounds are printed, and say which of them is right. "it"
-- counts KKT systems solved for a step; "ip" the interior-point iterations that chose the first working set of
-- larger programs. VALUES is not convex and has to be refused.

local largest <const> = tonumber(arg[1]) or math.huge
local start <const> = arg[2] or "automatic" -- "cold": without the interior-point prediction
local folder <const> = (arg[0]:match "^(.*)/[^/]*$" or ".") .. "/../../../../shared/reference/qp/"
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
local function verdict(entry, r)
  if refused[entry.name] then return r.status == refused[entry.name] and "refused: " .. r.status or "NOT REFUSED" end
  if not r.converged then return "FAILED: " .. r.status end
  local b = r.bracket
  if b.violation > 1e-6 then return "FAILED: rows violated" end
  if b.gap + b.slack < 1e-7 then return "proved" end
  -- Programs so badly scaled that no more digits are to be had: the listed value decides.
  if math.abs(entry.optimum - r.objective) <= 1e-6 * (1 + math.abs(entry.optimum)) then return "listed value met" end
  return "FAILED: objective"
end

print "                                                                        one row a step           many rows a step"
print "name          n      m       objective       gap    slack   listed    it  ip  sing  seconds    it  sing  seconds"
local count, off = { proved = 0, listed = 0, refused = 0, FAILED = 0, NOT = 0 }, {}
local total, singular, survived, zigzags = { one = 0, many = 0 }, 0, 0, 0
for _, entry in ipairs(list) do
  local program = dotyk.qp(folder .. "maros_meszaros/" .. entry.name .. ".mat")
  local r, many = program:solve{ change = "one", start = start }, program:solve{ change = "many", start = start }
  local words, other = verdict(entry, r), verdict(entry, many)
  if other:match "^FAILED" then words = "FAILED: many rows a step: " .. other end
  count[words:match "^%a+"] = count[words:match "^%a+"] + 1
  total.one, total.many = total.one + r.seconds, total.many + many.seconds
  singular, survived = singular + r.singular + many.singular, survived + r.survived + many.survived
  zigzags = zigzags + r.repeats + many.repeats
  local b = r.bracket
  local listed = (entry.optimum - r.objective) / (1 + math.abs(entry.optimum))
  if r.converged and math.abs(listed) > 1e-6 then off[#off + 1] = { entry, b } end
  print(("%-9s %5d  %5d  %14.7e  %8.0e %8.0e %8.0e %5d %3d %5d  %7.2f %5d %5d  %7.2f  %s"):format(program.name, program.unknowns,
    program.rows, r.objective, b.gap, b.slack, listed, r.iterations, r.predictor_iterations, r.singular, r.seconds,
    many.iterations, many.singular, many.seconds, words))
end

-- 3. Listed values that are off: the optimum lies between the bounds, and the listed value does not.
for _, case in ipairs(off) do
  local entry, b = table.unpack(case)
  local high = b.primal + b.slack * (1 + math.abs(b.primal))
  print(("%s: optimum between %.12e (dual) and %.12e (primal, rows violated by %.0e; %.0e with what that may hide)"):format(
    entry.name, b.dual, b.primal, b.violation, high - b.primal))
  print(("  listed %.12e lies %s: %s"):format(entry.optimum, entry.optimum > high and "above" or entry.optimum < b.dual and "below" or "between",
    (entry.optimum > high or entry.optimum < b.dual) and ("it is off by %.2e, relative"):format(math.abs(entry.optimum - b.primal) / math.abs(b.primal))
      or "both may be right"))
end

-- 4. In one line.
print(("%d programs: %d optimal by proof (gap and slack below 1e-7), %d by the listed value to 1e-6, %d refused"):format(
  #list, count.proved, count.listed, count.refused))
print(("as they should be, %d failed; %.1f s changing one row a step, %.1f s changing many"):format(count.FAILED + count.NOT, total.one, total.many))
print(("%d singular KKT systems met, %d of them survived; zigzagging noticed %d times"):format(singular, survived, zigzags))
assert(count.FAILED + count.NOT == 0)
