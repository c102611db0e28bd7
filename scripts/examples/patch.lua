-- The contact patch test: two blocks pressed together with matching nodes carry a uniform pressure
-- exactly, for every element, in the plane and in space.
--
--   ./dotyk scripts/examples/patch.lua
--
-- Prints the greatest errors of stress and multipliers relative to the pressure, and of action
-- against reaction. All are at the level of rounding.

local p <const> = 10
local below <const>, above <const> = dotyk.material{ E = 1000, nu = 0.3 }, dotyk.material{ E = 3000, nu = 0.3 }

-- 1. Interior nodes are moved, so that cells are no boxes; the boundary stays.
local function distort(mesh, dimension)
  local function wobble(t, s) return 0.04 * math.sin(math.pi * t) * math.sin(2 * math.pi * s + 1) end
  if dimension == 2 then
    return mesh:transform(function(x, y)
      return x + wobble(x, y) * math.sin(math.pi * y), y + wobble(y, x) * math.sin(math.pi * x)
    end)
  end
  return mesh:transform(function(x, y, z)
    local inside = math.sin(math.pi * x) * math.sin(math.pi * y) * math.sin(math.pi * z)
    return x + 0.05 * inside * math.sin(3 * y + 1), y + 0.05 * inside * math.cos(4 * z), z + 0.05 * inside * math.sin(5 * x)
  end)
end

-- 2. Symmetric supports below and at the sides (free to widen), pressure on top.
local function test(element, dimension)
  local function block(name, base, material)
    local mesh = dimension == 2
      and dotyk.mesh.rectangle{ from = {0, base}, to = {1, base + 1}, cells = {5, 4}, element = element }
      or dotyk.mesh.box{ from = {0, 0, base}, to = {1, 1, base + 1}, cells = {4, 3, 3}, element = element }
    return dotyk.body{ name = name, mesh = distort(mesh, dimension), material = material }
  end
  local lower, upper = block("lower", 0, below), block("upper", 1, above)
  lower:part"bottom":slide()
  for _, body in ipairs{ lower, upper } do
    body:part"left":slide()
    body:part"right":slide()
    if dimension == 3 then
      body:part"front":slide()
      body:part"back":slide()
    end
  end
  upper:part"top":pressure(p)
  local scene = dotyk.scene{ lower, upper }
  local contact = scene:contact{ upper:part"bottom", lower:part"top" }
  local s = dotyk.solve(scene)

  -- 3. Uniform pressure, uniform stress, and the same force on both sides.
  local c = s:contact(contact)
  local multiplier, stress = 0, 0
  for _, node in ipairs(c.nodes) do multiplier = math.max(multiplier, math.abs(node.pressure / p - 1)) end
  local axis = dimension == 2 and "yy" or "zz"
  for _, body in ipairs{ lower, upper } do
    for k = 1, 9 do
      local t = (body == upper and 1 or 0) + k / 10
      local value = dimension == 2 and s:stress(body, 0.37, t) or s:stress(body, 0.37, 0.61, t)
      stress = math.max(stress, math.abs(value[axis] / p + 1))
    end
  end
  local reaction = { s:reaction(lower:part"bottom") }
  local balance = math.abs(c.force[dimension] / reaction[dimension] - 1)
  print(("%s in %d-D: stress %.1e, multipliers %.1e, action against reaction %.1e"):format(
    element, dimension, stress, multiplier, balance))
  return stress < 1e-11 and multiplier < 1e-11 and balance < 1e-12
end

local passed = true
for _, dimension in ipairs{ 2, 3 } do
  for _, element in ipairs{ "P1", "Q1" } do passed = test(element, dimension) and passed end
end
print(passed and "patch test passed" or "patch test FAILED")
if not passed then os.exit(1) end
