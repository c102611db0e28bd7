-- Rules of all charts, by what stands in their SVG: names beside reference curves, no line hidden, gaps, whiskers, notes.
local check <const> = require "check"
local svg <const> = require "svg"
local refused <const> = require "refused"
local nan <const> = 0/0
local blue <const>, orange <const> = "#0072b2", "#d55e00"

local function drawn(options)
  options.file = "rules.svg"
  return svg(dotyk.chart(options))
end
local function lines_of(it, colour)
  local out <const> = {}
  for _, line in ipairs(it.lines) do if line.stroke == colour then out[#out + 1] = line end end
  return out
end
local function least_distance(text, line) -- from the beginning of a text to the points of a line, about
  local least = math.huge
  for i = 1, #line.points - 1 do
    for k = 0, 200 do
      local p <const>, q <const> = line.points[i], line.points[i + 1]
      least = math.min(least, math.abs(p.y + (q.y - p.y) * k / 200 - text.y) + math.max(0, text.x - (p.x + (q.x - p.x) * k / 200)))
    end
  end
  return least
end

-- 1. One reference curve is in the legend. Of several each name stands near its own curve, and no sample in a legend.
local curve <const> = { name = "found", x = { 1, 2, 3 }, y = { 1, 1.2, 1.1 }, style = "points" }
local function level(name, y) return { name = name, x = { 1, 3 }, y = { y, y }, reference = true } end
local one <const> = drawn{ series = { curve, level("theory", 2) } }
check.equal(#lines_of(one, "#5a5a5a"), 2, "the curve and its sample")
local two <const> = drawn{ series = { curve, level("upper bound", 2), level("lower bound", 0.5) } }
local dashed <const> = lines_of(two, "#5a5a5a")
check.equal(#dashed, 2, "the curves alone")
check.that(least_distance(two:text "upper bound", dashed[1]) < 60 and least_distance(two:text "lower bound", dashed[2]) < 60)
check.that(math.abs(two:text "upper bound".y - dashed[2].top) > 100)
check.that(two:text "found" and two.least >= 7)
-- Beside an upright line that leaves too little room the name is upright too.
local slim <const> = drawn{ x_range = { 0, 1 }, series = { { x = { 0, 0.9 }, y = { 0, 1 } }, { name = "a", x = { 0.5, 0.5 }, y = { 0, 1 }, reference = true },
  { name = ("long name "):rep(4), x = { 0.05, 0.05 }, y = { 0, 1 }, reference = true } } }
check.that(slim:text "a")

-- 2. Where a curve lies beneath a later one it shows as dashes on it, along that stretch alone; beneath two, farther apart.
local x <const>, same <const>, leaves <const> = { 1, 2, 3, 4, 5 }, { 1, 2, 3, 4, 5 }, { 1, 2, 3, 1, 0 }
local function line(name, y) return { name = name, x = x, y = y, style = "line" } end
local alone <const> = lines_of(drawn{ series = { line("a", same), line("b", { 5, 4, 3, 2, 1 }) } }, blue)
check.equal(#alone, 2, "a crossing hides nothing: the curve, its sample")
local hidden <const> = drawn{ series = { line("a", same), line("b", leaves) } }
local under <const>, over <const> = lines_of(hidden, blue), lines_of(hidden, orange)
check.equal(#under, 3, "the curve, the part beneath, the sample")
local plain <const>, dashes <const> = under[1], under[2]
check.that(dashes.dashed and not plain.dashed and dashes.width == plain.width and over[1].width == plain.width)
check.that(math.abs(dashes.left - plain.left) < 5 and dashes.right < plain.left + 0.6 * (plain.right - plain.left), "until they part")
local three <const> = lines_of(drawn{ series = { line("a", same), line("b", same), line("c", same) } }, blue)
check.that(three[2].dashed and three[2].gap > 2 * dashes.gap, "beneath two")
-- At the edge of the plot no line reaches beyond the frame, and neither does what is seen of it on others.
local zero <const> = drawn{ y_range = { 0, 1 }, series = { line("a", { 0, 0, 0, 1, 2 }), line("b", { 0, 0, 0, 0, 1 }), line("c", { 0, 0, 0, 0, 0 }) } }
local function frame_of(it) -- the last closed line that is drawn in the colour of axes
  for k = #it.lines, 1, -1 do if it.lines[k].stroke == "#1e1e1e" and #it.lines[k].points == 4 then return it.lines[k] end end
end
local frame <const> = frame_of(zero)
for _, colour in ipairs{ blue, orange, "#009e73" } do
  local broadest = 0
  for _, mark in ipairs(zero:filled(colour)) do
    check.that(mark.bottom <= frame.bottom + 0.1 and mark.top >= frame.top - 0.1, "cut off")
    broadest = math.max(broadest, mark.bottom - mark.top)
  end
  check.that(broadest > 1, "drawn")
  for _, mark in ipairs(lines_of(zero, colour)) do check.that(mark.bottom + mark.width / 2 <= frame.bottom + 0.1, "inside") end
end
-- Markers of one place are nested, those above smaller than alone, and none much larger.
local function spots(name, at) return { name = name, x = at, y = at, style = "points" } end
local nested <const> = drawn{ series = { spots("a", { 3, 9 }), spots("b", { 1, 3, 9 }), spots("c", { 2, 3, 9 }) } }
local function sizes(colour)
  local out <const> = {}
  for k, mark in ipairs(nested:filled(colour)) do out[k] = mark.right - mark.left end
  table.sort(out)
  return out
end
local square <const>, triangle <const> = sizes(orange), sizes "#009e73"
check.that(square[4] < 1.35 * square[1] and triangle[4] > 1.1 * triangle[1], "nested")
-- Beneath dashes nothing is hidden.
check.equal(#lines_of(drawn{ series = { line("a", same), { x = x, y = same, reference = true } } }, blue), 2)

-- 3. nan is a gap.
local gap <const> = drawn{ series = { { name = "a", x = { 1, 2, 3, 4 }, y = { 1, 2, nan, 3 }, style = "line" }, { name = "b", x = { 1, 2, 3, 4, 5 }, y = { 1, 2, nan, 1, 5 }, style = "line" } } }
check.equal(#lines_of(gap, orange), 3, "two pieces and the sample")
refused(function() dotyk.chart{ file = "rules.svg", series = { { x = { 1, nan }, y = { 1, 2 } } } } end, "'x': entry 2 must be a finite number, got nan")

-- 4. Whiskers: upright from low to high with caps, in place of the band.
local spread <const> = { name = "a", x = { 1, 2 }, y = { 2, 3 }, low = { 1, 2 }, high = { 4, 5 }, style = "points", bars = true }
local bars <const> = drawn{ series = { spread } }
local upright, caps = 0, 0
for _, mark in ipairs(lines_of(bars, blue)) do
  if mark.left == mark.right then upright = upright + 1 elseif mark.top == mark.bottom then caps = caps + 1 end
end
check.equal({ upright, caps }, { 3, 6 }) -- with the legend's
-- Those of several series at one x stand side by side, so that none hides another.
local beside <const> = drawn{ categories = { "first", "second" }, series = { spread, { name = "b", x = { 1, 2 }, y = { 2, 3 }, low = { 1, 2 }, high = { 4, 5 }, style = "points", bars = true } } }
local function uprights(colour)
  local out <const> = {}
  for _, mark in ipairs(lines_of(beside, colour)) do if mark.left == mark.right then out[#out + 1] = mark.left end end
  return out
end
local first <const>, second <const> = uprights(blue), uprights(orange)
for k = 1, 2 do check.that(second[k] - first[k] > 10 and second[k] - first[k] < 40, "whiskers side by side") end
-- On a logarithmic axis one that begins at zero comes from below.
local below <const> = lines_of(drawn{ log = "y", series = { { name = "a", x = { 1, 2 }, y = { 1, 2 }, low = { 0, 1 }, high = { 3, 4 }, style = "points", bars = true } } }, blue)
local whole = 0
for _, mark in ipairs(below) do if mark.left == mark.right then whole = whole + 1 end end
check.equal(whole, 3, "both whiskers and the legend's")
-- Failures without an ordinate stand in a strip that says what they are; where there are none, its name alone is in the legend.
local strip <const> = drawn{ strip = "out of memory", series = { curve, { name = "factors", x = { 2, 3 }, crossed = true } } }
for _, word in ipairs{ "out", "of", "memory" } do check.that(strip:text(word) and strip:text(word).y < frame_of(strip).top, word) end
check.that(drawn{ series = { curve, { name = "none", x = {}, y = {}, crossed = true } } }:text "none")
refused(function() dotyk.chart{ file = "rules.svg", series = { { name = "a", x = { 1 }, y = { 1 }, bars = true } } } end, 'series "a": \'bars\' without \'low\' and \'high\'')

-- 5. Notes: near their points, off the curves, with a line from the point.
local noted <const> = drawn{ series = { curve }, notes = { { x = 2, y = 1.2, text = "here" } } }
local leaders <const> = {}
for _, mark in ipairs(lines_of(noted, "#1e1e1e")) do if #mark.points == 2 and math.abs(mark.width - 1.7) < 0.1 then leaders[#leaders + 1] = mark.points end end
check.equal(#leaders, 1)
local here <const>, leader <const> = noted:text "here", leaders[1]
check.that(math.abs(leader[2].y - here.y) < 40 and leader[2].x > here.x - 10 and leader[2].x < here.x + 80, "to the text")
check.that(noted.least >= 7)
-- Many have places away from each other; the picture grows for them, or is refused.
local function notes_at(x, y, n)
  local out <const> = {}
  for k = 1, n do out[k] = { x = x, y = y, text = "a note of some length, number " .. k } end
  return out
end
local full <const> = drawn{ series = { curve }, notes = notes_at(2, 1.2, 16) }
local places <const> = {}
for _, it in ipairs(full.texts) do
  if it.words:find "number" then
    for _, other in ipairs(places) do check.that(math.abs(other.y - it.y) > 20 or math.abs(other.x - it.x) > 200, it.words .. " lies upon another") end
    places[#places + 1] = it
  end
end
check.equal(#places, 16)
refused(function() dotyk.chart{ file = "rules.svg", series = { curve }, notes = notes_at(2, 1.2, 60) } end, 'the note "a note of some length, number ', '" has no free place in its plot')
refused(function() dotyk.chart{ file = "rules.svg", series = { curve }, notes = notes_at(20, 1.2, 1) } end, 'number 1" is at (20, 1.2), but the axes go from (0.9, ')
refused(function() dotyk.chart{ file = "rules.svg", log = "x", series = { curve }, notes = { { x = 0, y = 1, text = "zero" } } } end, 'the note "zero" has no place on a logarithmic axis')
refused(function() dotyk.chart{ file = "rules.svg", series = { curve }, notes = { { x = 1, y = 1 } } } end, "missing key 'text'")
refused(function() dotyk.chart{ file = "rules.svg", notes = {}, panels = { { series = { curve } } } } end, "'notes' beside 'panels'")

-- 6. A guide stands beside a stretch of its own slope, higher than a letter, and none is left out.
local falls <const>, rises <const> = {}, {}
for k = 0, 12 do falls[#falls + 1], rises[#rises + 1] = 10^(-k), 10^(-math.min(k, 12 - k)) end
local decades <const> = {}
for k = 0, 12 do decades[#decades + 1] = 10^k end
local guided <const> = drawn{ log = "xy", slopes = { 1, -1 }, series = { { x = decades, y = rises, style = "line" }, { x = decades, y = falls, style = "line" } } }
local function guides_of(it) return it:filled "#ebebeb" end
local up <const>, down <const> = table.unpack(guides_of(guided))
local valley <const> = guided:text "10⁶".x + 15
check.that(up.left > valley, "1 beside the rising branch")
local slope <const> = lines_of(guided, orange)[1]
local at <const> = (down.left + down.right) / 2 - slope.left
check.that(math.abs(slope.top + at / (slope.right - slope.left) * (slope.bottom - slope.top) - (down.top + down.bottom) / 2) < 260, "-1 beside the falling one")
local h <const> = { 1, 2, 4, 8 }
local function order(name, factor, p)
  local it <const> = { name = name, x = h, y = {} }
  for k, step in ipairs(h) do it.y[k] = factor * step^p end
  return it
end
local orders <const> = drawn{ log = "xy", slopes = { 1, 2 }, series = { order("a", 1, 1), order("b", 0.3, 1), order("c", 1e-3, 2), order("d", 1e-5, 2) } }
local one_, two_ <const> = table.unpack(guides_of(orders))
check.that(one_.bottom - one_.top > 15 and two_.bottom - two_.top > 15)
check.that(one_.bottom < lines_of(orders, "#009e73")[1].bottom and two_.top > lines_of(orders, "#009e73")[1].top, "beside their own curves")
local tight <const> = drawn{ size = { 1000, 500 }, log = "xy", slopes = { 2, 4 }, series = { order("a", 0.1, 1), order("b", 5e-3, 2), order("c", 5e-4, 2), order("d", 2e-7, 4) } }
check.equal(#guides_of(tight), 2)

-- 7. Panels have one legend with each entry once; where looks contradict each other, one legend for neighbours that agree.
local function count(it, words)
  local n = 0
  while it:text(words, n + 1) do n = n + 1 end
  return n
end
local function points(name, y) return { name = name, x = x, y = y, style = "points" } end
local ab <const> = { series = { line("a", same), line("b", leaves) } }
local all <const> = drawn{ size = { 2000, 800 }, columns = 3, panels = { ab, ab, { series = { points("c", same), points("d", leaves) } } } }
for _, name in ipairs{ "a", "b", "c", "d" } do check.equal(count(all, name), 1, name) end
check.that(math.abs(all:text "a".y - all:text "d".y) < 0.1, "in one row")
local some <const> = drawn{ size = { 2000, 1200 }, columns = 2, panels = { ab, ab, ab, { series = { points("a", same) } } } }
check.equal({ count(some, "a"), count(some, "b") }, { 2, 1 })
check.that(some:text("a", 2).x > 1000 and some:text("a", 2).y > 600 and some:text "a".x < 1000, "each in its own panel")
-- A name has one colour in all panels, and no other has that.
local apart <const> = drawn{ panels = { ab, { series = { line("c", same), line("a", leaves) } } } }
for name, colour in pairs{ blue = blue, orange = orange, green = "#009e73" } do check.that(#lines_of(apart, colour) >= 2, name) end
check.equal(#lines_of(apart, "#cc79a7"), 0, "no fourth colour")

-- 8. Decades all have labels where there is room, and within less than a decade labels are even.
local logs <const> = drawn{ size = { 1000, 450 }, log = "xy", series = { { x = { 0.08, 0.1, 0.2, 0.25 }, y = { 1, 10, 1e4, 1e5 } } } }
for _, label in ipairs{ "10⁰", "10¹", "10²", "10³", "10⁴", "10⁵", "0.10", "0.15", "0.20", "0.25" } do check.that(logs:text(label), label) end
check.that(not logs:text "0.08" and logs:text "10⁰".y - logs:text "10¹".y > 40, "apart")

-- 9. A legend above the plot has the fewest rows, in columns.
local wide <const> = { line("PDAS", { 1, 2, 3, 4, 5 }), line("PDAS, space", { 5, 4, 3, 2, 1 }), line("given", { 1, 5, 1, 5, 1 }), line("Coulomb", { 5, 1, 5, 1, 5 }), line("Coulomb, space", { 3, 3, 3, 3, 3 }) }
for k = 1, 20 do wide[#wide + 1] = { x = { 1 + k / 5, 1 + k / 5 }, y = { 1, 5 }, style = "line" } end
local above <const> = drawn{ series = wide }
for k, other in ipairs{ "PDAS, space", "given" } do check.that(math.abs(above:text "PDAS".y - above:text(other).y) < 0.1, other) end
check.that(math.abs(above:text "PDAS".x - above:text "Coulomb".x) < 0.1 and above:text "Coulomb".y > above:text "PDAS".y, "below each other")
check.that(math.abs(above:text "Coulomb".y - above:text "Coulomb, space".y) < 0.1)

-- 10. Markers without a line stand close to their names, which have a white rim on the cells of a map in place of a box.
local dots <const> = drawn{ series = { points("dots", same), points("b", leaves) } }
local symbol <const> = dots:filled(orange)
local sample <const> = symbol[#symbol]
check.that(dots:text "b".x - sample.right < 25, "close")
local named <const> = drawn{ map = { x = { 1, 2, 3 }, y = { 1, 2, 3 }, values = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } }, names = { "all" } }, series = { level("first bound", 1.3), level("other bound", 2.5) } }
check.equal(named:text "first bound".fill, "#1e1e1e")
for _, box in ipairs(named:filled "#ffffff") do check.that(box.right - box.left < 100 or box.right - box.left > 500, "no box") end

-- 11. Titles keep 0.6 of a letter's height off the edges.
for words = 4, 10 do
  local title <const> = ("title "):rep(words) .. "end"
  local titled <const> = drawn{ title = title, y = "y", series = { curve } }
  local top <const> = titled:text(title)
  check.that(not top or top.x >= 20, title)
end

-- Equal pictures give equal bytes.
local content <const> = require "bytes_of"
for _, options in ipairs{ { series = { line("a", same), line("b", leaves), level("c", 1), level("d", 2) } }, { polar = true, series = { line("a", same) }, notes = { { x = 3, y = 3, text = "three" } } } } do
  for _, ending in ipairs{ "pdf", "png", "svg" } do
    options.file = "first." .. ending
    dotyk.chart(options)
    options.file = "again." .. ending
    dotyk.chart(options)
    check.equal(content("first." .. ending) == content("again." .. ending), true)
    os.remove("first." .. ending)
    os.remove("again." .. ending)
  end
end
os.remove "rules.svg"
