-- Where a contact presses, and what its pressures are the pressures of, for cells of both orders.
local check <const> = require "check"

-- 1. A rigid parabola pressed into a block: the area is the width of contact, a = sqrt(4F/(pi E* k)) with gap k x²/2, here 0.8 % less (the block is finite),
-- on meshes that end anywhere beside it.
local function area(element, n)
  local block <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { -1, -1 }, to = { 1, 0 }, cells = { n, n // 2 }, element = element } }
  block:part "bottom":fix()
  local scene <const> = dotyk.scene{ block }
  local c <const> = scene:contact{ block:part "top", rigid = dotyk.rigid.gap{ normal = { 0, 1 }, gap = function(x) return x ^ 2 / 4 - 0.02 end } }
  local r <const> = dotyk.solve(scene):contact(c)
  return r.area / (2 * math.sqrt(-4 * r.force[2] * (1 - 0.3 ^ 2) / (math.pi * 1000 * 0.5)))
end
for _, element in ipairs{ "P1", "Q1", "P2", "Q2" } do
  local mean = 0
  for _, n in ipairs{ 40, 44, 48, 53, 58, 64 } do
    local ratio <const> = area(element, n)
    check.near(ratio, 0.992, 0.05, element .. " " .. n)
    mean = mean + ratio / 6
  end
  check.near(mean, 0.992, 0.025, element)
end

-- 2. Where all of a part presses, it is the part's, whatever the pressure; and linear pressures are those at `centre`, ends of the part among them (dual hats
-- do not make up linear functions: 0.3 %).
for _, element in ipairs{ "P2", "Q2" } do
  local block <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0 }, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 4, 2 }, element = element } }
  block:part "top":load(function(x) return 0, -(1 + x) end)
  block:part "bottom":fix "x"
  local scene <const> = dotyk.scene{ block }
  local c <const> = scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }
  local r <const> = dotyk.solve(scene):contact(c)
  check.near(r.area, 2, 1e-12)
  check.near({ r.nodes[1].centre[1], r.nodes[2].centre[1] }, { 0.5 / 3, 0.5 }, 1e-12)
  for _, node in ipairs(r.nodes) do
    check.near(node.pressure, 1 + node.centre[1], 6e-3)
    check.near(node.force, node.pressure * node.weight, 1e-12)
  end
end

-- 3. The same in space, at the corners of all kinds of facets: the mean over a hat function.
for element, third in pairs{ Q1 = 1 / 3, P1 = 1 / 4 } do
  local block <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0 }, mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { 1, 1, 1 }, element = element } }
  block:part "top":pressure(1)
  local scene <const> = dotyk.scene{ block }
  local c <const> = scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0, 0 }, normal = { 0, 0, 1 } } }
  local r <const> = dotyk.solve(scene):contact(c)
  check.near(r.area, 1, 1e-12)
  local x, weight = 0, 0
  for _, node in ipairs(r.nodes) do x, weight = x + node.weight * node.centre[1], weight + node.weight end
  check.near({ x, weight }, { 0.5, 1 }, 1e-12, element .. " " .. third) -- Σ ∫φ x = ∫x
end
