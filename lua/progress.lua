-- One line on the terminal that tells how far long work is.
local core <const> = ...

local progress = {}

local shown = false
local last = -math.huge

-- Shows the text in place of the last one, at most ten times a second, on
-- standard error when that is a terminal.
function progress.show(text)
  if not core.terminal "stderr" then return end
  local now = core.clock()
  if now - last < 0.1 then return end
  last, shown = now, true
  io.stderr:write("\r", text:sub(1, core.columns() - 1), "\27[K")
end

-- Takes the line away.
function progress.clear()
  if shown then io.stderr:write "\r\27[K" end
  last, shown = -math.huge, false
end

return progress
