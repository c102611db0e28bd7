-- include: from the folder of the file that calls it, however it is called.
local check <const> = require "check"
os.execute "mkdir -p include/lib"
local function write(name, text)
  local file <close> = assert(io.open(name, "w"))
  file:write(text)
end
write("include/lib/one.lua", 'local two <const> = include "two.lua" return two + 1, "and more"')
write("include/lib/two.lua", "return 2")
write("include/lib/tail.lua", 'return include "two.lua"')
write("include/first.lua", 'return include "lib/one.lua"')
check.equal({ dofile "include/first.lua" }, { 3, "and more" })
check.equal(dofile "include/lib/tail.lua", 2)
write("include/calls.lua", 'return pcall(include, "lib/two.lua")')
check.equal({ dofile "include/calls.lua" }, { true, 2 })
write("include/asks.lua", '\ninclude "nothing.lua"')
local found <const>, why <const> = pcall(dofile, "include/asks.lua")
check.that(not found and why:find("include/asks.lua:2: cannot open include/nothing.lua", 1, true), why)
