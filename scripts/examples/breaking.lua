-- A support that breaks: its law is not monotone, and the beam has up to two states of equilibrium under one load
-- (P4, figures 16 and 17).
--
--   ./dotyk scripts/examples/breaking.lua
--
-- A cantilever's tip rests on a spring that pushes with up to g and then breaks. Whole, the tip goes down by F/(k + c),
-- c = 3 EJ/L^3 the cantilever's own stiffness, as long as the spring bears less than g; broken, by F/c, as long as that
-- is more than what broke it. Between the two forces both are local minima of the energy. Shown: every branch under
-- every force against the closed form; the loop that loading and unloading runs through where a state is kept as long as
-- it is a minimum; the energies; both states under one force, and where they lie on the law. images/breaking.png,
-- images/breaking_energy.png, images/breaking_states.png. Then how many branches two and three such springs have
-- under every force, against a count by the cantilever's flexibility in closed form: images/breaking_branches.png.

local L <const>, EJ <const>, k <const>, g <const> = 2, 3, 3, 0.2
local c <const> = 3 * EJ / L^3
local breaks <const>, heals <const> = g * (k + c) / k, g * c / k
local function branches(force)
  local beam <const> = dotyk.beam{ length = L, EJ = EJ, loads = { { x = L, force = -force } },
    left = { deflection = dotyk.law.prescribed(0), rotation = dotyk.law.prescribed(0) },
    right = { deflection = dotyk.law.breaking(k, g) } }
  return dotyk.solve(beam).branches
end

-- 1. Every branch under every force, in closed form.
local curves <const> = { whole = { x = {}, y = {}, energy = {} }, broken = { x = {}, y = {}, energy = {} } }
local forces <const>, worst = {}, 0
for i = 0, 40 do forces[#forces + 1] = 1.25 * breaks * (i + 0.5) / 40.5 end
for _, force in ipairs(forces) do
  local found <const> = branches(force)
  for _, s in ipairs(found) do
    local broken <const> = #s.broken > 0
    local curve <const>, tip <const> = broken and curves.broken or curves.whole, s:deflection(L)
    local exact <const> = -force / (broken and c or k + c)
    worst = math.max(worst, math.abs(tip / exact - 1))
    table.insert(curve.x, -tip)
    table.insert(curve.y, force)
    table.insert(curve.energy, s.energy)
  end
  assert(#found == (force < breaks and 1 or 0) + (force > heals and 1 or 0))
end
print(("%d forces: a spring that is whole up to %.4f, one that is broken from %.4f on; tips differ by %.1e from the closed form"):format(
  #forces, breaks, heals, worst))
assert(worst < 1e-10)

-- 2. Loading and unloading: a state is kept as long as it is one of the minima, then it jumps to the nearest.
local function follow(from, to)
  local path <const>, broken = { tip = {}, force = {} }, from > to
  for i = 0, 400 do
    local force <const> = from + (to - from) * i / 400
    local found <const> = branches(force)
    local kept
    for _, s in ipairs(found) do
      if (#s.broken > 0) == broken then kept = s end
    end
    local jumps <const> = not kept
    kept = kept or found[1]
    broken = #kept.broken > 0
    if jumps then -- the force stays what it is
      table.insert(path.force, force)
      table.insert(path.tip, path.tip[#path.tip])
      path.jump = force
    end
    table.insert(path.tip, -kept:deflection(L))
    table.insert(path.force, force)
  end
  return path
end
local up <const>, down <const> = follow(1e-3, 1.25 * breaks), follow(1.25 * breaks, 1e-3)
print(("the spring breaks at %.4f (%.4f) and is whole again at %.4f (%.4f)"):format(up.jump, breaks, down.jump, heals))
assert(math.abs(up.jump - breaks) < 0.004 * breaks and math.abs(down.jump - heals) < 0.004 * breaks)  -- a step of the force
local work = 0 -- what a cycle dissipates: the loop's area, by trapezia
for _, path in ipairs{ up, down } do
  for i = 2, #path.tip do work = work + 0.5 * (path.force[i] + path.force[i - 1]) * (path.tip[i] - path.tip[i - 1]) end
end
local exact <const> = 0.5 * (breaks^2 - heals^2) * (1 / c - 1 / (k + c))
print(("a cycle dissipates %.5g (%.5g)"):format(work, exact))
assert(math.abs(work / exact - 1) < 0.01)

local function every_sixth(curve)
  local out <const> = { x = {}, y = {} }
  for i = 3, #curve.x, 6 do
    table.insert(out.x, curve.y[i])
    table.insert(out.y, curve.x[i])
  end
  return out
end
local whole <const>, broken <const> = every_sixth(curves.whole), every_sixth(curves.broken)
dotyk.chart{ file = "images/breaking.png", title = "A cantilever's tip on a spring that breaks", x = "force", y = "deflection of the tip",
  series = { { name = "spring whole", x = whole.x, y = whole.y, style = "points" },
             { name = "spring broken", x = broken.x, y = broken.y, style = "points" },
             { name = "loading", x = up.force, y = up.tip, style = "line" },
             { name = "unloading", x = down.force, y = down.tip, reference = true } } }
dotyk.chart{ file = "images/breaking_energy.png", title = "Energy of the beam and its spring", x = "force", y = "energy",
  series = { { name = "whole", x = curves.whole.y, y = curves.whole.energy, style = "line" },
             { name = "broken", x = curves.broken.y, y = curves.broken.energy, style = "line" } } }

local between <const> = {} -- both states under a force between the two
for k, s in ipairs(branches(0.5 * (breaks + heals))) do
  between[k] = { solution = s, support = "right", title = #s.broken > 0 and "Broken" or "Whole" }
end
dotyk.support_gallery{ file = "images/breaking_states.png", title = "Both states under one force", rows = between }

-- 3. Several springs along the cantilever. A unit force at b moves the point a by C(a, b), so where those of a set W are
-- whole the springs' points move by F s, s + C_W k s = C(., L): a branch under forces at which every spring of W bears less
-- than g, F < g/(k s), and every other is displaced by more than what broke it, F > g/(k s).
local function flexibility(a, b)
  a, b = math.min(a, b), math.max(a, b)
  return a^2 * (3 * b - a) / (6 * EJ)
end
local function per_force(at, whole) -- s, by elimination without pivoting: leading minors are positive
  local n <const>, A, s = #at, {}, {}
  for i, x in ipairs(at) do
    A[i], s[i] = {}, flexibility(x, L)
    for j, y in ipairs(at) do A[i][j] = (i == j and 1 or 0) + (whole[j] and k * flexibility(x, y) or 0) end
  end
  for i = 1, n do
    for row = 1, n do
      local factor <const> = row ~= i and A[row][i] / A[i][i] or 0
      for j = 1, n do A[row][j] = A[row][j] - factor * A[i][j] end
      s[row] = s[row] - factor * s[i]
    end
  end
  for i = 1, n do s[i] = s[i] / A[i][i] end
  return s
end
local function sets(at) -- every W: from and up to which force it is a branch, and the tip's displacement per force
  local out <const> = {}
  for choice = 0, 2^#at - 1 do
    local whole <const>, names <const> = {}, {}
    for i = 1, #at do
      whole[i] = choice // 2^(i - 1) % 2 == 1
      names[#names + 1] = whole[i] and "o" or "x"
    end
    local W <const> = { name = table.concat(names, " "), from = 0, to = math.huge }
    for i, s in ipairs(per_force(at, whole)) do
      assert(s > 0) -- every spring is pressed
      if whole[i] then W.to = math.min(W.to, g / (k * s)) else W.from = math.max(W.from, g / (k * s)) end
      W.tip = s
    end
    if W.from < W.to then out[#out + 1] = W end
  end
  return out
end
local function found(at, force) -- the branches that are found, by the names of their sets
  local inner <const>, out <const> = {}, {}
  for i = 1, #at - 1 do inner[i] = { x = at[i], deflection = dotyk.law.breaking(k, g) } end
  local all <const> = dotyk.solve(dotyk.beam{ length = L, EJ = EJ, cells = 10, loads = { { x = L, force = -force } }, supports = inner,
    left = { deflection = dotyk.law.prescribed(0), rotation = dotyk.law.prescribed(0) }, right = { deflection = dotyk.law.breaking(k, g) } }).branches
  for _, s in ipairs(all) do
    local names <const>, broken <const> = {}, table.concat(s.broken, ", ")
    for i, x in ipairs(at) do names[i] = broken:find(i == #at and "right" or ("x = %g deflection"):format(x), 1, true) and "x" or "o" end
    out[table.concat(names, " ")] = s
  end
  return out, #all
end
for _, at in ipairs{ { 1.2, 2 }, { 1, 1.6, 2 } } do
  local exact <const>, turns <const> = sets(at), {}
  print(("\n%d springs at %s (o whole, x broken): branches"):format(#at, table.concat(at, ", ")))
  for _, W in ipairs(exact) do
    print(("  %-6s under forces from %.5f to %.5f"):format(W.name, W.from, W.to))
    for _, turn in ipairs{ W.from, W.to } do
      if turn > 0 and turn < math.huge then turns[#turns + 1] = turn end
    end
  end
  local counted, most, off = 0, 0, 0
  for _, turn in ipairs(turns) do
    for _, force in ipairs{ turn * (1 - 1e-8), turn * (1 + 1e-8), 0.9 * turn, 1.1 * turn } do
      local all <const>, count <const> = found(at, force)
      local expected = 0
      for _, W in ipairs(exact) do
        local is <const> = W.from < force and force < W.to
        assert(is == (all[W.name] ~= nil))
        expected = expected + (is and 1 or 0)
        if is then off = math.max(off, math.abs(-all[W.name]:deflection(L) / (force * W.tip) - 1)) end
      end
      assert(count == expected)
      counted, most = counted + 1, math.max(most, count)
    end
  end
  print(("  %d forces, at the turns to 1e-8: the count is that of the closed form, %d at most; tips differ by %.1e"):format(counted, most, off))
  assert(off < 1e-10)
  if #at == 3 then
    local series <const>, greatest = {}, 1.15 * math.max(table.unpack(turns))
    for i, W in ipairs(exact) do
      local curve <const> = { name = W.name, x = {}, y = {}, style = "both" }
      local from <const>, to <const> = W.from, math.min(W.to, greatest)
      for j = 0, 4 do
        local force <const> = from + (to - from) * (0.001 + 0.998 * j / 4)
        table.insert(curve.x, force)
        table.insert(curve.y, -found(at, force)[W.name]:deflection(L))
      end
      series[i] = curve
    end
    dotyk.chart{ file = "images/breaking_branches.png", title = "Springs from the wall: o whole, x broken", x = "force", y = "deflection of the tip", series = series }
  end
end
print "images/breaking.png, images/breaking_energy.png, images/breaking_states.png, images/breaking_branches.png"
