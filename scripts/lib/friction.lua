-- What the scripts on friction methods share: two blocks in the plane (C2, T2), a punch in space (S3C), a
-- dragged foot, and values of other codes. Loaded by include; solves nothing itself.

local scenes = {}
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }

-- A free block on a fixed one, both 2 long and 1 high, under a traction on top: C2 with Coulomb friction 0.3,
-- T2 with given friction 2.5, both with the traction (2, −10). `multipliers` as for scene:contact.
function scenes.blocks(n, law, traction, multipliers)
  local function half(name, y)
    return dotyk.body{ name = name, material = material,
      mesh = dotyk.mesh.rectangle{ from = {0, y}, to = {2, y + 1}, cells = {n, n // 2} } }
  end
  local lower, upper = half("lower", 0), half("upper", 1)
  lower:part"bottom":fix()
  upper:part"top":load(traction or { 2, -10 })
  local scene = dotyk.scene{ lower, upper }
  return scene, scene:contact{ upper:part"bottom", lower:part"top", friction = law, multipliers = multipliers or "nodal" }
end

-- The same, pulled up at its left end: that part of the interface opens.
function scenes.lifted(n, law)
  return scenes.blocks(n, law, function(x) return 1.5, x < 0.5 and 4 or -10 end)
end

-- S3C: a rigid paraboloid pressed straight down onto a cube. `multipliers` as for scene:contact.
function scenes.cube(n, law, multipliers)
  local cube = dotyk.body{ name = "cube", material = material,
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n} } }
  cube:part"bottom":fix()
  local scene = dotyk.scene{ cube }
  local punch = dotyk.rigid.gap{ normal = {0, 0, 1}, gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.02 end }
  return scene, scene:contact{ cube:part"top", rigid = punch, friction = law, multipliers = multipliers or "nodal" }
end

-- A block 2 long and 1 high, held at its bottom, which moves by (0.5, 0.05): the middle half of its top is
-- pressed against a rigid plane and dragged along it.
function scenes.foot(n, law, nu)
  local block = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = nu },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {n, n // 2} } }
  block:part"bottom":displace{ x = 0.5, y = 0.05 }
  local scene = dotyk.scene{ block }
  return scene, scene:contact{ block:part("foot", function(x, y) return y > 1 - 1e-9 and math.abs(x - 1) < 0.5 end),
    rigid = dotyk.rigid.plane{ point = {0, 1}, normal = {0, -1} }, friction = law }
end

-- A value of ../shared/reference/other_codes.csv: scene "C2", size "n=64", quantity; nil where there is none. shared: where that folder is.
function scenes.reference(shared, scene, size, quantity)
  local file = io.open(shared .. "/reference/other_codes.csv")
  if not file then return nil end
  local found
  for line in file:lines() do
    local label, rest = line:match '^"([^:"]*):[^"]*",(.*)$'
    if not label then label, rest = line:match "^([^,]*),(.*)$" end
    if label == scene and rest:sub(1, #size + #quantity + 2) == size .. "," .. quantity .. "," then
      found = tonumber(rest:sub(#size + #quantity + 3):match "^[^,]*")
    end
  end
  file:close()
  return found
end

return scenes
