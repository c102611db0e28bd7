-- What Lua tests assert with. Each failure is an error at the line of the test.
local check = {}

local function show(value)
  return type(value) == "string" and string.format("%q", value) or tostring(value)
end

local function same(a, b)
  if a == b then return true end
  if type(a) ~= "table" or type(b) ~= "table" then return false end
  for key, value in pairs(a) do
    if not same(value, b[key]) then return false end
  end
  for key in pairs(b) do
    if a[key] == nil then return false end
  end
  return true
end

-- Equal, tables by their entries.
function check.equal(given, expected, about)
  if same(given, expected) then return end
  error(("%sexpected %s, got %s"):format(about and about .. ": " or "", show(expected), show(given)), 2)
end

-- |given - expected| <= tolerance (1e-12 when left out), entry by entry.
function check.near(given, expected, tolerance, about)
  tolerance = tolerance or 1e-12
  if type(expected) == "table" then
    check.equal(#given, #expected, "length")
    for i = 1, #expected do check.near(given[i], expected[i], tolerance, about or "entry " .. i) end
    return
  end
  if type(given) == "number" and math.abs(given - expected) <= tolerance then return end
  error(("%sexpected %s within %g, got %s"):format(about and about .. ": " or "", show(expected), tolerance, show(given)), 2)
end

-- fn(...) raises an error whose message contains the text (a plain text, or a
-- Lua pattern when it begins with "^"). Returns the message.
function check.error(fn, text, ...)
  local ok, message = pcall(fn, ...)
  if ok then error("expected an error with " .. show(text) .. ", got none", 2) end
  message = tostring(message)
  local found = text == nil or message:find(text, 1, text:sub(1, 1) ~= "^")
  if not found then error(("expected an error with %s, got %s"):format(show(text), show(message)), 2) end
  return message
end

-- The condition holds.
function check.that(condition, about)
  if not condition then error(about or "does not hold", 2) end
end

return check
