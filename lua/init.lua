-- The part of dotyk written in Lua. Every file here is called with one table of
-- functions from C++ (described in src/script/bridge/lua_side.hpp) and returns its own.
-- What scripts may call of them is described in src/script/bind/bind_lua.cpp.
-- This file is loaded at the start, the rest on first use.
local core <const> = ...

local init = {}

-- include(file): runs a file that lies beside the one that calls.
function init.include(file)
  local level, from = 2, core.getinfo(2, "S")
  while from and from.what == "C" do
    level = level + 1
    from = core.getinfo(level, "S")
  end
  local folder <const> = not file:find "^/" and from and from.source:match "^@(.*/)"
  local chunk <const>, why = _G.loadfile((folder or "") .. file, "t")  -- which --safe replaces
  if not chunk then core.fail(why) end
  return chunk()
end

return init
