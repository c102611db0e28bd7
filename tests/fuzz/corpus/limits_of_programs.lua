-- A string as long as there are unknowns was read as if it were a table of limits.
local refused <const> = require "refused"
refused(function() dotyk.qp{ c = { -0.1, 1e-3, 1 }, x_high = "abc" } end, "'x_high' must be a number or a table of numbers, got the string \"abc\"")
refused(function() dotyk.qp{ c = { 1, 1 }, x_low = function() end } end, "'x_low' must be a number or a table of numbers, got a function")
refused(function() dotyk.qp{ c = { 1, 1 }, x_low = { 0, 0/0 } } end, "nan")
refused(function() dotyk.qp{ c = { 1, 1 }, x_low = 0/0 } end, "nan")
