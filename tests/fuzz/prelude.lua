-- What every script of the fuzzer begins with; with it a saved script runs by dotyk alone. V holds the objects made.
V = {}
failed = false

-- Numbers that are none, in what a call gave back.
local function sound(value, depth, place)
  if value ~= value then error("FUZZ: not a number handed out: " .. place, 0) end
  if type(value) ~= "table" or depth > 4 or rawequal(value, dotyk) then return end
  local seen = 0
  for key, inner in next, value do
    seen = seen + 1
    if seen > 300 then break end
    sound(inner, depth + 1, place .. "." .. tostring(key))
  end
end

local function answer(ok, first, ...)
  failed = not ok
  if ok then
    sound(first, 0, "result")
    for _, value in ipairs{ ... } do sound(value, 0, "later result") end
    return first
  end
  -- One line, at a line of this script.
  if type(first) ~= "string" then error("FUZZ: an error that is a " .. type(first), 0) end
  if not first:find "^[^\n:]+:%d+: [^\n]+$" then error("FUZZ: not one line at the user's line: " .. first, 0) end
end

-- A call: its first result, nil after an error.
function try(fn) return answer(pcall(fn)) end

-- Reads the fields of an object.
function look(object, ...)
  for _, name in ipairs{ ... } do try(function() return object[name] end) end
  try(function() return tostring(object) end)
end
