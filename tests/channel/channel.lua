-- dotyk.channel: what it gives, what it refuses.
local check <const> = require "check"
local refused <const> = require "refused"

local function data(keys)
  local all = { half_width = 1, a = 1, b = 1, c = 9, d = 3, omega = 20, u0 = 700 }
  for key, value in pairs(keys or {}) do all[key] = value end
  return all
end
local function flow(keys) return dotyk.channel(data(keys)) end

-- Fields, the limit, the parabola without a field.
local c <const> = flow()
check.near(c.hartmann, 3)
check.near(c.reynolds, 700 * math.sqrt(2), 1e-9)
check.near(c.exponent, math.log(c.reynolds + 1, 10))
check.equal(c:velocity(0, 0), 700)
check.near(c:stationary(0.5), 1 / 3 * (1 - (math.exp(1.5) + math.exp(-1.5)) / (math.exp(3) + math.exp(-3))))
check.near(flow{ c = 0 }:stationary(0.5), 3 * 0.75 / 2)
check.near(flow{ drive = 0 }:velocity(0.5, 40), c:stationary(0.5))
check.equal(c:amplitude(), c:amplitude(0))
check.near(c:velocity(0.3, 0.7), c:velocity(-0.3, 0.7), 1e-14)
check.near(c:velocity(0.3, 50), c:periodic(0.3, 50), 1e-14)
check.that(c:error_bound(0.01) < 1e-12)

-- Physical data give the reduced ones.
local p <const> = dotyk.channel{ half_width = 2e-3, density = 1000, viscosity = 1e-3, conductivity = 5, E0 = 200, B0 = 0.5,
                                 pressure_gradient = -30, omega = 7 }
check.near({ p.a, p.b, p.c, p.d, p.drive }, { 2, 2e-6, 0.0025, 0.06, 1 }, 1e-15)

-- Either field oscillating, series and stepping.
for _, field in ipairs{ "electric", "magnetic" } do
  local f = flow{ oscillating = field, u0 = 2 }
  local s = f:stepping{ step = 1 / 400 }:run(0.5)
  check.equal(s.time, 0.5)
  check.near(s:velocity(0.4), f:velocity(0.4, 0.5), 1e-8)
  check.near(s:step().time, 0.5 + 1 / 400)
end

-- A magnetic field too slow for the series is stepped.
local slow <const> = flow{ oscillating = "magnetic", omega = 0.1 }
check.error(function() slow:velocity(0, 1) end, "channel:stepping")
check.error(function() slow:amplitude() end, "too slowly for the series")
check.that(slow:stepping{ step = 0.1 }:run(1):velocity(0) < 700)

-- Refused at its line, by name.
refused(function() dotyk.channel(data{ b = -1 }) end, "'b' must be a positive number")
refused(function() dotyk.channel(data{ b = 0/0 }) end, "'b'", "nan")
refused(function() dotyk.channel{ half_width = 1, density = 1, viscosity = -1, conductivity = 1 } end, "'viscosity' must be a positive number")
refused(function() dotyk.channel{ half_width = 1, density = 1, conductivity = 1 } end, "'viscosity' is missing")
refused(function() dotyk.channel(data{ density = 1 }) end, "'density' is given beside reduced data")
refused(function() dotyk.channel{ half_width = 1, b = 1 } end, "'a' is missing")
refused(function() dotyk.channel(data{ viscosty = 1 }) end, "viscosity")
refused(function() dotyk.channel(data{ oscillating = "both" }) end, "\"electric\" or \"magnetic\"")
refused(function() dotyk.channel(data{ oscillating = "magnetic", omega = 0 }) end, "omega of an oscillating magnetic field is 0")
refused(function() c:velocity(1.01, 1) end, "outside the channel, |y| <= 1")
refused(function() c:velocity(0, -1) end, "t = -1")
refused(function() c:velocity(0, 0/0) end, "'t'", "nan")
refused(function() c:stationary(-2) end, "outside the channel")
refused(function() c:stepping{ step = 0 } end, "'step' must be a positive number")
refused(function() c:stepping{ step = 1 }:run(2):run(1) end, "it is 2 already")
refused(function() c:stepping{ step = 1e-9 }:run(1) end, "at most 1e7")

-- Whatever the sizes, a number comes or an error.
for _, a in ipairs{ 1e-300, 1, 1e300 } do
  for _, b in ipairs{ 1e-300, 1, 1e300 } do
    for _, k in ipairs{ 0, 1, 1e300 } do
      for _, field in ipairs{ "electric", "magnetic" } do
        for _, t in ipairs{ 0, 1e-300, 1, 1e300 } do
          local ok, u = pcall(function()
            return flow{ a = a, b = b, c = k, oscillating = field, omega = 1e10, u0 = 1 }:velocity(0.5, t)
          end)
          check.that(not ok or u == u and math.abs(u) < math.huge, ("a %g b %g c %g t %g: %s"):format(a, b, k, t, u))
        end
        local ok, u = pcall(function()
          return flow{ a = a, b = b, c = k, oscillating = field, u0 = 1 }:stepping{ step = 0.5, cells = 2, degree = 2 }:run(1):velocity(0.5)
        end)
        check.that(not ok or u == u, "stepping gave nan")
      end
    end
  end
end
