-- Every pair of laws at the ends of a beam: which methods solve it, or which theorem refuses it; and where verdicts turn (P4).
--
--   ./dotyk scripts/papers/horak/beam_table.lua [every]
--
-- Tables of the laws of two displacements: the number of methods that solve the beam and agree, or the theorem of P4 that
-- says why it has no solution: T2 one-sided elastic, T3 Signorini, T4 friction against rotation, T5 friction against deflection;
-- br: whatever may break would break, and then nothing holds the beam; x: no theorem is about these laws, and statics alone
-- says that nothing holds it. Then every law on all four displacements of the ends, each by two methods: 14641 beams, or every
-- `every`-th of them. Then loads swept through the limit of each theorem: at which load relative to the
-- limit the verdict turns, to 1e-9, and that within a millionth of the limit it is told as a limit case.

local law <const> = dotyk.law
local every <const> = math.tointeger(tonumber(arg[1]) or 1)
local L <const> = 2

-- The laws of a displacement under a load of 2, which has the moment 2 about an end: some bear it, some do not.
local function laws(friction, one_sided, cap)
  return { { "free", law.free() }, { "prescribed", law.prescribed(0) }, { "load", law.load(0.3) }, { "elastic", law.elastic(4) },
    { "one-sided elastic", law.one_sided_elastic(4) }, { "Signorini", law.signorini() }, { "friction", law.friction(friction) },
    { "one-sided friction", law.one_sided_friction(one_sided) }, { "capped elastic", law.capped_elastic(4, cap) }, { "breaking", law.breaking(4, 1.5) },
    { "unequal elastic", law.unequal_elastic(4, 1) } }
end
local deflections <const>, rotations <const> = laws(2.4, 1.2, 0.7), laws(1.6, 2.4, 2.4)
local methods <const> = { dotyk.solver.pdas{}, dotyk.solver.newton{}, dotyk.solver.psor{}, dotyk.solver.uzawa{ max_iterations = 100000 }, dotyk.solver.interior_point{} }

-- The theorems that a refusal is by.
local function theorems(refusal)
  assert(refusal:find "no solution" or refusal:find "nothing holds it", refusal)
  if refusal:find "would break" then return "br" end
  local out <const> = {}
  for theorem in refusal:gmatch "theorem (%d)" do out[#out + 1] = "T" .. theorem end
  return #out > 0 and table.concat(out) or "x"
end

-- How many methods solve a beam and by how much they differ; or nil and what refuses it.
local function compared(beam, by_methods)
  local known, by, apart, refused, treated = nil, 0, 0, nil, 0
  for _, method in ipairs(by_methods) do
    local solved <const>, s = pcall(method.solve, method, beam)
    if not solved and tostring(s):find "cannot treat" then goto next end
    treated = treated + 1
    if not solved then
      refused = theorems(tostring(s))
      goto next
    end
    if not s.converged then goto next end
    known, by = known or s, by + 1
    for i = 0, 8 do -- moments: the same where a motion remains that nothing stops
      apart = math.max(apart, math.abs(s:moment(L * i / 8) - known:moment(L * i / 8)))
      if not s.reason:find "unique up to" then apart = math.max(apart, math.abs(s:deflection(L * i / 8) - known:deflection(L * i / 8))) end
    end
    ::next::
  end
  assert(not refused or by == 0, "some methods solve what others refuse")
  if refused then return nil, refused end
  return by, apart
end

-- 1. Tables of pairs.
local greatest, count, refusals = 0, 0, {}
local function note(by, what)
  count = count + 1
  if not by then
    refusals[what] = (refusals[what] or 0) + 1
    return what
  end
  assert(by >= 2, "solved by one method only")
  greatest = math.max(greatest, what)
  return tostring(by)
end
local short <const> = { "free", "presc", "load", "elast", "1s el", "Sign", "frict", "1s fr", "cap", "break", "uneq" }
local function pairs_table(title, rows, columns, make)
  print("\n" .. title)
  print((" "):rep(20) .. table.concat(short, "  "))
  for _, row in ipairs(rows) do
    local cells <const> = {}
    for j, column in ipairs(columns) do
      local left <const>, right <const> = make(row[2], column[2])
      local cell <const> = note(compared(dotyk.beam{ length = L, cells = 8, load = -1, left = left, right = right }, methods))
      cells[j] = cell .. (" "):rep(#short[j] + 2 - #cell)
    end
    print(("%-20s%s"):format(row[1], table.concat(cells)))
  end
end
pairs_table("deflections of the left (rows) and the right end (columns); both turn freely", deflections, deflections,
  function(a, b) return { deflection = a }, { deflection = b } end)
pairs_table("rotations of the left (rows) and the right end (columns) of a beam on two supports", rotations, rotations,
  function(a, b) return { deflection = law.prescribed(), rotation = a }, { deflection = law.prescribed(), rotation = b } end)
pairs_table("deflection (rows) and rotation (columns) of the right end; the left one is free", deflections, rotations,
  function(a, b) return {}, { deflection = a, rotation = b } end)
pairs_table("deflection of the left end (rows), which turns freely, and rotation of the right one (columns), which deflects freely", deflections, rotations,
  function(a, b) return { deflection = a }, { rotation = b } end)
local function summary(title)
  local out <const> = {}
  for _, theorem in ipairs{ "2", "3", "4", "5" } do
    local sum = 0
    for what, n in pairs(refusals) do sum = sum + (what:find("T" .. theorem, 1, true) and n or 0) end
    out[#out + 1] = ("theorem %s %d"):format(theorem, sum)
  end
  local refused = 0
  for _, n in pairs(refusals) do refused = refused + n end
  print(("\n%s: %d beams, %d solved, methods differ by %.1e at most; %d refused: %s, statics alone %d, breaking %d"):format(
    title, count, count - refused, greatest, refused, table.concat(out, ", "), refusals.x or 0, refusals.br or 0))
  assert(greatest < 1e-8)
  greatest, count, refusals = 0, 0, {}
end
summary "pairs"

-- 2. Laws on all four displacements, by two methods.
local two <const> = { methods[1], methods[2] }
local n <const> = #deflections
local function chosen(choice, place, among) return among[choice // math.tointeger(n^place) % n + 1][2] end
for choice = 0, math.tointeger(n^4) - 1, every do
  note(compared(dotyk.beam{ length = L, cells = 4, load = -1,
    left = { deflection = chosen(choice, 0, deflections), rotation = chosen(choice, 1, rotations) },
    right = { deflection = chosen(choice, 2, deflections), rotation = chosen(choice, 3, rotations) } }, two))
end
summary(("four laws, one choice in %d"):format(every))

-- 3. Sweeps: t times the limit; the verdict turns at t = 1.
local function verdict(beam) -- does it have a solution, and is it told as a limit case?
  local solved <const>, s = pcall(dotyk.solve, beam)
  if solved then assert(s.converged) end
  return solved, (solved and s.reason or tostring(s)):find "limit case" ~= nil
end
local function press(supports, at)  -- under -1 a support of a resting beam is lifted off by t times the force that does it
  return function(t)
    return dotyk.beam{ length = L, load = -1, left = { deflection = supports }, right = { deflection = supports },
      loads = { { x = at, force = t / math.max(at / L, 1 - at / L) } } }
  end
end
local function turn(rotation) -- about the left end; one-sided laws resist loads upwards
  return function(t) return dotyk.beam{ length = L, load = t, left = { deflection = law.prescribed(), rotation = rotation } } end
end
local function slide(left, right) return function(t) return dotyk.beam{ length = L, load = -t, left = { deflection = left }, right = { deflection = right } } end end
local sweeps <const> = {
  { 2, "one-sided elastic, right end lifted", press(law.one_sided_elastic(4), 1.5) },
  { 2, "one-sided elastic, left end lifted", press(law.one_sided_elastic(4), 0.5) },
  { 3, "Signorini, right end lifted", press(law.signorini(), 1.5) },
  { 3, "Signorini, left end lifted", press(law.signorini(), 0.5) },
  { 4, "friction", turn(law.friction(2)) }, { 4, "one-sided friction", turn(law.one_sided_friction(2)) }, { 4, "capped elastic", turn(law.capped_elastic(4, 2)) },
  { 5, "friction, weaker at the left", slide(law.friction(1), law.friction(1.5)) },
  { 5, "friction, weaker at the right", slide(law.friction(1.5), law.friction(1)) },
  { 5, "one-sided friction", slide(law.one_sided_friction(1), law.one_sided_friction(1.5)) },
  { 5, "capped elastic", slide(law.capped_elastic(4, 1), law.capped_elastic(4, 1.5)) } }
print "\ntheorem  laws                                  verdict turns at    told as a limit case within"
for _, sweep in ipairs(sweeps) do
  local theorem <const>, name <const>, at <const> = table.unpack(sweep)
  local solvable, not_solvable = 0.5, 1.5
  assert(verdict(at(solvable)) and not verdict(at(not_solvable)))
  while not_solvable - solvable > 1e-13 do
    local middle <const> = 0.5 * (solvable + not_solvable)
    if verdict(at(middle)) then solvable = middle else not_solvable = middle end
  end
  local below, above = 0.1, 0.1  -- the greatest decade on either side that is told
  while not select(2, verdict(at(1 - below))) do below = below / 10 end
  while not select(2, verdict(at(1 + above))) do above = above / 10 end
  print(("%d        %-37s 1 %+.1e          -%.0e, +%.0e"):format(theorem, name, solvable - 1, below, above))
  assert(math.abs(solvable - 1) < 1e-9 and math.max(below, above) < 1e-5)
  local _, why = pcall(dotyk.solve, at(1.1))
  assert(tostring(why):find("theorem " .. theorem))
end
