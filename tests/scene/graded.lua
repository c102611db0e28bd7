-- Contact and glue on strongly graded meshes: a uniform pressure passes from body to body as on even ones, or a warning says by how much
-- rounding may spoil it.
local is <const> = require("check").that

local steel <const> = dotyk.material{ E = 1000, nu = 0.3 }
-- Of the unit interval; at a degree of 15 the first of twelve cells is 8e-7 of the whole.
local function grading(degree) return function(x) return (math.exp(degree * x) - 1) / (math.exp(degree) - 1) end end

local function body(name, dimension, base, element, degree)
  local space <const> = dimension == 3
  local generate <const> = space and dotyk.mesh.box or dotyk.mesh.rectangle
  local b = dotyk.body{ name = name, material = steel, mesh = generate{
    from = space and {0, 0, base} or {0, base}, to = space and {2000, 2000, base + 1000} or {2000, base + 1000},
    cells = space and {8, 4, 2} or {12, 2}, element = element, grading = { x = grading(degree or 15) } } }
  b:part"left":slide()
  if space then b:part"front":slide() end
  return b
end

for _, dimension in ipairs{ 2, 3 } do
  for _, element in ipairs{ "P1", "Q1", "Q2" } do
    local lower <const>, upper <const> = body("lower", dimension, 0, element), body("upper", dimension, 1000, element)
    lower:part"bottom":slide()
    upper:part"top":pressure(10)
    local scene <const> = dotyk.scene{ lower, upper }
    local contact <const> = scene:contact{ upper:part"bottom", lower:part"top", pairing = "matching" }
    local s <const> = dotyk.solve(scene)
    is(s.converged, s.reason)
    is(s.time.pairing > 0)
    for _, node in ipairs(s:contact(contact).nodes) do
      is(node.status == "closed" and math.abs(node.pressure - 10) < 1e-3, ("%d-D %s: pressure %g at %g"):format(dimension, element, node.pressure, node.x))
    end
    local glued <const> = dotyk.scene{ lower, upper }
    glued:glue{ upper:part"bottom", lower:part"top", pairing = "matching" }
    local t <const> = dotyk.solve(glued)
    local at <const> = dimension == 3 and {1e-4, 1, 1000} or {1e-4, 1000}
    local stress <const> = t:stress(upper, table.unpack(at))
    is(math.abs((dimension == 3 and stress.zz or stress.yy) + 10) < 1e-3, stress.yy)
  end
end

-- Cells so thin that rounding of their stiffness is beside the pressure: what is off is warned of, by no less.
local warned = 0
for _, element in ipairs{ "P1", "Q1", "Q2" } do
  for degree = 15, 28 do
    local lower <const>, upper <const> = body("lower", 2, 0, element, degree), body("upper", 2, 1000, element, degree)
    lower:part"bottom":slide()
    upper:part"top":pressure(10)
    local scene <const> = dotyk.scene{ lower, upper }
    local contact <const> = scene:contact{ upper:part"bottom", lower:part"top", pairing = "matching" }
    local s <const> = dotyk.solve(scene)
    local off = 0
    for _, node in ipairs(s:contact(contact).nodes) do off = math.max(off, math.abs(node.pressure - 10)) end
    local said <const> = tonumber((s.warnings[1] or ""):match "rounding leaves the pressure uncertain by (%S+)")
    warned = warned + (said and 1 or 0)
    is(not s.converged or off < 0.1 or (said and off < 2 * said), ("%s, degree %d: off by %g, said %s"):format(element, degree, off, said))
    is(degree > 15 or not said, "no warning where all is well")
  end
end
is(warned > 10)
