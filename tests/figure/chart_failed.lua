-- Points of runs that failed may be without an ordinate, others not; panels stand in columns.
local refused <const> = require "refused"

local file <const> = os.tmpname() .. ".png"
local curve <const>, failed <const> = { name = "a", x = { 1, 2 }, y = { 1, 2 } }, { x = { 3, 4 }, crossed = true, twin = true, style = "points" }
dotyk.chart{ file = file, series = { curve, failed } }
dotyk.chart{ file = file, series = { failed } }
dotyk.chart{ file = file, series = { { name = "never", x = {}, y = {} }, failed }, log = "xy" }
dotyk.chart{ file = file, panels = { { series = { curve } }, { series = { curve, failed } }, { series = { { x = { 1 }, y = { 1 }, status = "slip" } } } }, columns = 2 }
refused(function() dotyk.chart{ file = file, series = { { name = "b", x = { 1 } } } } end, "series 'b': missing key 'y'", "crossed")
refused(function() dotyk.chart{ file = file, series = { { x = { 1, 2 }, y = { 1 }, crossed = true } } } end, "2 x and 1 y")
refused(function() dotyk.chart{ file = file, series = { { x = { 1 }, x_low = { 1 }, x_high = { 2 }, crossed = true } } } end, "no whiskers")
refused(function() dotyk.chart{ file = file, panels = { { series = { curve } } }, columns = 2 } end, "1 panels in 2 columns")
refused(function() dotyk.chart{ file = file, panels = { { series = { curve } } }, columns = 0 } end, "columns")
refused(function() dotyk.chart{ file = file, series = { curve }, columns = 2 } end, "'columns' without 'panels'")
refused(function() dotyk.chart{ file = file, series = { { x = { 1 }, y = { 1 }, status = "stuck" } } } end, "status")
assert(os.remove(file))
