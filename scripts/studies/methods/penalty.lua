-- The penalty method: what is lost with soft springs, and with stiff ones.
--
--   ./dotyk scripts/studies/methods/penalty.lua [CELLS]
--
-- A rigid parabola pressed into a block, contact springs from as stiff as the contact nodes to
-- 1e14 times as stiff. Too soft, the bodies overlap: error ~ 1/factor. Too stiff, the classical way (springs added to the stiffness matrix, forces
-- from the overlap) loses digits: error ~ factor. On the contact rows, with forces as unknowns, nothing is lost.
-- Shows errors of force and energy against pdas, what the method says of itself, and images/penalty.png.

local n <const> = tonumber(arg[1]) or 64
local mesh <const> = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {n, n // 2} }
local block <const> = dotyk.body{ name = "block", mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 } }
block:part"bottom":fix()
local scene <const> = dotyk.scene{ block }
local contact <const> = scene:contact{ block:part"top",
  rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 - 0.02 end } }
local exact <const> = dotyk.solver.pdas{}:solve(scene)
local nodes <const> = exact:contact(contact).nodes

-- 1. Error of the contact forces, node by node, in the mean square.
local function force_error(s)
  local off, size = 0, 0
  for k, node in ipairs(s:contact(contact).nodes) do
    off, size = off + (node.force - nodes[k].force)^2, size + nodes[k].force^2
  end
  return math.sqrt(off / size)
end

-- 2. The sweep.
print "            classical                                            | on the contact rows"
print "  factor    penetration  energy off  said     forces off  conv.  |  energy off  said     forces off  conv."
local classical, rows, said = { x = {}, y = {} }, { x = {}, y = {} }, { x = {}, y = {} }
local function note(curve, x, y)
  if y > 0 then curve.x[#curve.x + 1], curve.y[#curve.y + 1] = x, y end
end
local best
for power = 0, 14 do
  local factor = 10.0^power
  local c = dotyk.solver.penalty{ factor = factor, reduced = false }:solve(scene)
  local r = dotyk.solver.penalty{ factor = factor }:solve(scene)
  local function off(s) return math.abs(s.energy - exact.energy) / exact.energy end
  local function estimate(s) return s.penalty.energy / exact.energy end
  print(("   1e%02d     %8.1e     %8.1e   %8.1e   %8.1e   %-5s  |  %8.1e   %8.1e   %8.1e   %s"):format(power, c.penalty.penetration,
    off(c), estimate(c), force_error(c), c.converged, off(r), estimate(r), force_error(r), r.converged))
  note(classical, factor, force_error(c))
  note(rows, factor, force_error(r))
  note(said, factor, estimate(r))
  if c.converged and (not best or force_error(c) < best.error) then best = { factor = factor, error = force_error(c) } end
end
print(("classical: at best %.0e of the forces, at factor %.0e; pdas takes %d iterations and needs no factor"):format(
  best.error, best.factor, exact.iterations))

-- 3. The figure.
dotyk.chart{ file = "images/penalty.png", x = "stiffness of springs / of contact nodes", y = "relative error",
  log = "xy", slopes = { -1, 1 }, series = {
    { name = "forces, classical penalty", x = classical.x, y = classical.y },
    { name = "forces, as unknowns", x = rows.x, y = rows.y },
    { name = "energy, own estimate", x = said.x, y = said.y, style = "line" } } }
print "images/penalty.png"
