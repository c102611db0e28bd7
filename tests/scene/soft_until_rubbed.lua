-- Given friction or contact holds what supports alone hold hardly: bodies on weak springs, thin strips. Loads alone would
-- move these far, and the rows of contact are small differences of such motions: they are to be right nevertheless.
local is <const> = require("check").that
local S <const> = dotyk.solver

local function solved(scene, label, method)
  local s <const> = method and method:solve(scene) or dotyk.solve(scene)
  is(s.converged, ("%s, %s: %s"):format(label, s.method, s.reason))
  return s
end

-- 1. A cube on springs a millionth of a millionth as stiff as it is, stuck to a plane by the friction of two conditions that say the same: their
-- forces are not unique. Only the springs take the moment of the load, and the cube turns until they do.
do
  local b <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.2 }, mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {2, 2, 2} } }
  local scene <const> = dotyk.scene{ b }
  for bound = 1, 2 do
    local wall <const> = dotyk.rigid.plane{ point = {-0.001 * bound, 0, 0}, normal = {1, 0, 0} }
    scene:contact{ b:part"left", rigid = wall, friction = dotyk.friction.tresca(bound) }
  end
  b:part"right":spring{ x = 1e-6, y = 1e-6, z = 1e-6 }
  b:part"bottom":spring{ x = 1e-6, y = 1e-6, z = 1e-6 }
  b:part"top":load({0, 0, -0.1})
  local s <const> = solved(scene, "a cube on weak springs")
  local least <const> = solved(scene, "a cube on weak springs", S.proximal{})
  is(math.abs(s.energy / least.energy - 1) < 1e-6, ("energies %.10g and %.10g"):format(s.energy, least.energy))
end

-- 2. A block that friction alone holds along the plane that it is near: on all unknowns as well.
do
  local b <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.2 }, mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2} } }
  local scene <const> = dotyk.scene{ b }
  local ground <const> = scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, -0.001}, normal = {0, 1} }, friction = dotyk.friction.tresca(10) }
  b:part"top":load({0.5, -1})
  for _, method in ipairs{ S.pdas{ reduced = false }, S.newton{} } do
    local s <const> = solved(scene, "held by friction", method)
    for _, node in ipairs(s:contact(ground).nodes) do is(math.abs(node.slip[1]) < 1e-9, "it slips by " .. node.slip[1]) end
  end
end
