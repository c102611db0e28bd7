-- The bound of a series at a time whose phase overflows was no number.
local refused <const> = require "refused"
local c <const> = dotyk.channel{ half_width = 1e-3, density = 13546, viscosity = 1.55e-3, conductivity = 1.04e6, E0 = 0.1, B0 = 0.2, pressure_gradient = -2e4,
                                 omega = 6.28, u0 = 1 }
refused(function() return c:error_bound(1e308) end, "beyond the range of numbers")
refused(function() return c:velocity(0, 1e308) end, "beyond the range of numbers")
assert(c:error_bound(1e300) == 0)
