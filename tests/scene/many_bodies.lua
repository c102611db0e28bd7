-- A stack of a thousand bodies: the work grows with their number, whatever the friction, and seconds are told where they are spent.
local check <const> = require "check"

local function stack(count, friction)
  local bodies, material = {}, dotyk.material{ E = 1000, nu = 0.3 }
  for i = 1, count do
    local mesh = dotyk.mesh.rectangle{ from = { 0, i - 1 }, to = { 1, i }, cells = { 2, 2 } }
    bodies[i] = dotyk.body{ name = "b" .. i, mesh = mesh, material = material }
    if not friction then bodies[i]:part"left":fix"x" end
  end
  bodies[count]:part"top":load{ 0, -1 }
  bodies[count]:part"top":fix"x"
  local scene = dotyk.scene(bodies)
  local ground = scene:contact{ bodies[1]:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }, friction = friction }
  for i = 2, count do scene:contact{ bodies[i]:part"bottom", bodies[i - 1]:part"top", friction = friction } end
  return scene, ground
end

for _, friction in ipairs{ false, dotyk.friction.coulomb(0.3) } do
  local scene, ground = stack(1000, friction or nil)
  local s <const> = dotyk.solve(scene)
  check.equal({ s.converged, s.method }, { true, "pdas (held)" }, s.reason)
  check.near(math.abs(s:contact(ground).force[2]), 1, 1e-8)
  local t <const> = s.time
  local told <const> = t.assembly + t.motions + t.ordering + t.factor + t.iterate + t.recover
  check.equal(told > 0.5 * t.total, true, "seconds told of those spent")
end

-- Condensed rows give the same.
for _, friction in ipairs{ false, dotyk.friction.coulomb(0.3) } do
  local scene <const> = stack(30, friction or nil)
  local condensed <const> = (friction and dotyk.solver.newton{} or dotyk.solver.pdas{}):solve(scene)
  check.near(dotyk.solver.pdas{ reduced = false }:solve(scene).energy, condensed.energy, 1e-9 * math.abs(condensed.energy))
end
