-- Tutorial 7: methods: which there are, what they cost, how to watch one.
--
--   ./dotyk scripts/tutorial/07_methods.lua
--
-- dotyk.solve takes the method that suits. To compare, or to teach, name one; help(dotyk.solver) lists them.

local function scene_of(level)
  local n <const> = 8 << level
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { -1, -1 }, to = { 1, 0 }, cells = { 2 * n, n } } }
  block:part"bottom":fix()
  local scene <const> = dotyk.scene{ block }
  return scene, scene:contact{ block:part"top", rigid = dotyk.rigid.gap{ normal = { 0, 1 }, gap = function(x) return x^2 - 0.02 end } }
end

-- 1. Watch active sets settle.
local watched <const> = dotyk.solver.pdas{ on_iteration = function(k, info)
  print(("  iteration %d: %d rows closed, %d changed, residual %.1e"):format(k, info.active, info.changed, info.residual))
end }
local s <const> = watched:solve((scene_of(3)))
print(s.reason)

-- 2. All of them end at the same solution.
local reference <const> = s.energy
for _, method in ipairs{ dotyk.solver.newton{}, dotyk.solver.projected_cg{}, dotyk.solver.interior_point{}, dotyk.solver.active_set{} } do
  local other <const> = method:solve((scene_of(3)))
  print(("%-32s %3d iterations, energy differs by %.0e"):format(other.method, other.iterations, math.abs(other.energy / reference - 1)))
  assert(other.converged and math.abs(other.energy / reference - 1) < 1e-8)
end

-- 3. Speed against accuracy, as a table and a chart: the finest level is compared with one still finer.
dotyk.work_precision{ scene = scene_of, levels = 3, repeats = 1, file = "images/tutorial_07.png", title = "A parabola on a block",
  methods = { dotyk.solver.pdas{}, dotyk.solver.projected_cg{}, dotyk.solver.interior_point{} } }
