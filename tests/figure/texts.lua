-- Texts that are drawn: UTF-8, and not without end.
local refused <const> = require "refused"
local series <const> = { { name = "a", x = { 1, 2 }, y = { 1, 2 } } }
local file <const> = os.tmpname() .. ".png"
local s <const> = refused.pressed_block().solve()
local bent <const> = dotyk.solve(dotyk.beam{ length = 1, EJ = 1, load = -1, left = { deflection = dotyk.law.signorini() }, right = { deflection = dotyk.law.signorini() } })
local law <const> = dotyk.law.one_sided_elastic(1)

for _, bad in ipairs{ "\xff", "a\xc3", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80", "\xef\xbf\xbe", "\u{10ffff}", "\xf4\x90\x80\x80", "\x80", ("x"):rep(1e7) } do
  local what <const> = #bad > 1000 and "has 10000000 bytes; a text in a figure has at most 1000" or "is not valid UTF-8"
  refused(function() dotyk.chart{ file = file, series = series, title = bad } end, "chart: 'title' " .. what)
  refused(function() dotyk.chart{ file = file, series = series, x = bad } end, "chart: 'x' " .. what)
  refused(function() dotyk.chart{ file = file, series = series, y = bad } end, "chart: 'y' " .. what)
  refused(function() dotyk.chart{ file = file, series = { series[1], { name = bad, x = { 1 }, y = { 1 } } } } end, "chart: 'name' of series 2 " .. what)
  refused(function() dotyk.chart{ file = file, title = bad, panels = { { series = series } } } end, "chart: 'title' " .. what)
  refused(function() dotyk.chart{ file = file, panels = { { series = series, title = bad } } } end, "chart: 'title' " .. what)
  refused(function() s:render{ file = file, title = bad } end, "render: 'title' " .. what)
  refused(function() s:render{ file = file, unit = bad } end, "render: 'unit' " .. what)
  refused(function() bent:render{ file = file, title = bad } end, "render: 'title' " .. what)
  refused(function() law:render{ file = file, title = bad } end, "render: 'title' " .. what)
end
refused(function() bent:render{ file = file, units = { length = "\xff" } } end, "render: 'units' is not valid UTF-8")
assert(not io.open(file))

-- What is UTF-8 is drawn: of two, three and four bytes, to the last code point; a body's name is not drawn.
dotyk.chart{ file = file, series = series, title = "µ ü ϑ₁ \u{ffff0} \u{10fffd}", x = ("ü"):rep(500) }
assert(os.remove(file))
