-- Pictures in terminals that can show them: kitty's protocol, iTerm2's, or sixel by img2sixel.
local core <const> = ...

local picture = {}

local known <const> = { "kitty", "iterm", "sixel", "none" }
local refused

-- "kitty", "iterm", "sixel", or nil. DOTYK_PICTURES decides where it is set; none: no pictures.
local function protocol()
  local wish <const> = os.getenv "DOTYK_PICTURES"
  for _, name in ipairs(known) do
    if wish == name then return name ~= "none" and name or nil end
  end
  if wish and wish ~= "" and not refused then
    refused = true
    io.stderr:write(("dotyk: DOTYK_PICTURES is '%s', which is left out; it can be %s\n"):format(wish, table.concat(known, ", ")))
  end
  if not core.terminal "stdout" or os.getenv "TMUX" or os.getenv "STY" then return nil end
  local term <const>, program <const> = os.getenv "TERM" or "", os.getenv "TERM_PROGRAM" or ""
  if os.getenv "KITTY_WINDOW_ID" or term:find "kitty" or program == "ghostty" then return "kitty" end
  local over_ssh <const> = os.getenv "LC_TERMINAL" -- which ssh passes on
  if program == "iTerm.app" or program == "WezTerm" or over_ssh == "iTerm2" then return "iterm" end
  if term:find "^foot" or term:find "^mlterm" or term:find "sixel" then return "sixel" end
end

local letters <const> = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"

local function base64(bytes)
  local out <const> = {}
  for i = 1, #bytes, 3 do
    local a <const>, b <const>, c <const> = bytes:byte(i, i + 2)
    local bits <const> = a << 16 | (b or 0) << 8 | (c or 0)
    for k = 0, 3 do
      local at <const> = (bits >> (18 - 6 * k) & 63) + 1
      out[#out + 1] = (k == 2 and not b or k == 3 and not c) and "=" or letters:sub(at, at)
    end
  end
  return table.concat(out)
end

local show <const> = {}

function show.kitty(bytes)
  local data <const> = base64(bytes)
  local piece <const> = 4096
  for first = 1, #data, piece do
    io.write("\27_G", first == 1 and "a=T,f=100," or "", "m=", first + piece <= #data and 1 or 0, ";", data:sub(first, first + piece - 1), "\27\\")
  end
  io.write "\n"
end

function show.iterm(bytes) io.write("\27]1337;File=inline=1;size=", #bytes, ":", base64(bytes), "\7\n") end

local missing <const> = 127 -- what a shell says of a program that it does not find
local missed

function show.sixel(_, path)
  io.flush()
  local _, _, code <const> = os.execute(("img2sixel '%s' 2>/dev/null"):format(path:gsub("'", "'\\''")))
  if code == missing and not missed then
    missed = true
    io.stderr:write("dotyk: img2sixel is missing (in the package libsixel-bin), so no pictures are shown here; DOTYK_PICTURES=none asks for none\n")
  end
end

-- Shows the picture where the terminal can; true if it did.
function picture.show(path)
  local how <const> = protocol()
  if not how then return false end
  local file <const> = io.open(path, "rb")
  if not file then return false end
  local bytes <const> = file:read "a"
  file:close()
  if bytes:sub(1, 4) ~= "\137PNG" then return false end
  show[how](bytes, path)
  return true
end

return picture
