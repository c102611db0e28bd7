-- A beam on one-sided supports, and what its supports tend to (P4).
--
--   ./dotyk scripts/examples/beam.lua [cells]
--
-- Shown: a continuous beam on five supports under a load on one span, held both ways, resting, and resting on springs:
-- where it lifts off (images/beam.png: resting, with deflection, bending moment and shear force; images/beam_deflection.png,
-- images/beam_moment.png: all three). Then the limits of laws: stiff springs tend to a rigid stop by 1/k, soft ones to
-- none by k, friction to a prescribed displacement as its bound nears the reaction that holds, and is one from there on.
-- Every law against its closed form is scripts/studies/accuracy/beam_laws.lua, all pairs of laws scripts/papers/horak/beam_table.lua.

local law <const> = dotyk.law
local cells <const> = tonumber(arg[1]) or 40

-- 1. Five supports at 0, 1, … 4, a load on the second span.
local beam_on <const> = include "../lib/beam.lua"
local function continuous(support) return dotyk.solve(beam_on(support, cells)) end
local cases <const> = { { "held both ways", law.prescribed(0) }, { "resting", law.signorini() }, { "resting on springs, k = 50", law.one_sided_elastic(50) } }
local deflections, moments = {}, {}
local function curve(s, quantity, keys, points) -- over the beam
  local out <const> = { x = {}, y = {} }
  for key, value in pairs(keys) do out[key] = value end
  for i = 0, points do
    local x <const> = 4 * i / points
    out.x[i + 1], out.y[i + 1] = x, s[quantity](s, x)
  end
  return out
end
for _, case in ipairs(cases) do
  local s <const> = continuous(case[2])
  deflections[#deflections + 1] = curve(s, "deflection", { name = case[1], style = #deflections < 1 and "both" or "line", twin = #deflections == 2 or nil }, #deflections < 1 and 20 or 400)
  local springs <const> = case[1]:find "springs" -- its moments are nearly those of resting: points on that line
  moments[#moments + 1] = curve(s, "moment", { name = case[1], style = springs and "points" or "line" }, springs and 32 or 400)
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
continuous(law.signorini()):render{ file = "images/beam.png", title = "A beam resting on five supports" }
table.insert(deflections, { name = "supports", x = { 0, 1, 2, 3, 4 }, y = { 0, 0, 0, 0, 0 }, style = "points" })
dotyk.chart{ file = "images/beam_deflection.png", title = "Deflection of the beam", x = "x", y = "deflection", x_range = { -0.15, 4.15 }, series = deflections }
dotyk.chart{ file = "images/beam_moment.png", title = "Bending moment of the beam", x = "x", y = "M = −EJ u″", series = moments }

-- 2. Limits of laws, on a cantilever's tip and on the rotation of a beam's end on two supports.
local ends <const> = {
  deflection = { { deflection = law.prescribed(), rotation = law.prescribed() }, function(l) return { deflection = l } end },
  rotation = { { deflection = law.prescribed() }, function(l) return { deflection = law.prescribed(), rotation = l } end } }
local function solved(of, l) -- its deflection in the middle, and what the law bears
  local s <const> = dotyk.solve(dotyk.beam{ length = 2, load = -1, cells = 8, left = ends[of][1], right = ends[of][2](l) })
  return s:deflection(1), s:reaction("right")[of == "deflection" and "force" or "moment"]
end
local function limit(title, of, make, to, powers)
  local target <const>, last = solved(of, to), nil
  local line <const>, orders <const> = {}, {}
  for power = powers[1], powers[2], powers[1] < powers[2] and 1 or -1 do
    local off <const> = math.abs(solved(of, make(10.0^power)) - target) / math.abs(target)
    line[#line + 1] = ("%.1e"):format(off)
    if last then orders[#orders + 1] = math.abs(math.log(last / off, 10)) end
    last = off
  end
  print(("%-33s %-10s  1e%+d, …: %s   order %.3f"):format(title, of, powers[1], table.concat(line, "  "), orders[#orders]))
  assert(math.abs(orders[#orders] - 1) < 0.01)
end
print "\nhow far laws are from their limits, relative, by powers of ten of k or of 1 - bound/reaction that holds"
for _, of in ipairs{ "deflection", "rotation" } do
  limit("one-sided elastic to Signorini", of, law.one_sided_elastic, law.signorini(), { 1, 6 })
  limit("elastic to prescribed", of, law.elastic, law.prescribed(), { 1, 6 })
  limit("one-sided elastic to free", of, law.one_sided_elastic, law.free(), { -1, -6 })
  limit("elastic to free", of, law.elastic, law.free(), { -1, -6 })
  local held <const>, reaction = solved(of, law.prescribed())
  reaction = math.abs(reaction)
  limit("friction to prescribed", of, function(short) return law.friction((1 - short) * reaction) end, law.prescribed(), { -1, -6 })
  local off = 0
  for power = 0, 8 do off = math.max(off, math.abs(solved(of, law.friction((1 + 1e-9) * reaction * 10^power)) / held - 1)) end
  print(("%-33s %-10s  bounds from %.6g to 1e8 times as much: %.1e"):format("friction to prescribed", of, reaction, off))
  assert(off < 1e-12)
end
print "images/beam.png, images/beam_deflection.png, images/beam_moment.png"
