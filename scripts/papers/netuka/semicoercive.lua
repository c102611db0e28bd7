-- Active sets on semicoercive contact: bodies that nothing but contact holds (Netuka, ODAM 2001, 101–125).
--
--   ./dotyk scripts/papers/netuka/semicoercive.lua [FINEST]
--
-- min ½uᵀKu − fᵀu subject to Bu ≤ c with singular K. Four scenes, refined: the active-set method changing one
-- row in a step, and many, from rest and without a guess; the singular KKT systems it met and survived; beside
-- it interior point, penalty and the primal-dual active set. FINEST: cells along the finest contact.
-- Draws images/semicoercive.png: iterations against the number of contact rows.

local finest <const> = tonumber(arg[1]) or 64

-- 1. The scenes.
local scenes <const> = include "../../lib/semicoercive.lua"

-- 2. The methods, all cold.
local methods <const> = {
  { name = "one row a step", make = dotyk.solver.active_set{ change = "one" } },
  { name = "many rows a step", make = dotyk.solver.active_set{ change = "many" } },
  { name = "interior point", make = dotyk.solver.interior_point{} },
  { name = "penalty 1000", make = dotyk.solver.penalty{ factor = 1000 } },
  { name = "PDAS", make = dotyk.solver.pdas{} },
}

local function distance(s, exact) return math.abs(s.energy - exact.energy) / math.abs(exact.energy) end

-- 3. Every scene at every size by every method.
print "                             |  one row a step             | many rows a step           |  interior |   penalty 1000  | pdas"
print "scene                rows  n |  it  in/out   singular  diff |  it  in/out  singular  diff |  it  diff |  it   off  said |  it"
local met, survived, zigzags, worst = 0, 0, 0, 0
for _, scene in ipairs(scenes) do
  for _, method in ipairs(methods) do method[scene.name] = { x = {}, y = {} } end
  for _, n in ipairs(scene.sizes) do
    if n <= finest then
      local solutions = {}
      for k, method in ipairs(methods) do
        local s = method.make:solve(scene.make(n))
        assert(s.converged, ("%s, %s: %s"):format(scene.name, method.name, s.reason))
        solutions[k] = s
        local curve = method[scene.name]
        curve.x[#curve.x + 1], curve.y[#curve.y + 1] = s.rows, s.iterations
        if s.working_set then
          met, survived = met + s.working_set.singular, survived + s.working_set.survived
          zigzags = zigzags + s.working_set.repeats
        end
      end
      local one, many, interior, penalty, pdas = table.unpack(solutions)
      local function counts(s)
        local w = s.working_set
        return ("%4d %3d/%-3d %4d/%-4d %5.0e"):format(s.iterations, w.added, w.dropped, w.survived, w.singular, distance(s, pdas))
      end
      worst = math.max(worst, distance(one, pdas), distance(many, pdas))
      print(("%-19s %5d %2d | %s | %s | %3d %5.0e | %3d %5.0e %5.0e | %3d"):format(scene.name, pdas.rows, n, counts(one), counts(many),
        interior.iterations, distance(interior, pdas), penalty.iterations, distance(penalty, pdas),
        penalty.penalty.energy / math.abs(penalty.energy), pdas.iterations))
    end
  end
end
print "it: KKT systems or linear solves; in/out: rows that entered and left the working set; singular: survived/met;"
print "diff, off: of the energy, relative to pdas; said: what penalty itself estimates."
print(("%d singular KKT systems met, %d of them survived; zigzagging noticed %d times; energies within %.0e"):format(
  met, survived, zigzags, worst))

-- 4. The figure: the blocks and the ball. Penalty is pdas with springs and would hide its curves.
local series = {}
for _, method in ipairs(methods) do
  local plane, space = method["five blocks apart"], method["ball in a corner"]
  if method.name ~= "penalty 1000" then
    series[#series + 1] = { name = method.name, x = plane.x, y = plane.y }
    series[#series + 1] = { x = space.x, y = space.y, twin = true }
  end
end
dotyk.chart{ file = "images/semicoercive.png", title = "Five blocks; dashed: ball in a corner", x = "contact nodes",
             y = "iterations", y_range = { 1, 1000 }, log = "xy", series = series, size = { 1000, 750 } }
print "images/semicoercive.png"
assert(met == survived and worst < 1e-9)
