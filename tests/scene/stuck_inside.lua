-- Friction that nothing overcomes holds a node which an interference would push aside: no displacement does both, along axes or inclined.
local check <const> = require "check"

for _, angle in ipairs{ 0, 0.4 } do
  local c <const>, s <const> = math.cos(angle), math.sin(angle)
  local function turn(x, y) return c * x - s * y, s * x + c * y end
  local function scene(bound)
    local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
      mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {4, 2}, element = "Q1" }:transform(turn) }
    local all <const> = dotyk.scene{ block }
    all:contact{ block:part "left", rigid = dotyk.rigid.plane{ point = {turn(0.03, 0.5)}, normal = {c, s} }, interference = true }
    all:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {-s, c} }, friction = dotyk.friction.tresca(bound) }
    block:part "top":pressure(1)
    return all
  end
  check.error(function() dotyk.solve(scene(math.huge)) end, "lies 0.03 inside the other side", "no displacement can part them")
  check.that(dotyk.solve(scene(50)).converged)
end
