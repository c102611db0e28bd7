-- Letters of all kinds of pictures at the widths of one and of two columns of a journal: none below 7 points. PDF has the same letters as SVG, and the same size.
local check <const> = require "check"
local refused <const> = require "refused"
local content <const> = require "bytes_of"
local law <const> = dotyk.law
local mm <const> = 72 / 25.4  -- in points

-- The least size of letters in an SVG file, its width in points, its texts.
local function letters(file)
  local svg <const> = content(file)
  local width <const>, pixels <const> = svg:match('width="([%d.]+)pt"'), svg:match('viewBox="0 0 (%d+)')
  local least, texts = math.huge, {}
  for size in svg:gmatch('font%-size="([%d.]+)"') do least = math.min(least, size * width / pixels) end
  for text in svg:gmatch("<tspan[^>]*>([^<]*)</tspan>") do texts[#texts + 1] = text end
  return least, tonumber(width), table.concat(texts, "\n")
end

local long <const> = ("a long name, "):rep(12)
local curve <const> = { name = "interior_point with a long name", x = { 1, 10, 1e6 }, y = { 1e-8, 1e-3, 2 } }
local panel <const> = { title = "A title of a panel that is long", y = "error of λ_max", series = { curve, { name = "b", x = { 1, 2 }, y = { 1, 2 } } }, slopes = { 1 } }
local block <const> = refused.pressed_block().solve()
local cube <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { 3, 3, 3 } } }
cube:part "bottom":fix()
cube:part "top":load{ 0.1, 0, -1 }
local wall <const> = dotyk.scene{ cube }
wall:contact{ cube:part "right", rigid = dotyk.rigid.plane{ point = { 1, 0, 0 }, normal = { -1, 0, 0 } }, friction = dotyk.friction.coulomb(0.2) }
local solid <const> = dotyk.solve(wall)
local beam <const> = dotyk.solve(dotyk.beam{ length = 2, EJ = 1, load = -1, left = { deflection = law.prescribed(), rotation = law.prescribed() }, right = { deflection = law.signorini() },
  supports = { { x = 1, deflection = law.elastic(3), rotation = law.friction(0.1) } } })
local plate <const> = dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 8, 8 } }, nu = 0.3, load = -1, edge = { deflection = law.signorini() } }
local bent <const> = dotyk.solve(plate)

local kinds <const> = {
  chart = function(o) o.title, o.x, o.y, o.series, o.slopes = long, long, long, { curve, { name = "a name of many letters", x = { 1, 2 }, y = { 1, 2 } } }, { 1 } return dotyk.chart(o) end,
  logarithmic = function(o) o.x, o.y, o.log, o.series = "h", "‖e‖", "xy", { curve } return dotyk.chart(o) end,
  panels = function(o) o.columns, o.panels = o.width > 100 and 3 or 2, { panel, panel, panel, panel } return dotyk.chart(o) end,
  scene = function(o) o.title, o.contact, o.loads, o.supports, o.field, o.unit = long, true, true, true, "von_mises", "MPa" return block:render(o) end,
  solid = function(o) o.contact, o.loads, o.supports, o.field = true, true, true, "xz" return solid:render(o) end,
  beam = function(o) o.title, o.units = long, { length = "m", force = "kN" } return beam:render(o) end,
  law = function(o) o.support = "right" return beam:render_law(o) end,
  surface = function(o) o.title = long return bent:render(o) end,
  plan = function(o) o.view, o.field = "plan", "deflection" return bent:render(o) end,
}
for name, draw in pairs(kinds) do
  for _, width in ipairs{ 85, 178 } do
    local file <const> = ("letters_%s_%d"):format(name, width)
    draw{ file = file .. ".svg", width = width }
    local least <const>, wide <const> = letters(file .. ".svg")
    check.that(least >= 7 and least < 100, ("%s at %d mm: letters of %.2f points"):format(name, width, least))
    check.that(math.abs(wide - width * mm) < 0.3, file)
    draw{ file = file .. ".pdf", width = width }
    local pdf <const> = content(file .. ".pdf")
    check.that(pdf:sub(1, 5) == "%PDF-" and pdf:find "%%EOF")
    check.that(math.abs(pdf:match "/MediaBox %[ 0 0 ([%d.]+)" - wide) < 0.01, file)
    -- Equal pictures give equal bytes.
    draw{ file = "again.pdf", width = width }
    check.equal(content "again.pdf" == pdf, true)
    for _, ending in ipairs{ ".svg", ".pdf" } do os.remove(file .. ending) end
  end
end

-- Texts are texts, symbols have their indices, names of methods do not.
dotyk.chart{ file = "letters.svg", x = "λ_max < μ & W_nt", y = "uzawa_pdas", series = { { name = "x", x = { 1, 2 }, y = { 1, 2 } } } }
local _, _, texts <const> = letters "letters.svg"
check.that(texts:find("λ\nmax\n &lt; μ &amp; W\nnt", 1, true), texts)
check.that(texts:find("uzawa_pdas", 1, true))

dotyk.chart{ file = "letters.svg", x = "‖u − u_h‖_{L²}, σ_{n,max}", series = { { name = "x", x = { 1, 2 }, y = { 1, 2 } } } }
check.that(select(3, letters "letters.svg"):find("‖u − u\nh\n‖\nL²\n, σ\nn,max", 1, true))

-- Names in legends are never cut off.
refused(function() dotyk.chart{ file = "letters.svg", width = 85, series = { { name = long, x = { 1, 2, 3 }, y = { 1, 2, 1 } } } } end, "is wider than its chart: give fewer words")

-- Beside 'size' the width says how large letters are.
dotyk.chart{ file = "letters.svg", size = { 1000, 500 }, width = 120, series = { { x = { 1, 2 }, y = { 1, 2 } } } }
check.that(content "letters.svg":find('viewBox="0 0 1000 500"', 1, true))
check.that(math.abs(select(2, letters "letters.svg") - 120 * mm) < 0.01)
for _, width in ipairs{ 29, 501, 0/0 } do refused(function() dotyk.chart{ file = "letters.svg", width = width, series = { curve } } end, "'width'") end
os.remove "letters.svg"
os.remove "again.pdf"
