-- Kinds of charts, by what stands in their SVG: maps, polar axes, categories, a second axis, a broken one.
local check <const> = require "check"
local svg <const> = require "svg"
local refused <const> = require "refused"
local curve <const> = { name = "a", x = { 1, 2, 3 }, y = { 1, 2, 4 } }
local nan <const> = 0/0

local function drawn(options)
  options.file = options.file or "kinds.svg"
  return svg(dotyk.chart(options))
end
local function wrong(options, ...)
  options.file = "kinds.svg"
  refused(function() dotyk.chart(options) end, ...)
end

-- 1. Categories stand at x = 1, 2, …, level in one line or two, else upright, and never below 7 points.
local few <const> = drawn{ categories = { "pdas", "active set" }, series = { curve } }
local left <const>, right <const> = few:text "pdas", few:text "active set"
check.that(left.x < right.x and math.abs(left.y - right.y) < 0.1 and not left.upright)
local half <const> = few:text "1.5"
check.that(not half or half.x < left.x, "1.5 stands beside the y axis alone")
local five <const> = drawn{ categories = { "pdas", "interior point", "newton", "proximal points", "cg" }, series = { curve } }
local two <const> = five:text "interior"
check.that(two and five:text "point" and two.y < five:text "point".y, "in two lines")
local many <const> = drawn{ categories = { "interior_point", "projected_cg", "uzawa_pdas", "active_set", "multigrid", "coulomb_loop", "feti" }, series = { curve } }
check.that(many:text "interior_point".upright and many:text "feti".upright)
local function names_of(n) local out <const> = {} for k = 1, n do out[k] = "category " .. k end return out end
-- Names have no end cut off: where they are long the picture grows.
local long <const> = { "incomplete_factorisation_with_a_long_name", "a name of several words that has three lines", "c", "d", "e", "f" }
local grown <const> = drawn{ categories = long, series = { curve } }
check.that(grown:text(long[1]).upright and grown:text(long[1]).y > 750 and grown:text "a name of several".upright, "whole")
wrong({ size = { 1000, 750 }, categories = names_of(40), series = { curve } }, "categories meet even upright")
for _, it in ipairs{ few, five, many, grown } do check.that(it.least >= 7, it.least) end
wrong({ categories = { "a" }, log = "x", series = { curve } }, "'categories' together with a logarithmic x axis or 'x_range'")
wrong({ categories = { "a" }, x_range = { 0, 2 }, series = { curve } }, "'categories'")
wrong({ x = "x", panels = { { categories = { "a" }, series = { curve } }, { series = { curve } } } }, "have the same categories")

-- 2. The axis on the right: ticks in the colour of its only series, else an arrow in the legend.
local twin <const> = drawn{ y = "seconds", y_right = "memory", series = { curve, { name = "held", x = { 1, 2 }, y = { 1000, 4000 }, axis = "right" } } }
check.equal(twin:text "memory".fill, "#d55e00")
check.equal(twin:text "3000".fill, "#d55e00")
check.that(twin:text "3000".x > twin:text "seconds".x + 500 and twin:text "held")
local both <const> = drawn{ y_right = "memory", series = { curve, { name = "b", x = { 1 }, y = { 1000 }, axis = "right" }, { name = "c", x = { 1 }, y = { 4000 }, axis = "right" } } }
check.equal(both:text "memory".fill, both:text "3000".fill)
check.that(both:text "b →" and both:text "c →" and both:text "memory".fill ~= "#d55e00")
-- One name on both axes has one colour, which then tells no axis.
local same <const> = drawn{ y = "left", y_right = "right", series = { { name = "a", x = { 1, 2 }, y = { 1, 2 }, style = "line" }, { name = "a", x = { 1, 2 }, y = { 7, 5 }, axis = "right", style = "line" } } }
check.that(same:text "a →" and same:text "right".fill == same:text "left".fill)
local stroked <const> = {}
for _, line in ipairs(same.lines) do if line.stroke == "#0072b2" then stroked[#stroked + 1] = line.dashed end end
check.equal(stroked, { false, true, false, true }, "full, dashed, and so in the legend")
-- A method has its colour in every chart, however its name is written and whatever stands beside it; runs of it that failed have it too.
local function strokes(names)
  local series <const> = {}
  for k, name in ipairs(names) do series[k] = { name = name, x = { 1, 2 }, y = { k, k }, style = "line" } end
  local it <const>, out <const> = drawn{ series = series }, {}
  for _, line in ipairs(it.lines) do if #out < #names and line.stroke ~= "#e4e4e4" and line.stroke ~= "#1e1e1e" then out[#out + 1] = line.stroke end end
  return out
end
local newton <const>, projected <const> = "#d55e00", "#009e73"
check.equal(strokes{ "projected_cg", "newton" }, { projected, newton })
check.equal(strokes{ "own", "Newton", "projected CG" }, { "#0072b2", newton, projected })
local failed <const> = drawn{ series = { { name = "PSOR", x = { 1, 2 }, y = { 1, 2 } }, { name = "PSOR", x = { 3 }, crossed = true } } }
for _, line in ipairs(failed.lines) do check.that(line.stroke ~= "#0072b2", "the first colour beside a method") end
wrong({ series = { { x = { 1 }, y = { 1 }, axis = "right" } } }, "one must be on the left")
wrong({ y_right = "memory", series = { curve } }, "'y_right' without a series")
wrong({ series = { { x = { 1 }, y = { 1 }, axis = "up" } } }, '"left" or "right"')

-- 3. A broken axis: its ticks leave out what lies between, and above the gap a step is as long as below.
local gap <const> = drawn{ y_break = { 2500, 8500 }, series = { { name = "p", x = { 1, 2, 3, 4 }, y = { 1000, 1500, 1600, 9200 } } } }
check.that(gap:text "1000" and gap:text "2000" and gap:text "9000" and not gap:text "3000" and not gap:text "8000")
local step <const> = gap:text "1000".y - gap:text "2000".y
check.that(gap:text "2000".y - gap:text "9000".y < 2 * step, "7000 take less than 2000")
local bent -- where it passes the gap: two more points, at its edges
for _, line in ipairs(gap.lines) do bent = bent or (line.stroke == "#0072b2" and #line.points == 6 and line) end
check.that(bent.points[4].y - bent.points[5].y < 20 and bent.points[3].y - bent.points[4].y > 100)
-- Where the parts have scales of their own their steps are their own too.
local far <const> = drawn{ y_break = { 3, 900 }, series = { { name = "p", x = { 1, 2, 3, 4 }, y = { 1, 2, 1000, 1100 } } } }
local numbers = 0
for _, it in ipairs(far.texts) do if it.words:match "^%d+$" and it.x < 150 then numbers = numbers + 1 end end
check.that(far:text "1000" and far:text "2" and numbers < 9, "few numbers")
local beyond <const> = drawn{ y_break = { 3, 90000 }, series = { { name = "p", x = { 1, 2, 3, 4 }, y = { 1, 2, 1e5, 1.1e5 } } } }
check.that(beyond:text "100" and beyond:text "0.002", "one power of ten")
wrong({ y_break = { 2, 90 }, notes = { { x = 2, y = 50, text = "yield" } }, series = { { x = { 1, 2 }, y = { 1, 100 } } } }, 'leaves out the point of the note "yield"')
wrong({ y_break = { 1, 2 }, log = "y", series = { curve } }, "'y_break' from 1 to 2 on a logarithmic axis")
wrong({ y_break = { 2, 1.5 }, series = { curve } }, "'y_break' from 2 to 1.5; the first must be the lesser")
wrong({ y_break = { 2, 9 }, series = { curve } }, "must lie within the y axis, from 1 to 4")
wrong({ y_break = { 2, 3 }, slopes = { 1 }, series = { curve } }, "'y_break' from 2 to 3 together with")

-- 4. Maps: cells meet halfway, on logarithmic axes between the logarithms; nan is crossed out.
local log <const> = drawn{ log = "x", map = { x = { 1, 100 }, y = { 1, 2, 3 }, values = { { 1, 2 }, { 2, nan }, { 3, 4 } }, label = "iterations", unit = "1" } }
check.that(log:text "iterations [1]" and log:text "not applicable" and log:text "max 4" and log:text "min 1")
local cell <const> = log:filled "#440154"[1]
check.that(cell.left < log:text "10⁰".x and math.abs(log:text "10¹".x + 15 - cell.right) < 15, "the border is at 10")
check.near(cell.bottom - cell.top, (log:filled "#440154"[1].bottom - log:filled "#fde725"[1].top) / 3, 1)
local names <const> = { "converges", "stalls", "diverges", "cycles", "refused", "crashes" }
local six <const> = drawn{ map = { x = { 1, 2, 3 }, y = { 1, 2 }, values = { { 1, 2, 3 }, { 4, 5, 6 } }, names = names } }
local grey = {}
for _, colour in ipairs{ "#d6ecf8", "#d6601e", "#145fa0", "#f6c83c", "#5abe96", "#460a46" } do
  check.equal(#six:filled(colour), 2, colour .. ": a cell and its sample in the legend")
  local r <const>, g <const>, b <const> = colour:match "#(..)(..)(..)"
  grey[#grey + 1] = 0.299 * tonumber(r, 16) + 0.587 * tonumber(g, 16) + 0.114 * tonumber(b, 16)
end
table.sort(grey)
for k = 2, 6 do check.that(grey[k] - grey[k - 1] > 25, "told apart in grey") end
for _, name in ipairs(names) do check.that(six:text(name), name) end
check.that(not six:text "not applicable" and not six:text "max 6", "no bar of colours")
check.that(six:text "1" and six:text "2" and not six:text "1.5", "ticks at the values")
-- In panels maps with one label have one scale.
local function half(high) return { map = { x = { 1, 2 }, y = { 1 }, values = { { 0, high } }, label = "steps" } } end
local shared <const> = drawn{ x = "x", panels = { half(1), half(2) } }
check.that(#shared:filled "#fde725" > 0 and #shared:filled "#21918c" > 0, "1 is in the middle of 0 to 2")
local beside <const> = drawn{ columns = 2, size = { 2000, 800 }, panels = { half(1), half(2) } }
check.that(beside:text "steps" and not beside:text("steps", 2) and beside:text "max 2" and not beside:text "max 1", "one bar in a row")
wrong({ map = { x = { 1, 2 }, y = { 1 }, values = { { 1 } }, label = "a" } }, "row 1 has 1 values for 2 x")
wrong({ map = { x = { 1 }, y = { 1 }, values = { { 1 }, { 1 } }, label = "a" } }, "2 rows of values for 1 y")
wrong({ map = { x = { 2, 1 }, y = { 1 }, values = { { 1, 1 } }, label = "a" } }, "'map': x must ascend; 1 follows 2")
wrong({ map = { x = { 0, 1 }, y = { 1 }, values = { { 1, 1 } }, label = "a" }, log = "x" }, "'map': x begins at 0")
wrong({ map = { x = { 1 }, y = { 1 }, values = { { 1 } } } }, "needs a 'label' for the colour bar, or 'names'")
wrong({ map = { x = { 1 }, y = { 1 }, values = { { 3 } }, names = { "a", "b" } } }, "the value 3 has no name; with 2 names values are 1 to 2")
wrong({ map = { x = { 1 }, y = { 1 }, values = { { 1 } }, label = "a" }, x_range = { 0, 1 } }, "'map' together with 'x_range'")
wrong({ title = "none" }, "missing key 'series', 'map' or 'panels'")
wrong({ panels = { { title = "none" } } }, "missing key 'series' or 'map'")

-- 5. Polar axes: 0 at the centre, angles anticlockwise from the right, arcs between points of one radius.
local polar <const> = drawn{ polar = true, x = "direction", y = "force", series = { { name = "ring", x = { 0, 90, 180, 270, 360 }, y = { 2, 2, 2, 2, 2 }, style = "line" } } }
local east <const>, north <const>, west <const>, south <const> = polar:text "0°", polar:text "90°", polar:text "180°", polar:text "270°"
check.that(east.x > west.x and north.y < south.y)
local ring
for _, line in ipairs(polar.lines) do if line.stroke == "#0072b2" and #line.points > 100 then ring = line.points end end
local centre <const> = { x = (ring[1].x + ring[91].x) / 2, y = ring[1].y }
for _, p in ipairs(ring) do check.near(math.sqrt((p.x - centre.x)^2 + (p.y - centre.y)^2), ring[1].x - centre.x, 0.1) end
check.that(ring[46].y < centre.y, "90° is above")
check.that(polar:text "1" and polar:text "2" and not polar:text "0")
check.that(polar.least >= 7, polar.least)
local sectors <const> = drawn{ polar = true, map = { x = { 0, 90, 180, 270 }, y = { 1, 2 }, values = { { 1, 1, 1, 1 }, { 2, 2, 1, 1 } }, names = { "in", "out" } } }
check.equal(#sectors:filled "#d6601e", 3)
-- Cells end at the first and last radius, and at the first and last angle unless they go all around.
local quarter <const> = drawn{ polar = true, map = { x = { 0, 30, 60, 90 }, y = { 0, 45, 90 }, values = { { 1, 1, 1, 1 }, { 1, 1, 1, 1 }, { 2, 2, 2, 2 } }, names = { "in", "out" } } }
local rim_of <const> = quarter:filled "#d6601e"
local pole <const> = { x = (quarter:text "90°".x + quarter:text "270°".x) / 2, y = quarter:text "0°".y }
check.that(rim_of[1].bottom < pole.y and rim_of[4].left > quarter:text "90°".x, "none below 0°, none beyond 90°")
check.that(quarter:text "80" and not quarter:text "100")
-- A small circle has names of the axes alone, and one that would not be legible is refused.
local ring_of <const> = { name = "ring", x = { 0, 90, 180, 270, 360 }, y = { 2, 2, 2, 2, 2 } }
local round <const> = { polar = true, y = "force", series = { ring_of } }
local small <const> = drawn{ size = { 1000, 600 }, columns = 2, panels = { round, round } }
check.that(small:text "90°" and small:text "270°" and not small:text "60°" and small:text "1" and small:text "2")
wrong({ columns = 3, size = { 1000, 600 }, panels = { round, round, round } }, "2 mm are left for a plot of kinds.svg, at least 15 are needed: give fewer 'columns' or a 'width' of")
wrong({ polar = true, width = 30, series = { ring_of } }, "for the plot of kinds.svg, at least 15 are needed: give a 'width' of 3")
local wide <const> = { y = "force", series = { { x = { 1, 2 }, y = { 1000, 2000 } } } }
wrong({ columns = 3, size = { 1000, 600 }, panels = { wide, wide, wide } }, "10 mm are left for a plot of kinds.svg")
drawn{ width = 101, columns = 3, panels = { wide, wide, wide } }
wrong({ polar = true, log = "y", series = { curve } }, "'polar' together with 'log'")
wrong({ polar = true, y_range = { 0, 1 }, series = { curve } }, "'polar' together with 'y_range'")
wrong({ polar = true, series = { { name = "a", x = { 1 }, y = { -1 } } } }, 'series "a": the radius -1 is negative')
wrong({ polar = true, series = { curve, { name = "b", x = { 1 }, y = { 1 }, axis = "right" } } }, "no place in a polar chart")
-- A peak of a map does not take the colours from the rest: they end at the 99th percentile, the greatest value is said apart.
local steps <const>, sums <const> = {}, {}
for j = 1, 20 do steps[j], sums[j] = j, {} for k = 1, 20 do sums[j][k] = j + k end end
sums[7][5] = 1000
local peaked <const> = drawn{ map = { x = steps, y = steps, values = sums, label = "sum" } }
check.that(peaked:text "max 1000" and peaked:text "30" and not peaked:text "500", "the bar goes to the peak")
os.remove "kinds.svg"
