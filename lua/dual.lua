-- Dual numbers: a value and its derivatives by the design variables, for functions of designs given to dotyk.shape.
-- Arithmetic follows the rules of differentiation; a number has derivatives zero.
local core <const> = ...

local Dual <const> = { __name = "dual number" }

local function make(value, gradient) return setmetatable({ value = value, gradient = gradient }, Dual) end
local function is_dual(x) return getmetatable(x) == Dual end

function Dual.__index(_, key)
  core.fail(("a dual number has no field '%s'; it has value and gradient"):format(tostring(key)))
end

local function value(x)
  if is_dual(x) then return x.value end
  if type(x) == "number" then return x end
  core.fail("expected a number or a dual number, got " .. core.type_name(x))
end

-- What does not change (d = 0) has no part in a derivative, though the slope be infinite.
local function times(slope, d) return (slope == 0 or d == 0) and 0.0 or slope * d end

-- f(a, b) with the derivatives by_a and by_b.
local function combine(a, b, result, by_a, by_b)
  local ga <const>, gb <const> = is_dual(a) and a.gradient, is_dual(b) and b.gradient
  if ga and gb and #ga ~= #gb then core.fail("dual numbers of different designs do not mix") end
  local g <const> = {}
  for i = 1, #(ga or gb) do g[i] = (ga and times(by_a, ga[i]) or 0.0) + (gb and times(by_b, gb[i]) or 0.0) end
  return make(result, g)
end

-- f(x) with the derivative slope.
local function chain(x, result, slope) return is_dual(x) and combine(x, 0, result, slope, 0) or result end

function Dual.__add(a, b) return combine(a, b, value(a) + value(b), 1, 1) end
function Dual.__sub(a, b) return combine(a, b, value(a) - value(b), 1, -1) end
function Dual.__mul(a, b) return combine(a, b, value(a) * value(b), value(b), value(a)) end
function Dual.__div(a, b)
  local q <const> = value(a) / value(b)
  return combine(a, b, q, 1 / value(b), -q / value(b))
end
function Dual.__pow(a, b)
  local x <const>, n <const> = value(a), value(b)
  local result <const> = x ^ n
  return combine(a, b, result, n == 0 and 0 or n * x ^ (n - 1), (is_dual(b) and result ~= 0) and result * math.log(x) or 0)
end
function Dual.__unm(a) return chain(a, -a.value, -1) end
function Dual.__lt(a, b) return value(a) < value(b) end
function Dual.__le(a, b) return value(a) <= value(b) end
function Dual.__eq(a, b) return rawequal(a, b) or is_dual(a) and is_dual(b) and a.value == b.value end
function Dual.__tostring(a)
  local parts <const> = {}
  for i, d in ipairs(a.gradient) do parts[i] = ("%.6g"):format(d) end
  return ("%.10g (gradient %s)"):format(a.value, table.concat(parts, ", "))
end

local slopes <const> = {
  sqrt = function(_, y) return 0.5 / y end,
  exp = function(_, y) return y end,
  log = function(x) return 1 / x end,
  sin = function(x) return math.cos(x) end,
  cos = function(x) return -math.sin(x) end,
  atan = function(x) return 1 / (1 + x * x) end,
  abs = function(x) return x < 0 and -1 or 1 end,
}

local module <const> = { make = make }
for name, slope in pairs(slopes) do
  module[name] = function(a)
    local x <const> = value(a)
    local y <const> = math[name](x)
    return chain(a, y, is_dual(a) and slope(x, y) or 0)
  end
end
function module.max(a, b) return value(a) >= value(b) and a or b end
function module.min(a, b) return value(a) <= value(b) and a or b end
module.value = value

return module
