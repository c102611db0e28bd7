-- Isolines, trajectories, error maps, notes, zooms, pictures side by side, cuts, bodies drawn apart, windows in space. Reads SVG; of
-- what VTK draws, an image in it, only whether two are the same, and how long it is.
local check <const>, content <const>, svgs <const> = require "check", require "bytes_of", include "letter_sizes.lua"

local function near(a, b, slack) return math.abs(a - b) <= (slack or 0.006) end
local function drawn(s, o)
  o.file, o.width, o.size, o.edges = "kinds.svg", 85, o.size or { 600, 400 }, false
  s:render(o)
  return svgs.read "kinds.svg"
end
local function frame(m) return #m == 4 and m.fill == "none" and m.stroke == "#1e1e1e" end
local function rectangle(wide, high, cells, E, nu)
  return dotyk.body{ name = "body", material = dotyk.material{ E = E, nu = nu }, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { wide, high }, cells = cells, element = "Q1" } }
end
-- A bar 6 × 2 that is pulled: the displacement along x is most x / 6, the stress uniaxial. A block on a rigid floor.
local function pulled(most)
  local bar <const> = rectangle(6, 2, { 12, 4 }, 6, 0)
  bar:part "left":fix()
  bar:part "right":load{ most, 0 }
  return dotyk.solve(dotyk.scene{ bar })
end
local function block(wide, high, load)
  local b <const> = rectangle(wide, high, { 6, 6 }, 100, 0.3)
  b:part "left":fix "x"
  b:part "top":load(function(x) return 0, load * (1 + x / wide) end)
  local scene <const> = dotyk.scene{ b }
  scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }, friction = dotyk.friction.coulomb(0.1) }
  return dotyk.solve(scene)
end
-- Numbers in letters of this size, as a text: 1 those of colour bars, 0.85 those on isolines.
local function numbers(svg, size)
  local out <const> = {}
  for _, t in ipairs(svg.texts) do if near(t.size, size * svg.em, 0.01) and svgs.number(t.text) then out[#out + 1] = t.text end end
  table.sort(out)
  return table.concat(out, " ")
end

-- 1. Isolines of a linear field: straight across the bar, at their values, which are written on them. Returns those of the broader lines.
local function isolines(svg, most)
  local x <const>, scale <const> = svgs.axis(svg, 1)
  local y <const>, values <const>, slack <const> = svgs.axis(svg, 2), {}, 0.06 / scale -- pixels are written to a hundredth, those of ticks too
  for _, m in ipairs(svg.marks) do
    local at <const> = x(m[1][1])
    if (m.stroke == "#373737" or m.stroke == "#e1e1e1") and at > slack and at < 6 - slack then -- at the ends rounding decides
      for _, p in ipairs(m) do check.near(p[1], m[1][1], 0.011) end
      check.near({ math.min(y(m[1][2]), y(m[#m][2])), math.max(y(m[1][2]), y(m[#m][2])) }, { 0, 2 }, slack, "an isoline")
      if near(m.width, math.max(0.8, svg.em / 22)) then
        values[#values + 1] = ("%.0f"):format(at * most / 6)
        check.near(at * most / 6, tonumber(values[#values]), slack, "isoline")
      end
    end
  end
  for _, t in ipairs(svg.texts) do
    local box <const>, value <const> = svgs.box(t), svgs.number(t.text)
    if near(t.size, 0.85 * svg.em, 0.01) and value then check.near(x((box[1] + box[3]) / 2), 6 * value / most, 0.3 / scale, "a number not on its line") end -- advances are known to 0.001
  end
  table.sort(values)
  return table.concat(values, " ")
end
local six <const>, plain <const> = pulled(6), { field = "ux", isolines = true, deform = 0 }
local svg = drawn(pulled(5), plain)
check.equal(isolines(svg, 5), "1 2 3 4")
check.equal(numbers(svg, 0.85), "1 2 3 4")
-- A field that is zero but for rounding is drawn as zero.
for _, zero in ipairs{ "uy", "yy", "xy" } do
  local text <const> = drawn(pulled(5), { field = zero }).text
  check.that(text:find("|max 0|", 1, true) and text:find("|min 0|", 1, true), zero .. " is not zero")
  check.that(text:find("|−1", 1, true), "one with a sign has no colours below zero")
end
-- 2. Trajectories of uniaxial tension: full along x, dashed along y, from end to end, apart.
local traced <const>, widest = drawn(six, { field = "none", trajectories = true, deform = 0 }), 0
for c = 1, 2 do
  local value <const>, scale <const> = svgs.axis(traced, 3 - c)
  local along <const>, at <const>, slack <const>, apart <const> = svgs.axis(traced, c), {}, 0.06 / scale, 1.6 * traced.em / scale
  for _, m in ipairs(traced.marks) do
    if #m > 2 and m.kind == "polyline" and m.stroke == "#1e1e1e" and (m.dash ~= nil) == (c == 2) then
      for _, p in ipairs(m) do check.near(value(p[3 - c]), value(m[1][3 - c]), slack, "straight") end
      local a <const>, b <const> = along(m[1][c]), along(m[#m][c])
      check.near({ math.min(a, b), math.max(a, b) }, c == 1 and { 0, 6 } or { 0, 2 }, 0.21 * traced.em / scale, "ends") -- a line goes on by steps of 0.2 em
      at[#at + 1] = value(m[1][3 - c])
    end
  end
  table.sort(at)
  for k = 2, #at do widest = math.max(widest, (at[k] - at[k - 1]) / apart) check.that(at[k] - at[k - 1] > apart - slack, "trajectories nearer than they should be") end
  check.that(#at >= 4 and at[1] < apart and at[#at] > (c == 1 and 2 or 6) - apart, #at .. " trajectories")
end
-- 3. Error maps: each cell has one colour, so that the image is hardly longer than one of plain bodies; those of smooth fields are.
local plate <const>, images <const> = rectangle(4, 2, { 8, 4 }, 100, 0.3), {}
plate:part "left":fix()
plate:part "right":load{ 0, -1 }
local bent <const> = dotyk.solve(dotyk.scene{ plate })
for _, field in ipairs{ "none", "von_mises", "error" } do
  svg = drawn(bent, { field = field, deform = 0 })
  images[field] = svg.images[1]
end
check.that(images.error ~= images.none and #images.error < 2 * #images.none and #images.error < #images.von_mises / 4, "cells of more than one colour")
check.near(svgs.number(svg.text:match "max ([^|]+)"), math.max(table.unpack(select(2, bent:error_estimate()).cells[1])), 0.005, "greatest error indicator") -- three digits
-- 4. Notes: a point where it is, the text near it, on the sheet, clear of other texts.
local function notes(field, said)
  local list <const>, boxes <const>, points <const> = {}, {}, {}
  for text, at in pairs(said) do list[#list + 1] = { at = at, text = text } end
  local s <const> = drawn(six, { field = field, deform = 0, notes = list })
  local x <const>, y <const>, slack <const> = svgs.axis(s, 1), svgs.axis(s, 2), 0.1 -- pixels
  for _, m in ipairs(s.marks) do if m.kind == "circle" and m.fill == "#1e1e1e" then points[#points + 1] = m[1] end end
  for _, t in ipairs(s.texts) do
    local box <const>, at <const> = svgs.box(t), said[t.text]
    for text, b in pairs(at and boxes or {}) do check.that(box[1] >= b[3] or b[1] >= box[3] or box[2] >= b[4] or b[2] >= box[4], ("note '%s' lies on '%s'"):format(t.text, text)) end
    boxes[t.text] = box
    for k = #points, 1, -1 do
      local p <const> = points[k]
      local off <const> = { math.max(box[1] - p[1], 0, p[1] - box[3]), math.max(box[2] - p[2], 0, p[2] - box[4]) }
      if at and near(x(p[1]), at[1], slack * (x(1) - x(0))) and near(y(p[2]), at[2], slack * (y(0) - y(1))) and off[1]^2 + off[2]^2 < (3.3 * s.em)^2 then table.remove(points, k) end
    end
    if at then check.that(box[1] >= 0 and box[2] >= 0 and box[3] <= s.width and box[4] <= s.height, "a note is not on the sheet") end
  end
  check.equal(#points, 0, "points without a note near them")
  for text in pairs(said) do check.that(boxes[text], text) end
end
notes("none", { held = { 0, 0 }, ["pulled to the right"] = { 6, 2 }, here = { 3, 1 }, there = { 3.1, 1.1 } })
-- 5. A zoom: a frame in the first panel where the window of the second is, one scale of colours for both.
svg = drawn(six, { field = "ux", deform = 0, zoom = { 4, 0.5, 5, 1.5 } })
local frames <const> = {}
for _, m in ipairs(svg.marks) do if frame(m) then frames[near(m.width, math.max(1.5, svg.em / 12)) and "part" or "window"] = m end end
local border <const> = frames.window[3][2] - 1
for name, within in pairs{ part = { 0, 0, svg.width, border }, window = { 0, border, svg.width, svg.height } } do
  local low <const>, high <const>, x <const>, y <const> = frames[name][1], frames[name][3], svgs.axis(svg, 1, within), svgs.axis(svg, 2, within)
  check.near({ x(low[1]), y(low[2]), x(high[1]), y(high[2]) }, { 4, 0.5, 5, 1.5 }, 0.6 * (x(1) - x(0)), name) -- a window has whole pixels
end
check.that(select(2, svg.text:gsub("|max ", "")) == 1 and svg.text:find("|max 6|", 1, true), "the scale is not that of the whole")
-- 6. Side by side: one legend without doubles, one bar whose range covers all panels with the same field, a bar each otherwise; nothing
-- outside of the sheet; rows as high as needed; equal bytes when drawn again.
local function sheet(one, other, fields, o)
  o.file, o.width, o.size = "kinds.svg", 178, o.size or { 900, 500 }
  for k, s in ipairs{ one, other } do o[k] = s:picture{ field = fields[k], deform = 3, loads = true, supports = true, title = k == 1 and "One" or "Other" } end
  dotyk.pictures(o)
  local out <const>, rows <const> = svgs.read "kinds.svg", {}
  local function covers(p, q, r, what)
    local left <const>, top <const>, right <const>, bottom <const> = math.min(p[1], q[1]) - r, math.min(p[2], q[2]) - r, math.max(p[1], q[1]) + r, math.max(p[2], q[2]) + r
    check.that(math.min(left, top) > -0.01 and right < out.width + 0.01 and bottom < out.height + 0.01, ("%s at %g, %g is not on the sheet"):format(what, left, top))
    for row = top // out.em, bottom // out.em do rows[row] = true end
  end
  for _, m in ipairs(out.marks) do for k, p in ipairs(m) do covers(p, m[k + 1] or p, m.r or 0, m.kind) end end
  for _, t in ipairs(out.texts) do local box <const> = svgs.box(t) covers({ box[1], box[2] }, { box[3], box[4] }, -0.01 * t.size, t.text) end -- advances are known to 0.001
  for row = 2, out.height // out.em do check.that(rows[row] or rows[row - 1] or rows[row - 2], "a blank band") end
  return out
end
local light <const>, heavy <const> = block(4, 1, -1), block(4, 1, -3)
svg = sheet(light, heavy, { "yy", "yy" }, {})
local bytes <const>, seen <const>, least, greatest = content "kinds.svg", {}, math.huge, -math.huge
for _, t in ipairs(svg.texts) do
  if near(t.size, 0.85 * svg.em, 0.01) then check.that(not seen[t.text], "twice: " .. t.text) seen[t.text] = true end
end
for _, name in ipairs{ "stick", "slip", "contact pressure", "rigid obstacle", "undeformed", "deformation × 3" } do check.that(seen[name], name .. " is not in the legend") end
for _, s in ipairs{ light, heavy } do
  local alone <const> = drawn(s, { field = "yy", deform = 3 }).text
  least, greatest = math.min(least, svgs.number(alone:match "min ([^|]+)")), math.max(greatest, svgs.number(alone:match "max ([^|]+)"))
end
local high <const>, low <const> = svg.text:match "|max ([^|]+)|min ([^|]+)|stress yy|"
check.equal({ svgs.number(low), svgs.number(high), select(2, svg.text:gsub("|min ", "")) }, { least, greatest, 1 }, "one bar")
sheet(light, heavy, { "yy", "yy" }, {})
check.that(content "kinds.svg" == bytes, "drawn again other bytes")
check.equal(select(2, sheet(light, heavy, { "yy", "xx" }, {}).text:gsub("|min ", "")), 2, "bars")
-- Where factors of the deformation differ each picture says its own.
dotyk.pictures{ file = "kinds.svg", width = 178, light:picture{ deform = 1 }, light:picture{ deform = 2 } }
local scales <const> = {}
for _, t in ipairs(svgs.read("kinds.svg").texts) do if t.text:find "scale" or t.text:find "deformation" then scales[t.text] = (svgs.box(t)[1] + svgs.box(t)[3]) / 2 < svgs.read("kinds.svg").width / 2 and "left" or "right" end end
check.equal(scales, { ["true scale"] = "left", ["deformation × 2"] = "right" })
-- Frames of the same bodies share the automatic factor, and pictures of one field its range, though another field is there.
dotyk.pictures{ file = "kinds.svg", width = 178, light:picture{ field = "yy" }, heavy:picture{ field = "yy" }, heavy:picture{ field = "xx" } }
local shared <const>, ranges = svgs.read "kinds.svg", {}
check.that(select(2, shared.text:gsub("deformation × ", "")) == 1, "several factors: " .. shared.text)
for _, t in ipairs(shared.texts) do if near(t.size, shared.em, 0.01) and svgs.number(t.text) and t.x < 2 * shared.width / 3 then ranges[t.text] = (ranges[t.text] or 0) + 1 end end
for number, times in pairs(ranges) do check.equal(times, 2, "on one bar alone: " .. number) end
check.that(next(ranges), "no numbers")
-- A load that pushes ends at the surface, wherever that is; one that pulls begins there.
local slab <const> = rectangle(6, 0.4, { 30, 2 }, 100, 0.3)
slab:part "bottom":fix()
slab:part "top":load(function(x) return 1, x < 3 and -1 or 1 end)
local sides <const> = { 0, 0 }
local loaded <const> = drawn(dotyk.solve(dotyk.scene{ slab }), { field = "none", loads = true, deform = 0 })
local y <const>, x <const> = svgs.axis(loaded, 2), svgs.axis(loaded, 1)
for _, m in ipairs(loaded.marks) do
  if m.kind == "polygon" and #m == 3 and m.fill == "#00466e" and y(m[1][2]) > 0.3 then
    local tip, foot = m[1], { (m[2][1] + m[3][1]) / 2, (m[2][2] + m[3][2]) / 2 }
    for k = 1, 3 do local a <const>, b <const>, c <const> = m[k], m[k % 3 + 1], m[(k + 1) % 3 + 1] if (a[1] - b[1])^2 + (a[2] - b[2])^2 > (b[1] - c[1])^2 + (b[2] - c[2])^2 and (a[1] - c[1])^2 + (a[2] - c[2])^2 > (b[1] - c[1])^2 + (b[2] - c[2])^2 then tip, foot = a, { (b[1] + c[1]) / 2, (b[2] + c[2]) / 2 } end end
    local pushes <const> = y(tip[2]) < y(foot[2])
    check.equal(pushes, x(tip[1]) < 3.2, "direction at " .. x(tip[1]))
    check.equal(near(y(tip[2]), 0.4, 0.02), pushes, "the tip at " .. x(tip[1]))
    sides[pushes and 1 or 2] = sides[pushes and 1 or 2] + 1
  end
end
check.that(sides[1] > 2 and sides[2] > 2, table.concat(sides, " ") .. " arrows")
local lines <const>, column <const> = {}, sheet(light, block(1, 3, -1), { "yy", "yy" }, { columns = 1, size = { 700, 900 } })
for _, t in ipairs(column.texts) do lines[t.text] = t.y end
check.that(lines.Other - lines.One < lines.stick - lines.Other - 4 * column.em, "the row of a flat body is as high as that of a tall one")
-- 7. Space: what a cut shows, bodies drawn apart, a window.
local half <const> = {}
for z = 0, 1 do
  half[z] = dotyk.body{ name = "half " .. z, material = dotyk.material{ E = 1e5, nu = 0 }, mesh = dotyk.mesh.box{ from = { 0, 0, z }, to = { 2, 1, z + 1 }, cells = { 4, 4, 2 }, element = "Q1" } }
  half[z]:part(z == 0 and "front" or "back"):fix()
end
half[1]:part "top":load{ 0, 0, -1 }
half[1]:part "front":load(function(x) return 0, x, 0 end)
local blocks <const> = dotyk.scene{ half[0], half[1] }
blocks:contact{ half[1]:part "bottom", half[0]:part "top" }
local both <const> = dotyk.solve(blocks)
local function from_front(o)
  o.view, o.deform, o.inset, o.contact, o.size = { 0, -1, 0 }, 1, false, false, { 400, 300 } -- without a legend: the displacement is not seen
  o.notes = { { at = { 0.3, 0, 0.5 }, text = "a" }, { at = { 0.7, 0, 0.5 }, text = "b" }, { at = { 2, 0, 2 }, text = "c" } }
  local out <const>, at <const> = drawn(both, o), {}
  for _, m in ipairs(out.marks) do
    if m.kind == "circle" and m.fill == "#1e1e1e" then at[#at + 1] = m[1][1] end
    if frame(m) then out.frame = m end
  end
  out.notes, out.unit = #at, (at[2] - at[1]) / 0.4 -- pixels
  return out
end
local function cut(field, y) return from_front{ field = field, range = { -2e-5, 2e-5 }, cut = y and { point = { 0, y, 0 }, normal = { 0, -1, 0 } } }.images[1] end
check.that(cut "uy" ~= cut("uy", 0.3) and cut("uy", 0.3) ~= cut("uy", 0.6) and cut("none", 0.3) == cut("none", 0.6), "a cut shows the field on it") -- faces look alike from the front
local function error_on(y) return from_front{ field = "error", range = { 0, 1e-3 }, cut = { point = { 0, y, 0 }, normal = { 0, -1, 0 } } }.images[1] end
check.that(error_on(0.3) ~= cut("none", 0.3) and error_on(0.3) ~= error_on(0.6) and error_on(0.3) == error_on(0.4), "a cut shows the errors of cells") -- of rows of cells 0.25 thick
-- A field of contacts in space is seen on its map beside the scene, too; the bar beside them keeps room for its numbers.
local function beside(field)
  local out <const> = drawn(both, { field = field, units = { length = "mm", stress = "MPa" } })
  local bar <const> = {}
  for _, t in ipairs(out.texts) do if near(t.size, out.em, 0.01) and svgs.number(t.text) then bar[#bar + 1] = { svgs.number(t.text), t.y } end end
  table.sort(bar, function(a, b) return a[1] < b[1] end)
  for k = 2, #bar do check.that(bar[k][2] < bar[k - 1][2] - 0.9 * out.em, "numbers of the bar do not ascend") end
  check.that(#bar >= 2, "a bar without numbers")
  return #out.images
end
check.equal({ beside "von_mises", beside "pressure" }, { 1, 2 }, "images: of the scene; of the map where it has colours")
local whole <const>, apart <const> = from_front{ field = "none" }, from_front{ field = "none", explode = 0.5 }
check.near(apart.unit / whole.unit, 2 / 2.5, 0.005, "the height of bodies drawn apart fills the picture")
for _, from in ipairs{ { 0.5, -1, 1 }, { 0.5, -1, -1 } } do -- drawn apart, both bodies show the contact
  local images <const> = {}
  for k, most in ipairs{ 1e-3, 1e3 } do images[k] = drawn(both, { field = "pressure", explode = 2, view = from, range = { 0, most } }).images[1] end
  check.that(images[1] ~= images[2], "no contact is seen")
end
local part <const> = from_front{ field = "none", window = { 0, 0, 0, 1, 1, 1.5 } }
check.equal({ whole.notes, part.notes, whole.frame }, { 3, 2 }, "notes in the window")
check.near({ (part.frame[2][1] - part.frame[1][1]) / part.unit, (part.frame[1][2] - part.frame[3][2]) / part.unit }, { 1, 1.5 }, 0.01, "window") -- it has whole pixels
check.that(part.unit > 1.3 * whole.unit, "a window shows its part larger")
-- 8. Trajectories are evenly apart; isolines are those of the bar's numbers; its name is not broken within words; notes are clear of it,
-- with indices of at least 7 points.
svg = drawn(six, plain)
check.near(widest, 1, 0.01, "distance of trajectories")
check.equal("0 " .. isolines(svg, 6) .. " 6", numbers(svg, 1), "isolines and the numbers of the bar")
check.that(svg.text:find "displacement", svg.text)
notes("ux", { ["other corner"] = { 6, 2 } })
for size in pairs(drawn(six, { field = "none", units = { length = "R_0" }, notes = { { at = { 3, 1 }, text = "λ_max" } } }).sizes) do check.that(size >= 7, "letters of " .. size .. " points") end
os.remove "kinds.svg"
