-- A cube on a rigid plane with given friction: the free body of TR965, section 3.2, with the report's multipliers.
--
--   ./dotyk scripts/papers/tr965/cube_with_friction.lua [FINEST]
--
-- The unit cube may move and turn in the x z plane: its front, perpendicular to y, slides, its bottom lies on a rigid
-- plane. Its top is pressed down by p and pushed along x by q (force per area). Friction has the given bound g, also
-- where the cube lifts off. Pressure is continuous and linear on the faces, friction constant on cells of extent 1/2.
-- 1. Which loads can be carried? By (3.30) those with S(w) < j(w) for each rigid motion w that the plane admits. A
--    translation along x does the work q against g, whatever p: q < g. A turn about the line x = a of the bottom does
--    the work q − p (a − 1/2), and friction does none: q < p (a − 1/2). With nodal forces a = 1, the edge. Linear
--    multipliers forbid penetration only in the mean, weighted with each node's shape function: a is the farthest
--    centre of gravity of these, 1 − h/3 on squares and 1 − h/4 on triangles (a corner with one triangle). So this
--    cube tips too early, by p h/3 or p h/4, which vanish with h = 1/n. scene:balance() must find all these limits.
-- 2. Newton's method, the report's alternating algorithm (uzawa_pdas) and projected_cg solve each load below them and
--    refuse each beyond. Displacement (L2, relative) and friction (relative to g) must agree to 1e-6.
-- 3. Near the limit, q = (1 − d) g: cells that slip turn their friction towards −x. A slip of s leaves angles like
--    1/s, whose cosines fall short of 1 by 1/s²: s grows like 1/√d. Newton's count grows like log(1/d).
-- Prints tables and draws images/papers_cube_with_friction.png. Meshes have n³ cells, n = 4 to FINEST.

local finest <const> = math.max(4, tonumber(arg[1]) or 6)
local common <const> = include "../../lib/common.lua"
local g <const>, H <const>, meshes <const> = 1, 1 / 2, {}
for _, element in ipairs{ "P1", "Q1" } do
  for n = 4, finest do meshes[#meshes + 1] = { element, n } end
end
local off, apart, scaled, count, shown = 0, 0, {}, { solved = 0, refused = 0, newton = 0 }, nil

local function cube(mesh, p, q, nodal)
  local body = dotyk.body{ name = "cube", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {mesh[2], mesh[2], mesh[2]}, element = mesh[1] } }
  body:part"front":slide()
  body:part"top":load{ q, 0, -p }
  local scene = dotyk.scene{ body }
  return scene, scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0, 0}, normal = {0, 0, 1} },
    friction = dotyk.friction.tresca(g), multipliers = nodal and "nodal" or "P1-P0", friction_size = not nodal and H or nil }, body
end
local function limits(mesh, p, nodal) -- of q: the lesser, and that of tipping
  local tips = p * (1 / 2 - (nodal and 0 or 1 / (mesh[1] == "Q1" and 3 or 4) / mesh[2]))
  return math.min(g, tips), tips
end

-- 1. The limits, by bisection on scene:balance().
print "greatest q/g that scene:balance() grants, and whether the cube slides or tips beyond it"
for _, mesh in ipairs(meshes) do
  for _, nodal in ipairs{ false, true } do
    local line = ("%s  n = %d  %-5s "):format(mesh[1], mesh[2], nodal and "nodal" or "P1-P0")
    for _, p in ipairs{ 0.5 * g, 1.4 * g, 1.8 * g, 3 * g } do
      local limit, tips = limits(mesh, p, nodal)
      local function carried(q) return cube(mesh, p, q, nodal):balance().solvable end
      local found = common.boundary(0.9 * limit, 1.1 * limit, carried, 1e-8)
      local motion = cube(mesh, p, 1.001 * limit, nodal):balance().motion
      assert((motion:find "rotation" ~= nil) == (tips < g), motion)
      off = math.max(off, math.abs(found / limit - 1))
      line = line .. ("   p = %.1f g: %.4f %s"):format(p / g, found / g, tips < g and "tips" or "slides")
    end
    print(line)
  end
end

-- 2. The loads, by three methods.
local function compare(mesh, p, q)
  local scene, contact = cube(mesh, p, q)
  local line, first, u, friction = ("%-7s %2d  %3.1f  %6.4f"):format(mesh[1], mesh[2], p / g, q / g), nil, 0, 0
  for _, name in ipairs{ "newton", "uzawa_pdas", "projected_cg" } do
    local solved, s = pcall(function() return dotyk.solver[name]{ max_iterations = 20000 }:solve(scene) end)
    assert(solved == (q < limits(mesh, p)) and (solved or tostring(s):find("not held", 1, true)), s)
    if solved then
      local c = s:contact(contact)
      assert(s.converged and #s.warnings == 0 and math.abs(c.friction_force[1] + q) < 1e-8 * g, s.reason)
      first = first or s
      u = math.max(u, s:distance(first).displacement)
      for k, node in ipairs(first:contact(contact).nodes) do
        for i = 1, 2 do friction = math.max(friction, math.abs(node.shear[i] - c.nodes[k].shear[i]) / g) end
      end
      line = line .. ("  %12d"):format(s.iterations)
    end
  end
  count.solved, count.refused = count.solved + (first and 1 or 0), count.refused + (first and 0 or 1)
  if not first then return print(line .. "  refused by all: it " .. (limits(mesh, p) == g and "slides" or "tips")) end
  count.newton, apart = math.max(count.newton, first.iterations), math.max(apart, u, friction)
  local c = first:contact(contact)
  print(line .. ("   %5d %5d %5d   %.0e   %.0e"):format(c.stick, c.slip, c.open, u, friction))
  return first
end
print "\n                               iterations                       nodes          greatest difference"
print "element  n  p/g     q/g        newton    uzawa_pdas  projected_cg   stick  slip  open       u   friction"
for _, mesh in ipairs(meshes) do
  for _, p in ipairs{ 1.4 * g, 3 * g } do
    for _, q in ipairs{ 0.9 * limits(mesh, p), 1.01 * limits(mesh, p), 0.8 * g, 0.5 * g } do shown = compare(mesh, p, q) end
  end
end

-- 3. Towards the limit of sliding.
for power = 2, 3 do compare({ "Q1", 4 }, 3 * g, (1 - 10.0^-power) * g) end
print "\n    d  newton   slip  slip·√d"
for power = 2, 6 do
  local scene, _, body = cube({ "Q1", 4 }, 3 * g, (1 - 10.0^-power) * g)
  local s = dotyk.solver.newton{}:solve(scene)
  local slip = s:displacement(body, 0.5, 0.5, 0) -- of the bottom's middle
  scaled[power] = slip * 10^(-power / 2)
  print(("1e-%02d  %6d  %.4f  %.3e"):format(power, s.iterations, slip, scaled[power]))
  assert(s.converged and s.iterations <= 25, s.reason)
end

print(shown:render{ file = "images/papers_cube_with_friction.png", field = "von_mises", supports = true, loads = true,
  size = { 1200, 1000 }, title = ("Given friction, n = %d"):format(finest) })
common.verdict(off < 1e-6 and apart < 1e-6 and math.abs(scaled[6] / scaled[5] - 1) < 0.02, (
  "balance() finds the limits of rigid statics to %.0e; the %d loads below them are solved by all three methods, Newton's "
  .. "in at most %d iterations, with the same displacements and friction to %.0e; the %d loads beyond them are refused"):format(
  off, count.solved, count.newton, apart, count.refused))
