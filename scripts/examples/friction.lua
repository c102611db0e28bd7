-- Two blocks with friction between them, pulled sideways: where they stick, and where they slip.
--
--   ./dotyk scripts/examples/friction.lua [CELLS]
--
-- Coulomb and given friction under refinement (energies, counts, iterations), the load at which the
-- upper block slides off, the frictionless and the glued limits, and images/friction.png.

local finest <const> = tonumber(arg[1]) or 128

-- 1. The lower block is held below; the upper one, pulled by 2 and pressed by 10 per length, is held by nothing
-- but contact and friction.
local scenes <const> = include "../lib/friction.lua"

-- 2. Refinement.
local function refine(name, law)
  print(name)
  print "    n  unknowns       energy   friction term   stick  slip  open  iterations  seconds"
  local sizes = {}
  for k = 2, 0, -1 do sizes[#sizes + 1] = math.max(8, finest >> k) end
  local s, contact
  for _, n in ipairs(sizes) do
    local scene
    scene, contact = scenes.blocks(n, law)
    s = dotyk.solve(scene)
    local c = s:contact(contact)
    print(("%5d %9d  %.9f  %.9f  %6d %5d %5d  %10d  %7.3f"):format(
      n, s.unknowns, s.energy, s.friction_energy, c.stick, c.slip, c.open, s.iterations, s.time.total))
  end
  return s, contact
end
local s = refine("Coulomb, mu = 0.3:", dotyk.friction.coulomb(0.3))
refine("given friction, g = 2.5:", dotyk.friction.tresca(2.5))
print(s)

-- 3. The limit: the interface carries mu times the weight, 0.3 · 20 = 6, that is a pull of 3 on the
-- length 2; given friction of 2.5 carries a pull of 2.5.
for _, case in ipairs{ { "Coulomb", dotyk.friction.coulomb(0.3), 3 }, { "given", dotyk.friction.tresca(2.5), 2.5 } } do
  local name, law, limit = table.unpack(case)
  for _, pull in ipairs{ limit * (1 - 1e-4), limit * (1 + 1e-4) } do
    print(("%-8s pull %.5f: %s"):format(name, pull, scenes.blocks(16, law, { pull, -10 }):balance().verdict))
  end
end

-- 4. No friction, and no slip at all.
for _, g in ipairs{ 10, 100, math.huge } do
  local scene, contact = scenes.blocks(32, dotyk.friction.tresca(g))
  local t = dotyk.solve(scene)
  print(("given friction %g: energy %.9f, %d stick, %d slip"):format(g, t.energy, t:contact(contact).stick, t:contact(contact).slip))
end

-- 5. Given friction with multipliers of its own kind: pressure piecewise linear, friction constant on the dual
-- cells. Its energy approaches that with nodal forces faster than either the exact one.
print "given friction, nodal and P1-P0 multipliers: energies with the friction term, and the order of their difference"
local before
for n = 3, 6 do
  local energy = {}
  for _, multipliers in ipairs{ "nodal", "P1-P0" } do
    local t = dotyk.solve((scenes.blocks(1 << n, dotyk.friction.tresca(2.5), nil, multipliers)))
    energy[#energy + 1] = t.energy + t.friction_energy
  end
  local difference = math.abs(energy[1] - energy[2])
  print(("%5d  %.9f  %.9f  %.1e  %s"):format(1 << n, energy[1], energy[2], difference,
    before and ("%.2f"):format(math.log(before / difference, 2)) or ""))
  before = difference
end

-- 6. The figure.
local shown = dotyk.solve((scenes.blocks(math.min(48, finest), dotyk.friction.coulomb(0.3))))
shown:render{ file = "images/friction.png", field = "xy", units = { length = "mm", stress = "MPa", load = "MPa" }, supports = true, loads = true }
print "images/friction.png"
