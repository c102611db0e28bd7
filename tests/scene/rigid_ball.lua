-- A rigid ball says what a gap function of the same ball says, and what an indenter of its shape says that is almost rigid: with friction
-- too, where an approach must not count as slip. In the plane and in space, on a flat block and on a bulging one.
local R, depth = 8, 0.3
local soft, hard = dotyk.material{ E = 1000, nu = 0.3 }, dotyk.material{ E = 1e7, nu = 0.3 }
local function bulge(dim, k, x, y, z) return -k / 2 * (x^2 + (dim == 3 and y^2 or 0)) * (1 + z / 4) end

-- Half (in space a quarter) of a block 4 wide and high; above z = 0 the indenter's height h(x, y).
local function mesh(dim, n, low, high, height)
  local m
  if dim == 2 then
    m = dotyk.mesh.rectangle{ from = { 0, low }, to = { 4, high }, cells = { n, n }, element = "Q1" }
    m:transform(function(x, y) return x, y + height(x, 0, y) end)
  else
    m = dotyk.mesh.box{ from = { 0, 0, low }, to = { 4, 4, high }, cells = { n, n, low < 0 and n or 2 }, element = "Q1" }
    m:transform(function(x, y, z) return x, y, z + height(x, y, z) end)
  end
  return m
end
local function axis(dim, v) return dim == 2 and { 0, v } or { 0, 0, v } end

-- Sums of pressure and of the length of shear.
local function sums(kind, dim, n, k, friction)
  local block = dotyk.body{ name = "block", mesh = mesh(dim, n, -4, 0, function(x, y, z) return bulge(dim, k, x, y, z) end), material = soft }
  local function symmetric(b)
    b:part"left":fix "x"
    if dim == 3 then b:part"front":fix "y" end
  end
  symmetric(block)
  local function ball(x, y) return R - math.sqrt(R^2 - x^2 - (dim == 3 and y^2 or 0)) end
  local scene, contact
  local given = { [dim == 2 and "y" or "z"] = depth, x = 0 }
  if dim == 3 then given.y = 0 end
  if kind == "indenter" then
    local m = mesh(dim, n, 0, 4, function(x, y, z) return ball(x, y) * (1 - z / 4) end)
    local indenter = dotyk.body{ name = "indenter", mesh = m, material = hard }
    symmetric(indenter)
    block:part"bottom":fix()
    given[dim == 2 and "y" or "z"] = -depth
    indenter:part"top":displace(given)
    scene = dotyk.scene{ block, indenter }
    contact = scene:contact{ block:part"top", indenter:part"bottom", friction = friction }
  else
    block:part"bottom":displace(given)
    scene = dotyk.scene{ block }
    contact = scene:contact{ block:part"top", friction = friction, rigid = kind == "ball" and dotyk.rigid.ball{ center = axis(dim, R), radius = R }
                             or dotyk.rigid.gap{ normal = axis(dim, 1), gap = ball } }
  end
  local s = dotyk.solve(scene, { steps = { { load = 0.25 }, { load = 0.5 }, { load = 0.75 }, { load = 1 } } })
  assert(s.converged, s.reason)
  local pressure, shear = 0, 0
  for _, node in ipairs(s:contact(contact).nodes) do
    pressure = pressure + node.pressure * node.weight
    shear = shear + math.sqrt(node.shear[1]^2 + (node.shear[2] or 0)^2) * node.weight
  end
  return pressure, shear
end

local function near(a, b, tolerance, what)
  assert(math.abs(a / b - 1) < tolerance, ("%s: %.8g against %.8g"):format(what, a, b))
end

for _, dim in ipairs{ 2, 3 } do
  for _, mu in ipairs{ 0.1, 10 } do
    local friction = dotyk.friction.coulomb(mu)
    -- A flat block.
    local n = dim == 2 and 16 or 8
    local what = ("%d-D, mu = %g"):format(dim, mu)
    local P, S = sums("ball", dim, n, 0, friction)
    local gap_P, gap_S = sums("gap", dim, n, 0, friction)
    near(P, gap_P, 1e-6, what .. ", pressure of a gap function")
    near(S, gap_S, 1e-6, what .. ", shear of a gap function")
    local indenter_P, indenter_S = sums("indenter", dim, n, 0, friction)
    near(P, indenter_P, 0.01, what .. ", pressure of an indenter")
    near(S, indenter_S, 0.01, what .. ", shear of an indenter")
    -- A block that bulges as much as the ball, and a hollow of twice its radius.
    for _, k in ipairs{ 1 / R, -1 / (2 * R) } do
      P, S = sums("ball", dim, n, k, friction)
      indenter_P, indenter_S = sums("indenter", dim, n, k, friction)
      local bulging = ("%s, curvature %g"):format(what, k)
      near(P, indenter_P, 0.02, bulging .. ", pressure")
      near(S, indenter_S, 0.05, bulging .. ", shear")
    end
  end
end
