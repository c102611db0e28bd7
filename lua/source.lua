-- source(x): the text of a function, where there is one.
local core <const> = ...

local source = {}

-- Lines first to last of a text.
local function lines(whole, first, last)
  local text <const>, number = {}, 0
  for line in whole:gmatch "([^\n]*)\n?" do
    number = number + 1
    if number >= first then text[#text + 1] = line end
    if number == last then break end
  end
  return table.concat(text, "\n")
end

local function whole_text(path)
  local file <close> = io.open(path, "r") or core.fail(("source: %s, where the function is written, cannot be read"):format(path))
  return file:read "a"
end

-- Of a function that whole, a file's text, holds.
local function text_of(f, path, whole)
  local info <const> = core.getinfo(f, "S")
  path = path or info.source:match "^@(.*)"
  if not path then return nil end
  return ("-- %s:%d\n%s"):format(path, info.linedefined, lines(whole or whole_text(path), info.linedefined, info.lastlinedefined))
end

-- Of a function typed at the prompt. All inputs have one name, so it is found by what it compiles to: the code of a function
-- stands within that of its chunk, behind a header of its own and a source, which stripped code has not.
local header <const> = 32
local function typed(f)
  local code <const> = string.dump(f, true):sub(header + 1)
  for k = #core.inputs, 1, -1 do
    local input <const> = core.inputs[k]
    local chunk <const> = load(input.compiled, "=prompt", "t")
    if chunk and string.dump(chunk, true):find(code, 1, true) then return text_of(f, "prompt", input.typed) end
  end
end

-- Of a callable of dotyk's.
local function own(f)
  local name <const>, file <const>, at <const> = core.written(f)
  if not name then return nil end
  if not file then return ("%s is written in C++; help(%s) describes it"):format(name, name:find ":" and ('"%s"'):format(name) or name) end
  return text_of(core.load(file)[at], ("%s/%s.lua"):format(core.folder, file), core.read_own(file))
end

function source.run(x)
  if type(x) ~= "function" then core.fail("source: expected a function, got " .. core.type_name(x)) end
  local text = own(x)
  if not text and core.getinfo(x, "S").what == "C" then text = "this function is Lua's own, written in C" end
  print(text or text_of(x) or typed(x) or "this function was given as a text, which is not kept")
end

return source
