-- A thin strip at rest on a plane. Without the plane its weight would bend it by far more than it is compressed there, so that on the
-- condensed problem gaps are small differences of great numbers. They are to be right nevertheless: what the plane bears is the weight,
-- under every node its share, and the state is as near to its laws as displacements are known.
local is <const> = require("check").that

local weight <const> = 100
local function strip(length, height, cells, element, friction)
  local b = dotyk.body{ name = "strip", material = dotyk.material{ E = 1e4, nu = 0 }, force = {0, -weight},
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {length, height}, cells = {cells, 1}, element = element } }
  b:part"right":fix "x"
  local scene = dotyk.scene{ b }
  return scene, scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = friction }
end

local function rests(scene, contact, method, pressure, label)
  local s <const> = method and method:solve(scene) or dotyk.solve(scene)
  is(s.converged, label .. ": " .. s.reason)
  -- The state's residual goes with the condition of K, (length / height)^4 roundings, relative to the greatest displacement.
  is(s.residual.law <= 1e-6, label .. ": " .. s.residual.law)
  for _, node in ipairs(s:contact(contact).nodes) do
    is(node.status ~= "open" and math.abs(node.pressure / pressure - 1) < 1e-5, ("%s: %g at %g"):format(label, node.pressure, node.x))
  end
end

for _, case in ipairs{ {4, 0.01, 200, "Q1"}, {4, 0.01, 600, "Q1"}, {4, 0.004, 400, "Q1"}, {100, 0.1, 200, "Q1"}, {100, 0.1, 200, "Q2"}, {4, 0.02, 100, "Q1"} } do
  local scene <const>, contact <const> = strip(table.unpack(case))
  rests(scene, contact, nil, weight * case[2], table.concat(case, " "))
end
-- Methods on the rows, which share the refinement, and given friction.
for _, name in ipairs{ "newton", "proximal" } do
  local scene <const>, contact <const> = strip(4, 0.01, 300, "Q1")
  rests(scene, contact, dotyk.solver[name]{}, weight * 0.01, name)
end
local scene <const>, contact <const> = strip(4, 0.01, 200, "Q1", dotyk.friction.tresca(1))
rests(scene, contact, nil, weight * 0.01, "given friction")

-- A thin plate on springs at an end, which springs along it hold as well: equilibrium is as near as rounding of its terms allows.
for _, thickness in ipairs{ 1e-2, 2.5e-3 } do
  local plate <const> = dotyk.body{ name = "plate", material = dotyk.material{ E = 210e3, nu = 0.09 },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1.3, 0.8, thickness}, cells = {1, 3, 1} } }
  plate:part"left":spring{ x = 1.3e6, y = 1.3e6, z = 1.3e6 }
  plate:part"bottom":support{ tangential = dotyk.law.elastic(9e4) }
  plate:part"top":load{ -0.5, 1.1, -0.1 }
  local s <const> = dotyk.solve(dotyk.scene{ plate })
  is(s.converged, ("thickness %g: %s"):format(thickness, s.reason))
end
