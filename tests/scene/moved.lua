-- solution:moved: another member of a solution that is unique up to a rigid motion; TR965's p(v) = 0 (1.77)–(1.78).
local check <const> = require "check"
local refused <const> = require "refused"

local function block(friction)
  local body <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 2, 1, 1 }, cells = { 4, 2, 2 } } }
  body:part"top":load(function(x, y) return 0, 0, -3 + 0.4 * x end)
  local scene <const> = dotyk.scene{ body }
  return scene, scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0, 0 }, normal = { 0, 0, 1 } }, friction = friction }, body
end

local scene <const>, contact <const>, body <const> = block()
local s <const> = dotyk.solve(scene)
check.that(s.reason:find "unique up to")
local u0, v0 = s:displacement(body, 1, 0.5, 0)
local moved <const> = s:moved{ body = body, translation = { -u0, -v0, 0 }, rotation = { 0, 0, 0.01 }, about = { 1, 0.5, 0 } }
local u, v = moved:displacement(body, 1, 0.5, 0)
check.near(u, 0, 1e-14)
check.near(v, 0, 1e-14)
local before <const>, after <const> = { s:displacement(body, 2, 1, 1) }, { moved:displacement(body, 2, 1, 1) }
check.near(after[1] - before[1], -u0 - 0.005, 1e-12)
check.near(after[2] - before[2], -v0 + 0.01, 1e-12)
check.near(after[3], before[3], 1e-12)
check.near(moved.energy, s.energy, 1e-12)
for k, node in ipairs(moved:contact(contact).nodes) do check.equal(node.pressure, s:contact(contact).nodes[k].pressure) end
check.that(moved.converged and moved.residual.law < 1e-9 and moved.residual.equilibrium < 1e-9)

-- Against contact, against supports, of another dimension.
refused.intact = function() check.near(moved.energy, s.energy, 1e-12) end
refused(function() s:moved{ body = body, translation = { 0, 0, -0.01 } } end, "contacts or laws do not allow it")
refused(function() s:moved{ body = body, translation = { 0, 0, 0.01 } } end, "contacts or laws do not allow it")
refused(function() s:moved{ body = body, translation = { 1, 0 } } end, "2 components in a scene of 3 dimensions")
refused(function() s:moved{ body = body, rotation = 1 } end, "in space it is a vector")
local held <const>, _, other <const> = block()
other:part"front":slide()
refused(function() dotyk.solve(held):moved{ body = other, translation = { 0, 0.1, 0 } } end, "its supports hold 'block'")
