-- Values as a person wants to read them: at the prompt, and in messages.
local core <const> = ...

local show = {}

local widest <const> = 96  -- letters on one line
local deepest <const> = 4  -- tables inside tables
local longest <const> = 40 -- entries of one table
-- Entries of a list that fills more than a line; of those that fill several lines each; the same inside another table.
local most_lines <const>, most_blocks <const>, inner_lines <const>, inner_blocks <const> = longest, 10, 6, 2

local function is_name(key)
  return type(key) == "string" and key:match "^[%a_][%w_]*$" ~= nil
end

local function key_order(a, b)
  local ka, kb = type(a), type(b)
  if ka ~= kb then return ka == "number" or (kb ~= "number" and ka < kb) end
  if ka == "number" or ka == "string" then return a < b end
  return tostring(a) < tostring(b)
end

-- A number alone with all its digits, one of many with six.
local function number(value, depth)
  if math.type(value) == "integer" then return tostring(value) end
  local short = string.format("%.6g", value)
  return (depth > 0 or tonumber(short) == value) and short or string.format("%.14g", value)
end

local describe

local function more(texts, from, count)
  for i = #texts, from + 1, -1 do texts[i] = nil end
  if count > from then texts[from + 1] = ("… %d more"):format(count - from) end
end

-- The items of a list as texts.
local function items(value, depth, seen)
  local lines <const>, blocks <const> = depth > 0 and inner_lines or most_lines, depth > 0 and inner_blocks or most_blocks
  local texts, count, letters, block = {}, rawlen(value), 0, false
  for i = 1, math.min(count, longest) do
    texts[i] = describe(rawget(value, i), depth + 1, seen)
    letters = letters + #texts[i] + 2
    block = block or texts[i]:find "\n" ~= nil
    if block and i > blocks then break end
  end
  local fits <const> = not block and count <= longest and letters + 2 * depth <= widest
  more(texts, math.min(count, fits and longest or block and blocks or lines), count)
  return texts
end

-- The entries of a table as texts: items first, then "key = value".
local function entries(value, depth, seen)
  local texts, keys, count = items(value, depth, seen), {}, rawlen(value)
  for key in next, value do
    local item = math.type(key) == "integer" and key >= 1 and key <= count
    if not item then keys[#keys + 1] = key end
  end
  table.sort(keys, key_order)
  for i = 1, math.min(#keys, longest) do
    local key = keys[i]
    local name = is_name(key) and key or "[" .. describe(key, depth + 1, seen) .. "]"
    texts[#texts + 1] = name .. " = " .. describe(rawget(value, key), depth + 1, seen)
  end
  if #keys > longest then texts[#texts + 1] = ("… %d more"):format(#keys - longest) end
  return texts
end

-- Short texts side by side.
local function filled(texts, room)
  local rows, row = {}, nil
  for _, text in ipairs(texts) do
    if row and #row + #text + 2 <= room then
      row = row .. ", " .. text
    else
      rows[#rows + 1], row = row, text
    end
  end
  rows[#rows + 1] = row
  return rows
end

-- Rows of a matrix stay below each other.
local function all_short(value, texts)
  for _, text in ipairs(texts) do
    if #text > 30 or text:find "\n" then return false end
  end
  return type(rawget(value, 1)) ~= "table"
end

local function describe_table(value, depth, seen)
  if seen[value] then return "{…}" end
  if next(value) == nil then return "{}" end
  if depth >= deepest then return "{…}" end
  seen[value] = true
  local texts = entries(value, depth, seen)
  seen[value] = nil
  local line = "{ " .. table.concat(texts, ", ") .. " }"
  if #line + 2 * depth <= widest and not line:find "\n" then return line end
  local indent = ("  "):rep(depth + 1)
  if all_short(value, texts) then texts = filled(texts, widest - #indent) end
  return "{\n" .. indent .. table.concat(texts, ",\n" .. indent) .. " }"
end

function describe(value, depth, seen)
  local kind = type(value)
  if kind == "number" then return number(value, depth) end
  if kind == "string" then return depth == 0 and value:find "\n" and value or string.format("%q", value):gsub("\\\n", "\\n") .. "" end
  if kind == "table" then
    local meta = getmetatable(value)
    if type(meta) == "table" and rawget(meta, "__tostring") and not rawget(meta, "__strict") then return tostring(value) end
    return describe_table(value, depth, seen)
  end
  if kind == "userdata" then
    local text = tostring(value)
    return depth > 0 and text:find "\n" and text:match "^[^\n]*" .. " …" or text
  end
  if kind == "function" then
    local signature <const> = core.signature(value) or tostring(value)
    return depth > 0 and #signature > 60 and signature:gsub("{ .*", "{ … }"):gsub("%(.*", "(…)") .. "" or signature
  end
  return tostring(value)
end

-- One value as a text, on several lines when it is long.
function show.text(value)
  return describe(value, 0, {})
end

-- What the prompt does with results. The name of a picture's file is also shown as the picture, where the terminal can.
function show.print(...)
  local values = table.pack(...)
  for i = 1, values.n do
    if type(values[i]) == "string" and values[i]:find "%.png$" then core.load("picture").show(values[i]) end
    values[i] = show.text(values[i])
  end
  local several = table.concat(values):find "\n" and "\n" or "  "
  io.write(table.concat(values, several), "\n")
end

return show
