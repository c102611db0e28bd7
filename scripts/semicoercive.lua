-- Active sets on semicoercive contact: bodies that nothing but contact holds (Netuka, ODAM 2001, 101–125).
--
--   ./dotyk scripts/semicoercive.lua [FINEST]
--
-- min ½uᵀKu − fᵀu subject to Bu ≤ c with singular K. Four scenes, refined: the active-set method changing one
-- row in a step, and many, from rest and without a guess; the singular KKT systems it met and survived; beside
-- it interior point, penalty and the primal-dual active set. FINEST: cells along the finest contact.
-- Draws images/semicoercive.png: iterations against the number of contact rows.

local finest <const> = tonumber(arg[1]) or 64
local stone <const> = dotyk.material{ E = 2000, nu = 0.25 }

local function block(name, n, low, high, arch)
  return dotyk.body{ name = name, material = stone, force = {0, -4},
    mesh = dotyk.mesh.rectangle{ from = {-1, low}, to = {1, high}, cells = {n, math.max(2, n // 4)}, element = "Q1" }
      :transform(function(x, y) return x, y + arch * x^2 * (high - y) / (high - low) end) } -- hollow below, flat above
end

-- 1. The scenes. None of the bodies has a support, but for symmetry.
local scenes <const> = {
  { name = "arch on the ground", sizes = { 8, 16, 32, 64 }, make = function(n)
    -- Touches in one node; that it does not roll is left to contact.
    local arch = block("arch", n, 0, 0.5, 0.02)
    arch:part"top":load(function(x) return 0, -20 - 5 * x end)
    local scene = dotyk.scene{ arch }
    scene:contact{ arch:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
    return scene
  end },
  { name = "five blocks apart", sizes = { 8, 16, 32, 64 }, make = function(n)
    -- Nothing touches at rest: every body has to fall first.
    local blocks = {}
    for k = 1, 5 do blocks[k] = block("block " .. k, n, 0.51 * k - 0.5, 0.51 * k, 0.003 * k) end
    local scene = dotyk.scene(blocks)
    scene:contact{ blocks[1]:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
    for k = 2, 5 do scene:contact{ blocks[k - 1]:part"top", blocks[k]:part"bottom" } end -- normals of the flat sides
    blocks[5]:part("load", function(x, _, _, ny) return ny > 0.9 and math.abs(x - 0.3) < 0.3 end):pressure(10)
    return scene
  end },
  { name = "block in a notch", sizes = { 8, 16, 32, 64 }, make = function(n)
    -- Two walls at 45°, at a distance: falls, meets one wall, slides down along it to the other.
    local b = dotyk.body{ name = "block", material = stone, force = { 0.5, -4 },
      mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, n}, element = "Q1" }:transform(
        function(x, y) return (x - y) / math.sqrt(2), (x + y) / math.sqrt(2) end) }
    local scene = dotyk.scene{ b }
    for side, nx in pairs{ left = -1, bottom = 1 } do
      scene:contact{ b:part(side), rigid = dotyk.rigid.plane{ point = {0, -0.02 + 0.004 * nx}, normal = { -nx, 1 } } }
    end
    return scene
  end },
  { name = "ball in a corner", sizes = { 4, 6, 8, 10 }, make = function(n)
    -- Three planes at right angles to each other, at three distances; the ball is free to spin.
    local ball = dotyk.body{ name = "ball", material = stone, force = { 0.3, 0.1, -4 },
      mesh = dotyk.mesh.box{ from = {-1, -1, -1}, to = {1, 1, 1}, cells = {n, n, n}, element = "Q1" }
        :transform(function(x, y, z) -- the cube onto the ball
          return x * math.sqrt(1 - y^2 / 2 - z^2 / 2 + y^2 * z^2 / 3),
                 y * math.sqrt(1 - z^2 / 2 - x^2 / 2 + z^2 * x^2 / 3),
                 z * math.sqrt(1 - x^2 / 2 - y^2 / 2 + x^2 * y^2 / 3)
        end) }
    local scene = dotyk.scene{ ball }
    for k = 1, 3 do
      local a = math.rad(120 * k + 10)
      local nx, ny, nz = math.sqrt(2 / 3) * math.cos(a), math.sqrt(2 / 3) * math.sin(a), math.sqrt(1 / 3)
      local distance = 1 + 0.005 * k
      local part = ball:part("side " .. k, function(_, _, _, mx, my, mz) return mx * nx + my * ny + mz * nz < -0.75 end)
      scene:contact{ part, rigid = dotyk.rigid.plane{ point = { -distance * nx, -distance * ny, -distance * nz },
                                                      normal = { nx, ny, nz } } }
    end
    return scene
  end },
}

-- 2. The methods, all cold.
local methods <const> = {
  { name = "one row a step", make = dotyk.solver.active_set{ change = "one" } },
  { name = "many rows a step", make = dotyk.solver.active_set{ change = "many" } },
  { name = "interior point", make = dotyk.solver.interior_point{} },
  { name = "penalty 1000", make = dotyk.solver.penalty{ factor = 1000 } },
  { name = "pdas", make = dotyk.solver.pdas{} },
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
dotyk.chart{ file = "images/semicoercive.png", x = "contact rows (solid: five blocks apart, dashed: ball in a corner)",
             y = "iterations", log = "xy", series = series, size = { 1000, 750 } }
print "images/semicoercive.png"
assert(met == survived and worst < 1e-9)
