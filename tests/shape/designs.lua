-- Designs whose numbers and derivatives are known in closed form: a pressed block that grows.
local check <const> = require "check"
local E <const>, p <const> = 10, 3

-- Width 2 (1 + b), height 1 + a, Poisson's ratio 0, pressed by p on a rigid floor: u_y = -p y/E, the pressure p everywhere.
local function pressed(options)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = E, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {4, 3} } }
  block:part "top":load{ 0, -p }
  block:part "left":fix "x"
  local scene <const> = dotyk.scene{ block }
  local contact <const> = scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
  local it <const> = { scene = scene, moves = {
    { body = block, velocity = function(_, y) return 0, y end, lower = 0, upper = 1 },
    { body = block, velocity = function(x) return x, 0 end, lower = 0, upper = 1 } } }
  for key, value in pairs(options or {}) do it[key] = value end
  return dotyk.shape(it), block, contact
end
local shape <const>, block <const>, contact <const> = pressed()
check.equal(shape.variables, 2)
check.equal(shape.lower, { 0, 0 })
check.equal(shape.upper, { 1, 1 })

local function is(given, value, gradient, about)
  check.near(given.value, value, 1e-12, about)
  check.near(given.gradient, gradient, 1e-12, about)
end
local a <const>, b <const> = 0.25, 0.5
local H <const>, W <const> = 1 + a, 2 * (1 + b)
local function all(design, to) -- to: what becomes of a gradient
  is(design.alpha[1], a, to{ 1, 0 })
  is(design.alpha[2], b, to{ 0, 1 })
  is(design.volume, W * H, to{ W, 2 * H })
  is(design.compliance, p^2 * W * H / (2 * E), to{ p^2 * W / (2 * E), p^2 * H / E })
  is(design.peak_pressure, p * (W / 2)^(1 / 8), to{ 0, p / 8 * (W / 2)^(-7 / 8) }) -- its mean is over the first design's length
  local ux <const>, uy <const> = design:displacement(block, 1, 0.5)
  is(ux, 0, to{ 0, 0 })
  is(uy, -p * H / 2 / E, to{ -p / 2 / E, 0 })
  local x <const>, y <const> = design:position(block, 1, 0.5)
  is(x, 1 + b, to{ 0, 1 })
  is(y, 0.5 * H, to{ 0.5, 0 })
  local force, length = 0, 0
  for k, node in ipairs(design:contact(contact)) do
    is(node.x, (k - 1) / 4 * W, to{ 0, (k - 1) / 2 })
    is(node.y, 0, to{ 0, 0 })
    is(node.gap, 0, to{ 0, 0 })
    is(node.pressure, p, to{ 0, 0 })
    is(node.weight, W / (k % 4 == 1 and 8 or 4), to{ 0, k % 4 == 1 and 0.25 or 0.5 })
    check.equal(node.status, "closed")
    force, length = force + node.force, length + node.weight
  end
  is(force, p * W, to{ 0, 2 * p })
  is(length, W, to{ 0, 2 })
end
local design <const> = shape:design{ a, b }
check.that(design.smooth)
check.equal(design.weak, "")
check.near(design.solution.energy, -p^2 * W * H / (2 * E))
all(design, function(g) return g end)
all(design:along{ 2, -3 }, function(g) return { 2 * g[1] - 3 * g[2] } end)
all(design:along{ 2, -3 }:along{ -1 }, function(g) return { 3 * g[2] - 2 * g[1] } end)
check.that(tostring(design):find("alpha = (0.25, 0.5)", 1, true) and tostring(design:along{ 1, 0 }):find("alpha = (0.25, 0.5)", 1, true))
check.equal(shape:design().alpha[1].value, 0)

-- Without exact derivatives functions get numbers without gradients, and the same values.
local asked
local by_differences <const> = pressed{ differences = 1e-3, objective = function(d)
  asked = asked or d
  return d.compliance + d.volume
end }
local optimum <const> = by_differences:optimise{ start = { a, b } }
check.equal(asked.volume.gradient, {})
check.near(asked.volume.value, W * H)
check.near(optimum.objective, p^2 / E + 2, 1e-12) -- least at a = b = 0

-- The least of a function in the middle of its box, by each method.
for _, method in ipairs{ "slp", "mma", "ccsaq", "slsqp" } do
  local bowl <const> = pressed{ objective = function(d) return (d.compliance - 1.2)^2 + (d.volume / d.compliance - 2 * E / p^2 + d.alpha[1] - 0.3)^2 end }
  local least <const> = bowl:optimise{ method = method, tol_design = 1e-7, max_designs = 200 }
  check.that(least.objective < 1e-8, method)
  check.near(least.alpha[1], 0.3, 1e-3, method)
  check.near(least.design.compliance.value, 1.2, 1e-3, method)
  check.near(least.solution.energy, -least.design.compliance.value)
end

-- A floor exactly as far away as the block is lowered: all its nodes touch without force. Growing by a presses with E a/H, H = 1;
-- shrinking does not.
local function touching(exponent)
  local lowered <const> = dotyk.body{ name = "lowered", material = dotyk.material{ E = E, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {2, 1}, cells = {4, 3} } }
  lowered:part "top":displace{ y = -0.5 }
  lowered:part "left":fix "x"
  local scene <const> = dotyk.scene{ lowered }
  local floor <const> = scene:contact{ lowered:part "bottom", rigid = dotyk.rigid.plane{ point = {0, -0.5}, normal = {0, 1} } }
  return dotyk.shape{ scene = scene, exponent = exponent,
    moves = { { body = lowered, velocity = function(_, y) return 0, y - 1 end, lower = -0.1, upper = 0.1 } } }, floor
end
for _, exponent in ipairs{ 1, 8 } do
  local kinked <const>, floor <const> = touching(exponent)
  local at <const> = kinked:design()
  check.that(not at.smooth)
  check.that(at.weak:find("node 1 of 'lowered'", 1, true) and at.weak:find("and 1 more", 1, true), at.weak)
  for direction, pressing in pairs{ [1] = E, [2] = 2 * E, [-1] = 0, [-3] = 0 } do
    local side <const> = at:along{ direction }
    is(side.peak_pressure, 0, { pressing })
    is(side.compliance, 0, { 0 })
    for _, node in ipairs(side:contact(floor)) do
      is(node.pressure, 0, { pressing })
      is(node.gap, 0, { direction < 0 and -direction or 0 })
    end
  end
  is(at.peak_pressure, 0, { E }) -- as the variable grows
end
