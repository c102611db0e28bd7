-- Rules that hold for all pictures of scenes, each on a picture made for it. Reads SVG.
local check <const>, svgs <const> = require "check", include "letter_sizes.lua"
local function near(a, b, slack) return math.abs(a - b) <= slack end
local function drawn(s, o)
  o.file, o.width, o.size = "rules.svg", 85, o.size or { 400, 300 }
  s:render(o)
  return svgs.read "rules.svg"
end
local function rectangle(from, to, cells, transform)
  local mesh <const> = dotyk.mesh.rectangle{ from = from, to = to, cells = cells, element = "Q1" }
  return dotyk.body{ name = "body", material = dotyk.material{ E = 100, nu = 0.3 }, mesh = transform and mesh:transform(transform) or mesh }
end
local function solved(body, contact)
  local scene <const> = dotyk.scene{ body }
  local c <const>, s <const> = contact and scene:contact(contact), dotyk.solve(scene)
  check.that(s.converged)
  return s, c
end
-- A slab, 1 high, pressed on a floor, in the plane or in space; load(x): across and up.
local function on_floor(space, long, cells, load, gap, friction)
  local function vector(x, p) if space then return x, 0, p end return x, p end
  local mesh <const> = space and dotyk.mesh.box{ from = { 0, 0, 0 }, to = { long, 1, 1 }, cells = cells, element = "Q1" }
  local body <const> = space and dotyk.body{ name = "slab", material = dotyk.material{ E = 100, nu = 0.3 }, mesh = mesh } or rectangle({ 0, 0 }, { long, 1 }, cells)
  body:part "top":load(function(x) return vector(load(x)) end)
  return solved(body, { body:part "bottom", rigid = dotyk.rigid.gap{ normal = { vector(0, -1) }, gap = gap }, friction = dotyk.friction.coulomb(friction) })
end
local function off(colour, r, g, b) return math.max(math.abs(tonumber(colour:sub(2, 3), 16) - r), math.abs(tonumber(colour:sub(4, 5), 16) - g), math.abs(tonumber(colour:sub(6, 7), 16) - b)) end
-- 1. Signed fields diverge about zero: light grey there, the end of the map's colours at the greater end alone; others do not.
local lever <const> = rectangle({ 0, 0 }, { 4, 1 }, { 16, 6 })
lever:part "left":fix()
lever:part "right":load{ 0, -1 }
local bent <const> = solved(lever)
for _, field in ipairs{ "ux", "xx", "xy" } do
  local b <const> = svgs.bar(drawn(bent, { field = field, deform = 0 }))
  check.that(off(b.colour(0), 247, 247, 247) <= 8, field .. " has " .. b.colour(0) .. " at zero") -- the bar has boxes of up to 2 %
  check.that(b.high > -b.low and off(b.colour(b.high), 103, 0, 31) <= 10 or b.high <= -b.low and off(b.colour(b.low), 5, 48, 97) <= 10, field)
end
local given <const>, mises <const> = svgs.bar(drawn(bent, { field = "xx", deform = 0, range = { -1, 3 } })), svgs.bar(drawn(bent, { field = "von_mises", deform = 0 }))
check.that(off(given.colour(0), 247, 247, 247) <= 8 and off(given.colour(3), 103, 0, 31) <= 10 and off(given.colour(-1), 167, 208, 228) <= 10, "RdBu, a third of the way to blue at -1 of 3")
check.that(off(mises.colour(mises.low), 68, 1, 84) <= 8 and off(mises.colour(mises.high), 253, 231, 37) <= 8, "viridis from end to end")
-- 2. A peak half as high again as the 99th percentile shortens the range to that: a triangle at that end, least and greatest written.
-- The displacement is 0.1 + h φ, φ = 1 at one node of the upper side and small where there are most.
local function spiked(h, sense)
  local square <const>, values <const> = rectangle({ 0, 0 }, { 1, 1 }, { 30, 30 }), {}
  square:part "bottom":displace{ x = 0, y = 0.1 * sense }
  square:part "top":displace{ x = 0, y = function(x) return sense * (0.1 + (math.abs(x - 0.5) < 0.01 and h or 0)) end }
  local s <const> = solved(square)
  for i = 0, 30 do for j = 0, 30 do values[#values + 1] = sense * select(2, s:displacement(square, i / 30, j / 30)) end end
  table.sort(values)
  return s, values[#values - math.floor(0.01 * #values)], values[1]
end
local share <const> = select(2, spiked(1, 1)) - 0.1 -- φ at the percentile
for _, case in ipairs{ { 1.45, 1, "max", "min" }, { 1.55, 1, "max", "min", "above" }, { 1.55, -1, "min", "max", "below" } } do
  local ratio <const>, sense <const>, h <const> = case[1], case[2], 0.1 * (case[1] - 1) / (1 - case[1] * share)
  local s <const>, percentile <const>, least <const> = spiked(h, sense)
  local b <const> = svgs.bar(drawn(s, { field = "uy", deform = 0 }))
  check.near({ (0.1 + h) / percentile, sense > 0 and b.high or -b.low }, { ratio, case[5] and percentile or 0.1 + h }, 0.002, "end of the bar") -- pixels are written to a hundredth
  check.equal(b.beyond, { case[5] }, "triangles")
  check.near({ svgs.number(b.text:match(case[3] .. " ([^|]+)")), svgs.number(b.text:match(case[4] .. " ([^|]+)")) }, { sense * (0.1 + h), sense * least }, 0.0006) -- three digits
end
-- A peak as high over as small a part that is no single point does not: what lies between it and its neighbours is known.
local hill <const> = rectangle({ 0, 0 }, { 1, 1 }, { 60, 60 })
hill:part "bottom":displace{ x = 0, y = 0.1 }
hill:part "top":displace{ x = 0, y = function(x) return 0.1 + 0.08 * math.max(0, 1 - (24 * (x - 0.5))^2) end }
local raised <const> = solved(hill)
local top <const>, above = svgs.bar(drawn(raised, { field = "uy", deform = 0 })), 0
for i = 0, 60 do for j = 0, 60 do above = above + (select(2, raised:displacement(hill, i / 60, j / 60)) > 0.18 / 1.5 and 1 or 0) end end
check.that(above < 0.01 * 61^2, above .. " nodes: not a peak that colours would leave out")
check.near(top.high, 0.18, 0.002)
check.equal(top.beyond, {}, "triangles")
-- 3. At 85 mm at least four numbers on an axis where there is room, three on a bar.
for _, case in ipairs{ { 0, 0, 1, 1 }, { 0, 0, 3, 1 }, { 0, 0, 2, 4 }, { -1, -0.5, 0.2, 0.7 }, { 1000, 0, 1003, 2 }, { 0, 0, 5e-4, 3e-4 }, { 0, 0, 1.1e5, 1e5 } } do
  local body <const>, numbers <const>, widest = rectangle({ case[1], case[2] }, { case[3], case[4] }, { 4, 4 }), {}, 0
  body:part "left":fix()
  body:part "right":load(function(_, y) return y + 1, 0 end)
  local svg <const> = drawn(solved(body), { field = "xx", deform = 0, size = { 600, 450 } })
  for _, t in ipairs(svg.texts) do if near(t.size, 0.88 * svg.em, 0.01) and svgs.number(t.text) then numbers[#numbers + 1] = svgs.number(t.text) widest = math.max(widest, svgs.width(t.text) * t.size) end end
  local _ <const>, unit <const>, count <const> = svgs.axis(svg, 1)
  local _ <const>, unit_up <const>, count_up <const> = svgs.axis(svg, 2)
  local step <const>, long <const>, high <const> = numbers[2] - numbers[1], (numbers[count] - numbers[1]) * unit, (numbers[#numbers] - numbers[count + 1]) * unit_up
  local finer <const> = step / (math.abs(math.log(step / 5, 10) % 1 - 0.5) > 0.49 and 2.5 or 2) -- steps are 5, 2, 1
  check.that(count >= 4 or (long / unit / finer + 1) * (widest + 1.7 * svg.em) > long, count .. " numbers across") -- a finer step has a digit and a point more
  check.that((count_up >= 4 or high < 6 * svg.em) and svgs.bar(svg).count >= 3, count_up .. " numbers up, " .. svgs.bar(svg).count .. " on the bar")
end
-- 4. Units on axes, at the field, pressure, shear and load. 5. "true scale" at × 1, else the factor. A slab slips, but for a node that sticks and for gaps.
local function sliding(space, cells)
  return on_floor(space, 4, cells, function() return 0.07, -1 end, function(x) return (x > 3.5 or math.abs(x - 1) < 0.1) and 0.5 or 0 end, function(x) return math.abs(x - 2) < 0.1 and 5 or 0.1 end)
end
local flat <const>, line <const> = sliding(false, { 20, 5 })
local solid <const>, surface <const> = sliding(true, { 20, 5, 2 })
local units <const>, moved <const> = { length = "mm", stress = "MPa", load = "N/mm²" }, drawn(bent, { field = "none", deform = 1 })
local svg, space <const> = drawn(flat, { size = { 800, 500 }, deform = 1, loads = true, units = units }), drawn(solid, { field = "displacement", deform = 5, units = units })
local function has(p, ...) for _, text in ipairs{ ... } do check.that((" " .. p.text:gsub("|", " ") .. " "):find(" " .. text .. " "), ("no '%s' in %s"):format(text, p.text)) end end
has(svg, "x %[mm%]", "y %[mm%]", "von Mises stress %[MPa%]", "load, at most 1 N/mm²", "max [%d.]+ MPa", "shear, at most [%d.]+ MPa")
has(space, "displacement %[mm%]", "contact pressure, at most [%d.]+ MPa", "deformation × 5")
check.that(moved.text:find "|true scale|" and not moved.text:find "deformation" and not space.text:find "true scale", moved.text)
-- 6. Each run of a status along the contact line has a marker of its shape; markers stand at nodes of their status. 7. The colour of a
-- status is one in the plane, on maps and in legends; on maps of statuses what is open is pale.
local colour <const>, shape <const>, pale <const> = { open = "#56b4e9", stick = "#cc79a7", slip = "#e69f00" }, { open = "circle", stick = 4, slip = 3 }, "#d5edfa"
local function middle(m) -- of its points
  local x, y = 0, 0
  for _, p in ipairs(m) do x, y = x + p[1] / #m, y + p[2] / #m end
  return x, y
end
local across <const>, up <const>, marked <const>, nodes <const>, reached = svgs.axis(svg, 1), svgs.axis(svg, 2), {}, {}, false
for _, n in ipairs(flat:contact(line).nodes) do nodes[math.floor(5 * n.x + 0.5)] = n.status end
for _, m in ipairs(svg.marks) do
  local x, y = middle(m)
  if #m == 2 then x, y = m[1][1], m[1][2] end -- a piece of the line begins at its node and goes to where the pressure ends
  for status, c in pairs(near(up(y), 0, 0.06) and colour or {}) do
    local k <const> = math.floor(5 * across(x) + 0.5)
    if m.stroke == c or m.fill == c then check.equal(nodes[k], status, "at " .. across(x)) end -- the line, markers
    if m.fill == c and (m.kind == "polygon" or m.r > 0.2 * svg.em) then check.equal(m.r and m.kind or #m, shape[status], status) marked[k] = true end
  end
end
for k = 0, 20 do
  reached = marked[k] or nodes[k - 1] == nodes[k] and reached
  check.that(reached or nodes[k + 1] == nodes[k], "a run without a marker: " .. nodes[k])
end
local states <const>, fills <const> = drawn(solid, { map = surface, field = "status", shear = false }), {}
for _, m in ipairs(states.marks) do if m.kind == "polygon" and #m == 4 and m.fill ~= "none" and svgs.axis(states, 2)(m[1][2]) > -0.1 then fills[m.fill] = true end end
check.equal(fills, { [pale] = true, [colour.stick] = true, [colour.slip] = true }, "the map")
-- Stick and slip have nearly the same grey: what slips, and that alone, is hatched.
local hatching <const>, hatched, slipping = "#5a3700", 0, {}
for _, m in ipairs(states.marks) do if m.kind == "polygon" and m.fill == colour.slip then slipping[#slipping + 1] = m end end
for _, m in ipairs(states.marks) do
  if m.stroke == hatching and svgs.axis(states, 2)(m[1][2]) > -0.1 then
    local x <const>, y <const> = (m[1][1] + m[2][1]) / 2, (m[1][2] + m[2][2]) / 2
    local inside = false
    for _, p in ipairs(slipping) do inside = inside or near(x, (p[1][1] + p[3][1]) / 2, math.abs(p[1][1] - p[3][1]) / 2 + 0.02) and near(y, (p[1][2] + p[3][2]) / 2, math.abs(p[1][2] - p[3][2]) / 2 + 0.02) end
    check.that(inside, "hatched where it does not slip")
    hatched = hatched + 1
  end
end
check.that(hatched > #slipping / 4, "slip without hatching")
for p, of_open in pairs{ [svg] = colour.open, [drawn(solid, { map = surface })] = colour.open, [states] = pale } do
  for status, c in pairs(colour) do
    local own <const> = { ["#ffffff"] = true }
    for _, m in ipairs(svgs.sample(p, status)) do if m.stroke ~= hatching then own[m.stroke or m.fill] = true end end
    check.equal(own, { ["#ffffff"] = true, [status == "open" and of_open or c] = true }, "legend of " .. status)
  end
end
-- 8. The hatching of an obstacle, a disc below an arch, lies on its side of the line, along its normal, and looks as in the legend.
local arch <const>, ball <const> = rectangle({ -1, 0 }, { 1, 1 }, { 20, 10 }, function(x, y) return x, y + math.sqrt(2.5^2 - x^2) - 2.5 end), dotyk.rigid.ball{ center = { 0, -2.5 }, radius = 2.5 }
arch:part "top":load{ 0, -1 }
arch:part "left":fix "x"
svg = drawn(solved(arch, { arch:part "bottom", rigid = ball }), { field = "none", deform = 1, size = { 600, 450 } })
local x <const>, unit <const> = svgs.axis(svg, 1)
local y <const>, em <const>, count <const> = svgs.axis(svg, 2), svg.em / unit, {}
local function depth(p) return 2.5 - math.sqrt(x(p[1])^2 + (y(p[2]) + 2.5)^2), 2.5 * math.atan(x(p[1]), y(p[2]) + 2.5) end -- and the place along the surface
for _, m in ipairs(svg.marks) do
  local kind <const>, low <const>, along <const> = m.stroke == "#8c8c8c" and "stroke" or m.fill == "#e2e2e2" and #m == 4 and "ground", depth(m[1])
  if low < 1.5 * em and kind then
    local last <const>, away <const> = depth(m[#m])
    for _, p in ipairs(m) do check.that(depth(p) > -0.05 * em and depth(p) < 0.8 * em, "hatching off its side") end -- of chords, along mean normals
    check.near({ last, math.abs(away - along) }, { kind == "stroke" and last or 0.75 * em, kind == "stroke" and 0.7 * (last - low) or 0 }, 0.1 * em, "along the normal, strokes aslant")
    count[kind] = (count[kind] or 0) + 1
  end
end
for _, m in ipairs(svgs.sample(svg, "rigid obstacle")) do
  count[m.stroke or m.fill] = true
  check.that(m.stroke ~= "#8c8c8c" or near(math.abs((m[2][1] - m[1][1]) / (m[2][2] - m[1][2])), 0.7, 0.02), "slant in the legend")
end
check.that(count.ground >= 10 and count.stroke > 10 and count["#e2e2e2"] and count["#8c8c8c"] and count["#5f5f5f"], "hatching")
-- 9. The arrow of the greatest shear is among those drawn, and the longest, as an ordinate of that pressure in the plane, which are 2 to 4.5 em, 1.3 em on a map;
-- heads have shafts.
local function arrows(p)
  local shafts, out <const>, tail = 0, {}, nil
  for k, m in ipairs(p.marks) do
    if m.stroke == "#960f28" then shafts, tail = shafts + 1, m[1] end
    if m.kind == "polygon" and m.fill == "#960f28" then
      local function way(q) return math.sqrt((tail[1] - q[1])^2 + (tail[2] - q[2])^2) / p.em end
      out[#out + 1] = { tail = tail, head = m[3], long = way(m[3]), order = k, middle(m) }
      check.that(#out == shafts and #m == 3 and way(m[1]) > 0.3 * way(m[3]), "a head without a shaft")
    end
  end
  check.equal(shafts, #out, "heads of shafts")
  table.remove(out, 1) -- that of the legend
  table.sort(out, function(a, b) return a.long > b.long end)
  return out
end
local rubbed, hidden = nil, 0
for _, space in ipairs{ true, false } do
  local s <const>, c <const> = on_floor(space, 3, space and { 30, 10, 2 } or { 60, 12 }, function(at) local p <const> = 0.05 + 3 / (1 + 40 * (at - 1.23)^2)^2 return 0.4 * p, -p end, function() return 0 end,
    function(at) return (space or math.abs(at - 1.4) < 0.6) and 0.6 or 0.15 end)
  local p <const>, most = drawn(s, space and { map = c } or { field = "none", deform = 0 }), { shear = { 0, 0 } }
  for _, n in ipairs(s:contact(c).nodes) do if n.shear[1]^2 + n.shear[2]^2 > most.shear[1]^2 + most.shear[2]^2 then most = n end end
  local all <const>, place <const> = arrows(p), svgs.axis(p, 1)
  local share <const> = math.sqrt(most.shear[1]^2 + most.shear[2]^2) / s:contact(c).max_pressure
  check.near({ all[1].long, place(space and all[1].tail[1] or (all[1].tail[1] + all[1].head[1]) / 2) }, { space and 1.3 or math.min(math.max(all[1].long, 2 * share), 4.5 * share), most.x }, 0.03, "the greatest shear") -- pixels; on maps arrows begin at the rim of a marker
  for k, m in ipairs(p.marks) do -- what is drawn later
    local marker <const>, mx <const>, my <const> = space and m.kind == "polygon" and (m.fill == colour.stick or m.fill == colour.slip), middle(m)
    for _, a in ipairs(marker and all or {}) do hidden = hidden + (k > a.order and math.max(math.abs(a[1] - mx), math.abs(a[2] - my)) < 0.2 * p.em and 1 or 0) end
  end
  rubbed = s
end
-- 10. The greatest pressure in words is clear of supports, outlines, obstacles, ordinates and axes.
for _, n in ipairs{ { 0, 1 }, { 0, -1 }, { -1, 0 }, { 1, 0 } } do -- away from the obstacle
  local block <const>, found = rectangle({ -1, -1 }, { 1, 1 }, { 16, 16 }), nil
  local function along(a, b) return a * n[2] - b * n[1] end
  local function faces(nx, ny) return nx * n[1] + ny * n[2] end
  block:part("far", function(_, _, ...) return faces(...) > 0.9 end):load{ -2 * n[1], -2 * n[2] }
  block:part("held", function(a, b, ...) return faces(...) < -0.9 and along(a, b) > 0.6 or along(...) < -0.9 end):fix()
  local s <const> = solved(block, { block:part("near", function(a, b, ...) return faces(...) < -0.9 and along(a, b) < 0.6 end), rigid = dotyk.rigid.plane{ point = { -n[1], -n[2] }, normal = n } })
  svg = drawn(s, { field = "none", supports = true, loads = true, deform = 10 })
  for _, t in ipairs(svg.texts) do
    local box <const> = t.fill == "#2d325a" and svgs.box(t)
    found = found or box
    for _, m in ipairs(box and svg.marks or {}) do
      for k = 1, ("#282828 #828282 #5f5f5f #2d325a #1e1e1e"):find(m.stroke or m.fill, 1, true) and 100 * #m or 0 do -- points of its sides
        local a <const>, b <const>, p <const> = m[(k - 1) // 100 + 1], m[(k - 1) // 100 + 2] or m[1], {}
        for c = 1, 2 do p[c] = a[c] + k % 100 / 100 * (b[c] - a[c]) end
        check.that(p[1] < box[1] or p[1] > box[3] or p[2] < box[2] or p[2] > box[4], ("'%s' lies on a line, obstacle at %g, %g"):format(t.text, -n[1], -n[2]))
      end
    end
  end
  check.that(found, "no greatest pressure in words")
end
-- 11. In windows and insets, and with rounding, too; markers of maps lie beside arrows.
check.that(svgs.bar(drawn(flat, { field = "von_mises", window = { 0.5, -0.5, 2.5, 0.5 }, units = units, size = { 600, 400 } })).count >= 3, "numbers on the bar beside a window")
has(drawn(solid, { field = "none", units = units }), "x %[mm%]", "y %[mm%]")
arrows(drawn(rubbed, { field = "none", window = { 1.25, -0.3, 1.8, 0.3 } }))
check.equal(hidden, 0, "heads of arrows below markers")
check.that(not drawn(flat, { field = "uy", deform = 0 }).text:find "max [^|]* × 10", "rounding as a value")
-- 12. A pressure at the edge of a punch has no bound, and the picture says so; that of a block on a floor has one. Thousands of Pa are kPa.
local pressed <const> = rectangle({ -1, -1 }, { 1, 0 }, { 16, 8 })
pressed:part "bottom":fix()
local punch <const> = { pressed:part("under", function(x, _, _, ny) return ny > 0.9 and math.abs(x) < 0.5 end), rigid = dotyk.rigid.gap{ normal = { 0, 1 }, gap = -0.02 } }
svg = drawn(solved(pressed, punch), { field = "von_mises", units = { stress = "Pa" }, size = { 600, 450 } })
has(svg, "max [%d.]+ Pa, singular at an edge")
check.that(not drawn(flat, {}).text:find "singular", "no edge presses there")
local bar <const> = dotyk.body{ name = "bar", material = dotyk.material{ E = 1e12, nu = 0 }, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 4, 2 } } }
bar:part "left":fix()
bar:part "right":load(function(_, y) return 2e5 * (1 + y), 0 end)
has(drawn(solved(bar), { field = "xx", deform = 0, loads = true, units = { stress = "Pa", load = "Pa" } }), "stress xx %[kPa%]", "load, at most [%d.]+ kPa")
os.remove "rules.svg"
