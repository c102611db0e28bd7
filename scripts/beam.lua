-- A beam on one-sided supports, and every pair of laws at its ends (P4).
--
--   ./dotyk scripts/beam.lua [cells]
--
-- Shown: a continuous beam on five supports under a load on one span, held both ways, resting, and resting on springs:
-- where it lifts off (images/beam.png: resting, with deflection, bending moment and shear force; images/beam_deflection.png,
-- images/beam_moment.png: all three); a table of all pairs of laws
-- for the deflections of two ends, each solved by several methods or refused with its reason; how springs tend to a rigid stop.

local law <const> = dotyk.law
local cells <const> = tonumber(arg[1]) or 40

-- 1. Five supports at 0, 1, … 4, a load on the second span.
local function continuous(support)
  local inner = {}
  for x = 1, 3 do inner[x] = { x = x, deflection = support } end
  local beam <const> = dotyk.beam{ length = 4, EJ = 1, cells = cells, left = { deflection = support }, right = { deflection = support },
    supports = inner, load = function(x) return (x > 1 and x < 2) and -10 or -0.2 end }
  return dotyk.solve(beam)
end
local cases <const> = { { "held both ways", law.prescribed(0) }, { "resting", law.signorini() }, { "resting on springs, k = 50", law.one_sided_elastic(50) } }
local deflections, moments = {}, {}
for _, case in ipairs(cases) do
  local s <const> = continuous(case[2])
  local u <const>, M <const> = { name = case[1], x = {}, y = {}, style = "line" }, { name = case[1], x = {}, y = {}, style = "line" }
  for i = 0, 400 do
    local x <const> = i / 100
    u.x[i + 1], u.y[i + 1], M.x[i + 1], M.y[i + 1] = x, s:deflection(x), x, s:moment(x)
  end
  deflections[#deflections + 1], moments[#moments + 1] = u, M
  local reactions, sum, off = {}, 0, {}
  for _, at in ipairs{ "left", 1, 2, 3, "right" } do
    local r <const> = s:reaction(at)
    reactions[#reactions + 1] = ("%7.4f"):format(r.force)
    sum = sum + r.force
    if r.deflection > 1e-9 then off[#off + 1] = at end
  end
  print(("%-27s reactions %s, lifted off at %s"):format(case[1], table.concat(reactions, " "), #off > 0 and table.concat(off, ", ") or "none"))
  assert(math.abs(sum - 10.6) < 1e-9)
end
continuous(law.signorini()):render{ file = "images/beam.png", title = "A beam resting on five supports, loaded on one span" }
table.insert(deflections, { name = "supports", x = { 0, 1, 2, 3, 4 }, y = { 0, 0, 0, 0, 0 }, style = "points" })
dotyk.chart{ file = "images/beam_deflection.png", title = "A beam on five supports, held and resting", x = "x", y = "deflection", series = deflections }
dotyk.chart{ file = "images/beam_moment.png", title = "Its bending moment, −EJ u″", x = "x", y = "M", series = moments }

-- 2. All pairs of laws for the deflections of two ends; loads down, and half as much up at the right end.
local laws <const> = { { "free", law.free() }, { "prescribed", law.prescribed(0) }, { "load", law.load(0.3) }, { "elastic", law.elastic(4) },
  { "one-sided elastic", law.one_sided_elastic(4) }, { "Signorini", law.signorini() }, { "friction", law.friction(0.7) },
  { "one-sided friction", law.one_sided_friction(0.7) }, { "capped elastic", law.capped_elastic(4, 0.7) }, { "breaking", law.breaking(4, 0.6) } }
local methods <const> = { dotyk.solver.pdas{}, dotyk.solver.newton{}, dotyk.solver.psor{}, dotyk.solver.uzawa{ max_iterations = 100000 }, dotyk.solver.interior_point{} }
local counted, refused, most = 0, {}, 0
print "\nleft                right               by   |du| between methods"
for _, left in ipairs(laws) do
  for _, right in ipairs(laws) do
    local beam <const> = dotyk.beam{ length = 1, EJ = 1, cells = 8, load = -1, left = { deflection = left[2] }, right = { deflection = right[2] } }
    local known, by, apart = nil, 0, 0
    local why
    for _, method in ipairs(methods) do
      local solved <const>, s = pcall(method.solve, method, beam)
      if solved and s.converged and not s.reason:find "unique up to" then
        known = known or s
        by = by + 1
        for _, x in ipairs{ 0, 0.5, 1 } do apart = math.max(apart, math.abs(s:deflection(x) - known:deflection(x))) end
      elseif not solved and tostring(s):find "no solution" then
        why = s
      end
    end
    if why then
      assert(by == 0)
      local reason <const> = why:match "theorem %d" or "nothing holds it"
      refused[reason] = (refused[reason] or 0) + 1
    else
      assert(by >= 2, ("%s, %s: solved by %d methods"):format(left[1], right[1], by))
      counted, most = counted + 1, math.max(most, apart)
      if left[1] <= right[1] then print(("%-19s %-19s %d    %.1e"):format(left[1], right[1], by, apart)) end
    end
  end
end
print(("%d of %d pairs solved, methods differ by %.1e at most"):format(counted, (#laws)^2, most))
for reason, count in pairs(refused) do print(("%d refused: %s"):format(count, reason)) end
assert(most < 1e-7)

-- 3. Springs tend to a rigid stop by 1/k.
local function tip(support)
  return dotyk.solve(dotyk.beam{ length = 2, load = -1, cells = 8, left = { deflection = law.prescribed(0), rotation = law.prescribed(0) },
    right = { deflection = support } }):deflection(1)
end
local rigid <const>, last = tip(law.signorini())
print "\n      k   off the rigid stop   order"
for power = 1, 6 do
  local off <const> = math.abs(tip(law.one_sided_elastic(10^power)) - rigid)
  local order <const> = last and math.log(last / off, 10)
  print(("1e%d       %.3e           %s"):format(power, off, order and ("%.3f"):format(order) or ""))
  if power > 2 then assert(math.abs(order - 1) < 0.02) end
  last = off
end
print "images/beam.png, images/beam_deflection.png, images/beam_moment.png"
