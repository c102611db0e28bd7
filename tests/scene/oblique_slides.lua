-- Slides on oblique planes: turned by any angle, a scene has the solution that it has beside the axes, where supports take unknowns away. From a hundred
-- rows on they are no rows where no method is named; named methods have them as rows.
local check <const> = require "check"

local function scene_of(turn, contact, free, pushed)
  local c <const>, s <const> = math.cos(turn), math.sin(turn)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 0.8, 1}, cells = { 8, 7, 6 } }:transform(function(x, y, z) return c * x - s * y, s * x + c * y, z end) }
  if pushed then block:part"left":support{ normal = dotyk.law.prescribed(pushed) } else block:part"left":slide() end
  block:part"front":slide()
  local lid <const> = dotyk.body{ name = "lid", material = dotyk.material{ E = 50, nu = 0.2 },
    mesh = dotyk.mesh.box{ from = {0, 0, 1}, to = {1, 0.8, 1.3}, cells = { 9, 8, 2 } }:transform(function(x, y, z) return c * x - s * y, s * x + c * y, z end) }
  lid:part"left":slide()
  lid:part"front":slide()
  if free then block:part"bottom":support{ normal = dotyk.law.one_sided_elastic(100) } else block:part"bottom":fix "z" end
  lid:part"top":load{ 0.2 * c, 0.2 * s, -4 }
  local scene <const> = dotyk.scene{ block, lid }
  local pair <const> = contact{ lid:part"bottom", block:part"top" }
  local touching <const> = pair.glue and scene:glue{ pair[1], pair[2] } or scene:contact(pair)
  return scene, touching, block
end

local contacts <const> = {
  frictionless = function(pair) return pair end,
  coulomb = function(pair) pair.friction = dotyk.friction.coulomb(0.1) return pair end,
  glue = function(pair) pair.glue = true return pair end,
}
for name, contact in pairs(contacts) do
  for _, free in ipairs{ false, true } do
    local function solved(turn, solver)
      local scene <const>, touching <const>, block <const> = scene_of(turn, contact, free)
      local s <const> = solver and solver:solve(scene) or dotyk.solve(scene)
      local case <const> = ("%s, %s, turned by %g"):format(name, free and "free" or "held", turn)
      check.that(s.converged, case .. ": " .. s.reason)
      check.that(s.residual.equilibrium < 1e-9, case)
      local told <const> = tostring(scene:plan()):find("frames are turned", 1, true)
      check.that((told ~= nil) == (turn ~= 0), case .. ": " .. tostring(scene:plan()))
      return s, touching, block
    end
    local straight <const>, flat <const>, straight_block <const> = solved(0)
    local turned <const>, oblique <const>, turned_block <const> = solved(0.7)
    check.near(turned.energy, straight.energy, 1e-9 * math.abs(straight.energy))
    if name ~= "glue" then check.near(turned:contact(oblique).force[3], straight:contact(flat).force[3], 1e-8 * math.abs(straight:contact(flat).force[3])) end
    -- What the slides bear, in the turned frame.
    local fx <const> = straight:reaction(straight_block:part"left")
    local gx <const>, gy <const> = turned:reaction(turned_block:part"left")
    check.near(math.cos(0.7) * gx + math.sin(0.7) * gy, fx, 1e-8)  -- of a load of 4
    -- A named method has them as rows.
    local named <const> = solved(0.7, name == "coulomb" and dotyk.solver.newton{} or dotyk.solver.pdas{})
    check.near(named.energy, turned.energy, 1e-9 * math.abs(turned.energy))
    check.equal(named.rows, turned.rows)
  end
end

-- Displacements that are prescribed along oblique normals, too.
for _, name in ipairs{ "frictionless", "coulomb" } do
  local scene <const> = scene_of(0.7, contacts[name], false, 0.01)
  check.that(tostring(scene:plan()):find("frames are turned", 1, true), name)
  local s <const> = dotyk.solve(scene)
  local named <const> = (name == "coulomb" and dotyk.solver.newton{} or dotyk.solver.pdas{}):solve(scene)
  check.that(s.converged and named.converged, name)
  check.near(s.energy, named.energy, 1e-9 * math.abs(named.energy))
  check.that(s.residual.equilibrium < 1e-9 and s.residual.law < 1e-9, name)
end
