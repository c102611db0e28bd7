-- A node of a contact part may also be held in the normal direction.
local check <const> = require "check"

local material <const> = dotyk.material{ E = 10, nu = 0 }
local function bar(element)
  local b = dotyk.body{ material = material,
                        mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4}, element = element } }
  b:part "top":displace{ y = -0.1 }
  b:part "left":fix "x"
  return b, dotyk.scene{ b }
end
local floor <const> = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }

for _, element in ipairs{ "P1", "Q1" } do
  for _, reduced in ipairs{ true, false } do
    local solver = dotyk.solver.pdas{ reduced = reduced }
    -- Half of the contact part is held: the uniform state of stress 1 is shared by support and floor.
    local b, scene = bar(element)
    local half = b:part("half", function(x, y, nx, ny) return ny < 0 and x < 0.5 end)
    half:fix "y"
    local c = scene:contact{ b:part "bottom", rigid = floor }
    local s = solver:solve(scene)
    local r = s:contact(c)
    check.that(s.converged)
    check.equal(s.rows, 2)  -- x = 0.75 and 1; three of the five nodes are held
    check.near(r.force, { 0, 0.375 })
    check.near({ s:reaction(half) }, { 0, 0.625 })
    check.near(r.max_pressure, 1)
    check.near(s.residual.equilibrium, 0)
    -- All of it: the contact has nothing to do.
    b, scene = bar(element)
    b:part "bottom":fix "y"
    c = scene:contact{ b:part "bottom", rigid = floor }
    s = solver:solve(scene)
    check.equal(s.rows, 0)
    check.near(s:contact(c).force, { 0, 0 })
    check.near({ s:reaction(b:part "bottom") }, { 0, 1 })
    -- Held inside the obstacle: no displacement helps, and that is said.
    b, scene = bar(element)
    b:part "bottom":fix "y"
    scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0.1}, normal = {0,1} }, interference = true }
    check.error(function() solver:solve(scene) end, "the node at (0, 0) is fixed in the normal direction and lies 0.1 inside")
  end
end

-- Given friction does not ask for the pressure: it acts at nodes that are held in the normal direction, too. A block held there
-- and drawn along the floor slips when the load exceeds g times its length, which friction then carries; the spring carries the rest.
for _, element in ipairs{ "P1", "Q1" } do
  local b <const> = dotyk.body{ material = material, mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4}, element = element } }
  b:part "bottom":fix "y"
  b:part "top":fix "y"
  b:part "right":load{ 3, 0 }
  b:part "left":spring{ x = 1 }
  local scene <const> = dotyk.scene{ b }
  local c <const> = scene:contact{ b:part "bottom", rigid = floor, friction = dotyk.friction.tresca(0.5) }
  local s <const> = dotyk.solve(scene)
  check.that(s.converged)
  check.near(s:contact(c).force, { -0.5, 0 })
  check.near((s:reaction(b:part "left")), -2.5)
end
