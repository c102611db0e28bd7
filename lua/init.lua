-- The part of dotyk written in Lua. Every file here is called with one table of
-- functions from C++ (described in src/script/lua_side.hpp) and returns its own.
-- Only what start-up needs is loaded here: the rest is loaded on first use.
local core <const> = ...

-- The functions of lua/<file>.lua, loaded when the first of them is called.
function core.lazily(file, name)
  return function(...)
    return core.load(file)[name](...)
  end
end

return core
