-- The sizes of letters of the pictures that scripts make, as printed: each is drawn as SVG and as PDF, 85 and 178 mm wide, in a scratch folder.
--
--   dotyk tests/figure/letter_sizes.lua [SCRIPT…]
--
-- SCRIPT is a file of scripts/ without .lua, as studies/stability/rho. Prints a table; fails where letters are below 7 points, or
-- where PDF and SVG differ in size, in the number of pages, or in the sizes of their letters (these are read by pdftotext).
-- Tests include this file: it gives them svg, which reads SVG files.
local content <const> = include "../lua/bytes_of.lua"

local svg <const> = {}

-- Of a file: width and height in pixels, in points; marks (kind, fill, stroke, width, dash, r; 1 … n their points, y downwards), texts (x, y, size,
-- text; upright), and the bytes of images. em: pixels of 8.25 points, the size of letters of axes.
function svg.read(file)
  local all <const> = content(file)
  local wide <const>, high <const>, width <const>, height <const> = all:match 'width="([%d.]+)pt" height="([%d.]+)pt" viewBox="0 0 (%d+) (%d+)"'
  local out <const> = { width = tonumber(width), height = tonumber(height), points = { tonumber(wide), tonumber(high) }, marks = {}, texts = {}, sizes = {}, images = {} }
  out.em = 8.25 * out.width / out.points[1]
  for kind, rest in all:gmatch "<(%a+) ([^>]*)/>" do
    local function of(name) return rest:match("%f[%w]" .. name .. '="([^"]*)"') end
    if kind == "image" then
      out.images[#out.images + 1] = of "href"
    else
      local m <const> = { kind = kind, fill = of "fill", stroke = of "stroke", width = tonumber(of "stroke%-width"), dash = of "stroke%-dasharray", r = tonumber(of "r") }
      for x, y in (of "points" or of "cx" .. "," .. of "cy"):gmatch "(%S+),(%S+)" do m[#m + 1] = { tonumber(x), tonumber(y) } end
      out.marks[#out.marks + 1] = m
    end
  end
  for x, y, turned, size, fill, runs in all:gmatch '<text transform="translate%(([^ ]+) ([^)]+)%)([^"]*)" font%-size="([^"]+)" fill="([^"]+)".->(.-)</text>' do
    out.texts[#out.texts + 1] = { x = tonumber(x), y = tonumber(y), upright = turned ~= "", size = tonumber(size), fill = fill, text = runs:gsub("<[^>]*>", ""):gsub("&lt;", "<"):gsub("&amp;", "&") }
  end
  local lines <const> = {}
  for k, t in ipairs(out.texts) do lines[k] = t.text end
  out.text = "|" .. table.concat(lines, "|") .. "|"
  for size in all:gmatch 'font%-size="([%d.]+)"' do out.sizes[size * out.points[1] / out.width] = true end
  return out
end

-- The width of a text in letters of size 1: advances of DejaVu Sans from space to ~ in thousandths; of others superscripts, signs, letters.
local advances <const> = {}
for w in ([[318 401 460 838 636 950 780 275 390 390 500 838 318 361 318 337 636 636 636 636 636 636 636 636 636 636 337 337 838 838 838 531 1000 684 686 698 770 632
  575 775 752 295 295 656 557 863 748 787 603 787 695 635 611 732 684 989 685 611 685 390 337 390 838 500 500 613 635 550 635 615 352 635 634 278 278 579 278 974 634 612
  635 635 411 521 392 634 592 818 592 592 525 636 337 636 838]]):gmatch "%d+" do advances[#advances + 1] = w / 1000 end
function svg.width(text)
  local sum = 0
  for _, c in utf8.codes(text) do sum = sum + (advances[c - 31] or ("²³¹⁰⁴⁵⁶⁷⁸⁹"):find(utf8.char(c), 1, true) and 0.401 or c < 0x2000 and 0.636 or 0.838) end
  return sum
end

-- The box of a text: left, top, right, bottom.
function svg.box(t)
  local long <const> = svg.width(t.text) * t.size
  if t.upright then return { t.x - 0.76 * t.size, t.y - long, t.x + 0.24 * t.size, t.y } end
  return { t.x, t.y - 0.76 * t.size, t.x + long, t.y + 0.24 * t.size }
end

function svg.number(text) return tonumber((text:gsub("−", "-"))) end

-- Pixels to values along the axis across (1) or up (2) of a picture, or of one within a box of it, by its ticks and their numbers; and pixels
-- of a unit.
function svg.axis(picture, c, within)
  local at <const>, numbers <const> = {}, {}
  local function inside(x, y) return not within or x >= within[1] and y >= within[2] and x <= within[3] and y <= within[4] end
  for _, m in ipairs(picture.marks) do
    local p <const>, q <const> = m[1], m[2]
    local tick <const> = #m == 2 and m.stroke == "#1e1e1e" and p[c] == q[c] and math.abs(math.abs(p[3 - c] - q[3 - c]) - 0.28 * picture.em) < 0.02
    if tick and inside(p[1], p[2]) then at[#at + 1] = p[c] end
  end
  for _, t in ipairs(picture.texts) do if math.abs(t.size - 0.88 * picture.em) < 0.01 and inside(t.x, t.y) then numbers[#numbers + 1] = svg.number(t.text) end end
  local first <const> = c == 1 and 1 or #numbers - #at + 1 -- those of the axis across are written first
  local scale <const> = (numbers[first + #at - 1] - numbers[first]) / (at[#at] - at[1])
  local function value(pixel) return numbers[first] + scale * (pixel - at[1]) end
  for k, pixel in ipairs(at) do assert(math.abs(value(pixel) - numbers[first + k - 1]) <= 0.03 * math.abs(scale), "a tick is not where its number says") end
  return value, 1 / math.abs(scale), #at
end

-- The colour bar of a picture: low, high (its ends), count of numbers, beyond ("above", "below": its triangles), colour(value), text of the picture.
function svg.bar(picture)
  local out <const>, at <const>, numbers <const>, boxes <const> = { beyond = {}, text = picture.text }, {}, {}, {}
  for _, t in ipairs(picture.texts) do if math.abs(t.size - picture.em) < 0.01 then numbers[#numbers + 1] = svg.number(t.text) end end
  for _, m in ipairs(picture.marks) do
    if m.stroke == "#3c3c3c" and #m == 2 then at[#at + 1] = m[1][2] end
    if m.stroke == "#3c3c3c" and #m == 3 then out.beyond[#out.beyond + 1] = m[3][2] < m[1][2] and "above" or "below" end
    if m.stroke == "#3c3c3c" and #m == 4 then out.bottom, out.top = m[1][2], m[3][2] end
    if m.fill ~= "none" and #m == 4 and math.abs(m[2][1] - m[1][1] - picture.em) < 0.02 then boxes[#boxes + 1] = m end
  end
  local function value(y) return numbers[1] + (numbers[#at] - numbers[1]) / (at[#at] - at[1]) * (y - at[1]) end
  out.low, out.high, out.count = value(out.bottom), value(out.top), #at
  function out.colour(v) -- each box goes up to the top, over those before it
    local colour
    for _, m in ipairs(boxes) do if math.abs(m[3][2] - out.top) < 0.02 and value(m[1][2]) <= v + 1e-9 * (out.high - out.low) then colour = m.fill end end
    return colour
  end
  return out
end

-- The marks of the sample of a legend's entry.
function svg.sample(picture, entry)
  local out <const> = {}
  for _, t in ipairs(picture.texts) do
    for _, m in ipairs(t.text == entry and picture.marks or {}) do
      if m[1][1] > t.x - 2.5 * picture.em and m[1][1] < t.x and math.abs(m[1][2] - t.y) < 0.8 * picture.em then out[#out + 1] = m end
    end
  end
  return out
end

if not arg[0]:find "letter_sizes%.lua$" then return svg end

-- 1. What draws is replaced, for the scripts: dotyk's functions, and methods in the tables of their types.
local widths <const>, formats <const>, least_size <const> = { 85, 178 }, { "svg", "pdf" }, 7
local scratch <const>, say <const> = os.tmpname(), print
assert(os.remove(scratch) and os.execute("mkdir " .. scratch))
local has_pdftotext <const> = os.execute "command -v pdftotext > /dev/null"
if not has_pdftotext then say "no pdftotext: letters of PDF are not read, sizes of its pages are" end
local pictures <const> = {} -- name, least letters at each width, faults
local line_height <const> = 1.163 -- of DejaVu Sans's letters in pdftotext's boxes

-- Faults of the PDF beside the SVG of the same picture.
local function compared(file, drawn)
  local pdf <const>, faults <const> = content(file), {}
  local pages <const> = select(2, pdf:gsub("/Type /Page[^s]", ""))
  if pages ~= 1 then faults[#faults + 1] = pages .. " pages" end
  local wide <const>, high <const> = pdf:match "/MediaBox %[ 0 0 ([%d.]+) ([%d.]+)"
  if math.abs(wide - drawn.points[1]) > 0.01 or math.abs(high - drawn.points[2]) > 0.01 then faults[#faults + 1] = ("PDF is %s x %s points, SVG %g x %g"):format(wide, high, table.unpack(drawn.points)) end
  if not has_pdftotext then return faults end
  local function known(height)
    for size in pairs(drawn.sizes) do if math.abs(height / line_height - size) < 0.02 then return true end end
  end
  for x, y, right, bottom, word in io.popen("pdftotext -bbox " .. file .. " -"):read "a":gmatch '<word xMin="(%S+)" yMin="(%S+)" xMax="(%S+)" yMax="(%S+)">(.-)</word>' do
    if not known(bottom - y) and not known(right - x) then faults[#faults + 1] = ("'%s' of PDF has letters that SVG has not"):format(word) end -- upright words are as wide as others high
  end
  return faults
end
local function draw(original, options, ...)
  local entry <const> = { name = options.file:match "([^/]*)%.%a+$", faults = {} }
  pictures[#pictures + 1] = entry
  for k, width in ipairs(widths) do
    local drawn
    for _, format in ipairs(formats) do
      local changed <const> = {}
      for key, value in pairs(options) do changed[key] = value end
      changed.file, changed.width = scratch .. "/picture." .. format, width
      local given <const> = { ... }
      given[#given + 1] = changed
      local ok <const>, why <const> = pcall(original, table.unpack(given))
      if not ok then -- too narrow for what is on it: said with the width that would do
        local needed <const> = tostring(why):match "make it (%d+) mm wide" or tostring(why):match "'width' of (%d+) mm"
        if not needed or tonumber(needed) <= width then error(why, 0) end
        entry[k] = "> " .. needed .. " mm"
        break
      end
      if format == "svg" then
        drawn, entry[k] = svg.read(changed.file), math.huge
        for size in pairs(drawn.sizes) do entry[k] = math.min(entry[k], size) end
      else
        table.move(compared(changed.file, drawn), 1, 99, #entry.faults + 1, entry.faults)
      end
      os.remove(changed.file)
    end
  end
  return options.file
end
for _, name in ipairs{ "chart", "pictures", "support_gallery" } do
  local original <const> = dotyk[name]
  dotyk[name] = function(options) return draw(original, options) end
end
local square <const> = dotyk.body{ material = dotyk.material{ E = 1, nu = 0 }, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 1, 1 } } }
square:part "left":fix()
local fixed <const> = dotyk.law.prescribed()
local kinds <const> = { fixed,
  dotyk.thermoelastic_beam{ length = 1, height = 1, E = 1, expansion = 1, conductivity = 1, heat_capacity = 1, step = 1, left = { deflection = fixed, rotation = fixed, displacement = fixed } },
  dotyk.solve(dotyk.scene{ square }), dotyk.solve(dotyk.beam{ length = 1, EJ = 1, load = 1, left = { deflection = fixed, rotation = fixed } }),
  dotyk.solve(dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 2, 2 } }, nu = 0.3, load = 1, edge = { deflection = fixed } }) }
for _, object in ipairs(kinds) do
  local methods <const> = debug.getmetatable(object).__methods
  for _, name in ipairs{ "render", "render_law" } do
    local original <const> = methods[name]
    if original then methods[name] = function(self, options) return draw(original, options, self) end end
  end
end

-- 2. The scripts, with what they are told; by default at small sizes.
local scripts <const> = debug.getinfo(1, "S").source:gsub("[^/]*$", ""):sub(2) .. "../../scripts/"
local asked = { table.unpack(arg) }
if #asked == 0 then asked = { "first", "examples/friction 16", "examples/ball 6", "examples/beam 16", "examples/load_cone 15", "studies/accuracy/hertz 24", "papers/horak_fibinger/plate_cases 16" } end
local failed, row <const> = 0, "%-28s %-40s %6s %6s"
say(row:format("picture, least letters at", "script", "85 mm", "178 mm"))
for _, words in ipairs(asked) do
  local script <const>, more <const> = words:match "^(%S+)%s*(.*)$"
  arg = { [0] = scripts .. script .. ".lua" }
  for word in more:gmatch "%S+" do arg[#arg + 1] = word end
  local first <const> = #pictures + 1
  print = function() end
  local ok <const>, why <const> = pcall(dofile, arg[0])
  print = say
  if not ok then say(("%s failed: %s"):format(script, why)) failed = failed + 1 end
  for k = first, #pictures do
    local p <const> = pictures[k]
    local function written(size) return math.type(size) and ("%.2f"):format(size) or size or "?" end
    say(row:format(p.name, script, written(p[1]), written(p[2])))
    for _, fault in ipairs(p.faults) do say("  " .. fault) end
    if #p.faults > 0 or math.min(math.type(p[1]) and p[1] or math.huge, math.type(p[2]) and p[2] or -math.huge) < least_size - 1e-4 then failed = failed + 1 end
  end
  if ok and #pictures < first then say(script .. ": no picture") end
end
os.remove(scratch)
if failed > 0 then error(failed .. " faults", 0) end
