-- Ends of a chart's axes: taken where they can be, refused where not.
local refused <const> = require "refused"

local series <const> = { { name = "a", x = { 1, 2 }, y = { 1, 2 } } }
local file <const> = os.tmpname() .. ".png"
dotyk.chart{ file = file, series = series, x_range = { 0, 3 }, y_range = { -1, 3 } }
dotyk.chart{ file = file, x = "x", panels = { { series = series, x_range = { 0, 3 } }, { series = series, y_range = { 0.5, 2.5 }, log = "y" } } }
os.remove(file)
refused(function() dotyk.chart{ file = file, series = series, x_range = { 2, 1 } } end, "'x_range' goes from 2 to 1", "must be the lesser")
refused(function() dotyk.chart{ file = file, series = series, y_range = { 0, 1 }, log = "y" } end, "'y_range' begins at 0", "logarithmic")
refused(function() dotyk.chart{ file = file, series = series, x_range = { 1 } } end, "2 numbers")
refused(function() dotyk.chart{ file = file, series = series, panels = { { series = series } }, x_range = { 0, 1 } } end, "panels")
-- An axis on which nothing would be seen is refused.
refused(function() dotyk.chart{ file = file, series = series, x_range = { 10, 20 } } end, "'x_range' goes from 10 to 20, but the data from 1 to 2")
refused(function() dotyk.chart{ file = file, panels = { { series = series }, { series = series, y_range = { -3, 0.5 } } } } end, "'y_range' goes from -3 to 0.5, but the data from 1 to 2")
refused(function() dotyk.chart{ file = file, y_right = "b", series = { series[1], { x = {}, y = {}, axis = "right" } } } end, "no series on the axis on the right has a value")
refused(function() dotyk.chart{ file = file, series = { { x = { 1, 2 }, y = { 0/0, 0/0 } } } } end, "no series has a point that the axes can show")

-- Whatever the numbers, a chart is drawn at once.
for _, values in ipairs{ { 5e-324, 1e-310 }, { 1e-300, 1e300 }, { -1.7e308, 1.7e308 } } do
  dotyk.chart{ file = file, log = values[1] > 0 and "xy" or nil, series = { { name = "a", x = values, y = values } }, slopes = { 1 } }
  assert(os.remove(file))
end
