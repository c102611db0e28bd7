-- What an SVG file of dotyk shows: texts with their places, lines and filled polygons, in pixels from the upper left.
local content <const> = require "bytes_of"

local function numbers(text)
  local points <const> = {}
  for x, y in text:gmatch "([%d.-]+),([%d.-]+)" do points[#points + 1] = { x = tonumber(x), y = tonumber(y) } end
  return points
end

local function box_of(points)
  local box <const> = { left = math.huge, right = -math.huge, top = math.huge, bottom = -math.huge, points = points }
  for _, p in ipairs(points) do
    box.left, box.right = math.min(box.left, p.x), math.max(box.right, p.x)
    box.top, box.bottom = math.min(box.top, p.y), math.max(box.bottom, p.y)
  end
  return box
end

local Svg <const> = {}
Svg.__index = Svg

-- The first text with these words, or the one that so many come before less one; nil where there is none.
function Svg:text(words, which)
  which = which or 1
  for _, text in ipairs(self.texts) do
    if text.words == words then
      which = which - 1
      if which == 0 then return text end
    end
  end
end

-- Boxes about the filled polygons of a colour.
function Svg:filled(colour)
  local out <const> = {}
  for _, polygon in ipairs(self.polygons) do if polygon.fill == colour then out[#out + 1] = polygon end end
  return out
end

return function(file)
  local all <const> = content(file)
  local it <const> = setmetatable({ texts = {}, lines = {}, polygons = {}, least = math.huge }, Svg)
  local points <const> = all:match 'width="([%d.]+)pt"' / all:match 'viewBox="0 0 (%d+)'
  for size in all:gmatch 'font%-size="([%d.]+)"' do it.least = math.min(it.least, size * points) end
  for place, fill, inner in all:gmatch '<text transform="([^"]*)"[^>]-fill="(#%x+)"[^>]*>(.-)</text>' do
    local x <const>, y <const> = place:match "translate%(([%d.-]+) ([%d.-]+)%)"
    local words <const> = {}
    for piece in inner:gmatch "<tspan[^>]*>([^<]*)</tspan>" do words[#words + 1] = piece end
    it.texts[#it.texts + 1] = { words = table.concat(words), x = tonumber(x), y = tonumber(y), upright = place:find "rotate" ~= nil, fill = fill }
  end
  for shape, coordinates, fill, rest in all:gmatch '<(poly%a+) points="([^"]*)" fill="([^"]*)"([^>]*)' do
    local mark <const> = box_of(numbers(coordinates))
    mark.fill, mark.stroke, mark.width, mark.dashed = fill, rest:match 'stroke="(#%x+)"', tonumber(rest:match 'stroke%-width="([%d.]+)"'), rest:find "dasharray" ~= nil
    mark.gap = tonumber(rest:match 'dasharray="[%d.]+ ([%d.]+)')
    local into <const> = fill == "none" and it.lines or it.polygons
    into[#into + 1] = mark
  end
  return it
end
