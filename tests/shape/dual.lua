-- Arithmetic with dual numbers against derivatives by hand.
local check <const> = require "check"
local refused <const> = require "refused"
local dual <const> = dotyk.dual

-- Two design variables, x and y: a block's height and width. Their dual numbers have unit gradients.
local block <const> = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {1, 1} }, material = dotyk.material{ E = 1, nu = 0 } }
block:part "bottom":fix()
local function shape(...)
  local moves = {}
  for k, velocity in ipairs{ ... } do moves[k] = { body = block, velocity = velocity, lower = 0, upper = 2 } end
  return dotyk.shape{ scene = dotyk.scene{ block }, moves = moves }
end
local function high(_, y) return 0, y end
local function wide(x) return x, 0 end
local both <const> = shape(high, wide)
local x, y = table.unpack(both:design{ 0.3, 0.7 }.alpha)

local function is(given, value, by_x, by_y, about)
  check.near(given.value, value, 1e-15 * math.max(1, math.abs(value)), about)
  check.near(given.gradient, { by_x, by_y }, 1e-14, about)
end

is(x, 0.3, 1, 0)
is(y, 0.7, 0, 1)

-- Operators, of two dual numbers, of one and a number.
is(x + y, 1.0, 1, 1)
is(x + 2, 2.3, 1, 0)
is(2 + x, 2.3, 1, 0)
is(x - y, -0.4, 1, -1)
is(2 - x, 1.7, -1, 0)
is(x - 2, -1.7, 1, 0)
is(-x, -0.3, -1, 0)
is(x * y, 0.21, 0.7, 0.3)
is(3 * x, 0.9, 3, 0)
is(x * 3, 0.9, 3, 0)
is(x / y, 0.3 / 0.7, 1 / 0.7, -0.3 / 0.49)
is(1 / x, 1 / 0.3, -1 / 0.09, 0)
is(x / 4, 0.075, 0.25, 0)
is(x ^ 3, 0.027, 3 * 0.09, 0)
is(x ^ y, 0.3 ^ 0.7, 0.7 * 0.3 ^ -0.3, 0.3 ^ 0.7 * math.log(0.3))
is(2 ^ x, 2 ^ 0.3, 2 ^ 0.3 * math.log(2), 0)
is(x ^ -1, 1 / 0.3, -1 / 0.09, 0)
is((-x) ^ 2, 0.09, 0.6, 0)
is((-x) ^ 3, -0.027, -3 * 0.09, 0)

-- Functions; of a number they are math's.
local functions <const> = {
  sqrt = { math.sqrt, 0.5 / math.sqrt(0.3) }, exp = { math.exp, math.exp(0.3) }, log = { math.log, 1 / 0.3 },
  sin = { math.sin, math.cos(0.3) }, cos = { math.cos, -math.sin(0.3) }, atan = { math.atan, 1 / 1.09 }, abs = { math.abs, 1 },
}
for name, f in pairs(functions) do
  is(dual[name](x), f[1](0.3), f[2], 0, name)
  check.equal(dual[name](0.3), f[1](0.3), name)
end
is(dual.abs(-x), 0.3, 1, 0)
is(dual.abs(x - y), 0.4, -1, 1)
is(dual.max(x, y), 0.7, 0, 1)
is(dual.min(x, y), 0.3, 1, 0)
is(dual.max(x, 0.1), 0.3, 1, 0)
check.equal(dual.min(x, 0.1), 0.1)
check.equal(dual.max(1, 2), 2)
check.equal(dual.value(x), 0.3)
check.equal(dual.value(5), 5)

-- Composition: f = exp(x sin y) / (1 + x²).
local e <const>, n <const> = math.exp(0.3 * math.sin(0.7)), 1.09
is(dual.exp(x * dual.sin(y)) / (1 + x ^ 2), e / n, e * math.sin(0.7) / n - e * 0.6 / n ^ 2, e * 0.3 * math.cos(0.7) / n)

-- What does not change has no part, where slopes are infinite or powers of nothing.
local zero <const> = x - 0.3
is(dual.sqrt(zero * 0), 0, 0, 0)
is((zero * 0) ^ 0.5, 0, 0, 0)
is(zero ^ 2, 0, 0, 0)
is(zero ^ 1, 0, 1, 0)
is(x ^ 0, 1, 0, 0)
check.equal((zero ^ y).gradient, { math.huge, 0 })
check.equal(dual.sqrt(zero).gradient, { math.huge, 0 })

-- Comparisons.
check.that(x < y and x <= y and y > x and y >= x and not (x > y))
check.that(x < 1 and 0 < x and x <= 0.3 and 0.3 >= x and x > 0)
check.that(x == zero + 0.3 and x ~= y)
check.equal(tostring(x * y), "0.21 (gradient 0.7, 0.3)")

-- What is no number is refused at the line that calculates.
refused(function() return x + "a" end, "expected a number or a dual number", "got string")
refused(function() return x * nil end, "expected a number or a dual number")
refused(function() return {} - x end, "expected a number or a dual number")
refused(function() return x < "a" end, "expected a number or a dual number")
refused(function() return x ^ {} end, "expected a number or a dual number")
refused(function() return dual.sqrt "a" end, "expected a number or a dual number")
refused(function() return dual.sqrt() end, "x")
refused(function() return dual.atan(x, y) end, "1 argument")
refused(function() return dual.max(x) end, "b")
refused(function() return dual.value(true) end, "expected a number or a dual number")
refused(function() return dual.sqr(x) end, "'sqr'", "did you mean 'sqrt'?")
refused(function() return x.val end, "no field 'val'", "value and gradient")
local alone <const> = shape(high):design{ 0.3 }
refused(function() return x + alone.compliance end, "dual numbers of different designs do not mix")
