-- Pages of beams, and plans of plates: what their texts say, and how high they are.
local check <const> = require "check"
local content <const> = require "bytes_of"
local law <const> = dotyk.law

-- Size in points, texts with their places in pixels, lines of one text apart.
local function read(file)
  local svg <const> = content(file)
  local out <const> = { width = tonumber(svg:match 'width="([%d.]+)pt"'), height = tonumber(svg:match 'height="([%d.]+)pt"'), texts = {} }
  for x, y, body in svg:gmatch '<text transform="translate%(([%d.-]+) ([%d.-]+)%)[^>]*>(.-)</text>' do
    out.texts[#out.texts + 1] = { x = tonumber(x), y = tonumber(y), text = (body:gsub("<[^>]*>", "")) }
  end
  assert(#out.texts > 0)
  os.remove(file)
  return out
end
local function count(page, pattern)
  local n = 0
  for _, t in ipairs(page.texts) do if t.text:find(pattern) then n = n + 1 end end
  return n
end

-- Five rows are no higher than 200 mm at the width of two columns; every working point is told, in one line or two; axes of small numbers
-- have a power of ten beside them, and three labels.
local clamped <const> = { deflection = law.prescribed(), rotation = law.prescribed() }
local pinned <const> = { deflection = law.prescribed() }
local function solved(left, right, load) return dotyk.solve(dotyk.beam{ cells = 8, left = left, right = right, load = load or -1 }) end
local rows <const> = {}
for k, s in ipairs{ solved(clamped, { deflection = law.capped_elastic(20, 0.2) }), solved(clamped, { deflection = law.friction(0.5) }), solved(clamped, { deflection = law.friction(0.2) }),
  solved(pinned, { deflection = law.prescribed(), rotation = law.capped_elastic(4, 0.03) }), solved(clamped, { deflection = law.signorini() }) } do
  rows[k] = { solution = s, support = "right", of = k == 4 and "rotation" or "deflection", title = "A title that goes on over all three cells of its row, one as the other" }
end
dotyk.support_gallery{ file = "page.svg", rows = rows }
local page <const> = read "page.svg"
check.that(math.abs(page.width - 178 * 72 / 25.4) < 1, page.width)
check.that(page.height < 201 * 72 / 25.4, page.height)
check.equal(count(page, "^%([^×]*,"), 10)
check.equal(count(page, "…"), 0)
check.equal(count(page, "impossible displacement"), 1)
check.that(count(page, "× 10⁻³") > 3)

-- Loads have their units, also those that are not the greatest.
dotyk.solve(dotyk.beam{ length = 4, load = function(x) return x < 2 and -1 or -3 end, left = clamped, right = pinned, loads = { { x = 1, force = -2 } } }):render{ file = "page.svg", units = { length = "m", force = "kN" } }
local loaded <const> = read "page.svg"
check.equal({ count(loaded, "^q = −1 kN/m$"), count(loaded, "^q = −3 kN/m$"), count(loaded, "^F = −2 kN$") }, { 1, 1, 1 })

-- Titles break into lines of about the same width.
dotyk.chart{ file = "page.svg", title = "A title that is a little too long for one line of it", series = { { x = { 1, 2 }, y = { 1, 2 } } } }
local first <const>, second <const> = read "page.svg".texts[1].text, nil
check.that(#first < 32, first)

-- Equal reactions along the edges of a plan are told once.
local plate <const> = dotyk.solve(dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 8, 8 } }, nu = 0.3, load = -1,
  edge = { deflection = law.prescribed(), rotation = law.prescribed() } })
plate:render{ file = "page.svg", view = "plan" }
local plan <const> = read "page.svg"
check.equal(count(plan, "^0%.%d%d%d$"), 1)
