-- A support that breaks: its law is not monotone, and the beam has up to two states of equilibrium under one load
-- (P4, figures 16 and 17).
--
--   ./dotyk scripts/breaking.lua
--
-- A cantilever's tip rests on a spring that pushes with up to g and then breaks. Whole, the tip goes down by F/(k + c),
-- c = 3 EJ/L^3 the cantilever's own stiffness, as long as the spring bears less than g; broken, by F/c, as long as that
-- is more than what broke it. Between the two forces both are local minima of the energy. Shown: every branch under
-- every force against the closed form; the loop that loading and unloading runs through where a state is kept as long as
-- it is a minimum; the energies; both states under one force, and where they lie on the law. images/breaking.png,
-- images/breaking_energy.png, images/breaking_states.png.

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
  local path <const>, broken = { x = {}, y = {} }, from > to
  for i = 0, 400 do
    local force <const> = from + (to - from) * i / 400
    local found <const> = branches(force)
    local kept
    for _, s in ipairs(found) do
      if (#s.broken > 0) == broken then kept = s end
    end
    kept = kept or found[1]
    broken = #kept.broken > 0
    table.insert(path.x, -kept:deflection(L))
    table.insert(path.y, force)
  end
  return path
end
local up <const>, down <const> = follow(1e-3, 1.25 * breaks), follow(1.25 * breaks, 1e-3)
local function jump(path) -- the force at which the state jumps
  for i = 2, #path.x do
    if math.abs(path.x[i] - path.x[i - 1]) > 0.01 then return path.y[i] end
  end
end
print(("the spring breaks at %.4f (%.4f) and is whole again at %.4f (%.4f)"):format(jump(up), breaks, jump(down), heals))
assert(math.abs(jump(up) - breaks) < 0.004 * breaks and math.abs(jump(down) - heals) < 0.004 * breaks)  -- a step of the force
local work = 0 -- what a cycle dissipates: the loop's area, by trapezia
for _, path in ipairs{ up, down } do
  for i = 2, #path.x do work = work + 0.5 * (path.y[i] + path.y[i - 1]) * (path.x[i] - path.x[i - 1]) end
end
local exact <const> = 0.5 * (breaks^2 - heals^2) * (1 / c - 1 / (k + c))
print(("a cycle dissipates %.5g (%.5g)"):format(work, exact))
assert(math.abs(work / exact - 1) < 0.01)

dotyk.chart{ file = "images/breaking.png", title = "A cantilever's tip on a spring that breaks", x = "tip, downwards", y = "force",
  series = { { name = "whole", x = curves.whole.x, y = curves.whole.y, style = "points" },
             { name = "broken", x = curves.broken.x, y = curves.broken.y, style = "points" },
             { name = "loading", x = up.x, y = up.y, style = "line" },
             { name = "unloading", x = down.x, y = down.y, style = "line" } } }
dotyk.chart{ file = "images/breaking_energy.png", title = "Energies of both states", x = "force", y = "energy",
  series = { { name = "whole", x = curves.whole.y, y = curves.whole.energy, style = "line" },
             { name = "broken", x = curves.broken.y, y = curves.broken.energy, style = "line" } } }

local between <const> = {} -- both states under a force between the two
for k, s in ipairs(branches(0.5 * (breaks + heals))) do
  between[k] = { solution = s, support = "right", title = #s.broken > 0 and "Broken" or "Whole" }
end
dotyk.support_gallery{ file = "images/breaking_states.png", title = "Both states under one force", rows = between }
print "images/breaking.png, images/breaking_energy.png, images/breaking_states.png"
