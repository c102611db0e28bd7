-- Functions given for loads that go wrong: the error is at the call, names the point, and nothing is added.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
refused.intact = it.solve
local top <const> = it.top

refused(function() top:load(function(x, y) return 0, x > 0.5 and 0/0 or 1 end) end, "load: function 'traction' returned nan (not a number) at (0.", ", 1)")
refused(function() top:load(function(x, y) return 1/0, 0 end) end, "function 'traction' returned inf at (0.")
refused(function() top:load(function(x, y) return 0 end) end, "function 'traction' returned 1 number, expected 2 numbers at (")
refused(function() top:load(function(x, y) return 0, 1, 2 end) end, "returned 3 numbers, expected 2 numbers")
refused(function() top:load(function(x, y) end) end, "function 'traction' returned nothing at (")
refused(function() top:load(function(x, y) return 0, "much" end) end, "returned the string \"much\", expected 2 numbers")
refused(function() top:load(function(x, y) return { 0, 1 } end) end, "returned a table (write: return fx, fy) at (")
refused(function() top:pressure(function(x, y) return 0, 1 end) end, "function 'value' returned 2 numbers, expected a number")
refused(function() top:displace{ y = function(x, y) return nil end } end, "function 'y' returned nil, expected a number")
refused(function() dotyk.body{ mesh = it.mesh, material = it.material, force = function(x, y) return 0, 0/0 end } end, "body: function 'force' returned nan (not a number) at (")

-- An error inside the function keeps its own line; the call that asked for it is named after it.
local function broken(x, y)
  return 0, x.depth
end
local ok, message = pcall(function() top:load(broken) end)
check.that(not ok and message:find "refused_load.lua:22: attempt to index a number value %(local 'x'%)", message)
check.that(message:find "%(in 'traction' of load at [^ ]*refused_load.lua:24%)$", message)
it.solve()
-- An error object goes through as it is.
local object <const> = { code = 7 }
ok, message = pcall(function() top:load(function() error(object) end) end)
check.that(not ok and message == object)
it.solve()

-- Recursion without end, by Lua alone and through dotyk.
local function deep(n) return 1 + deep(n + 1) end
ok, message = pcall(function() top:load(function() return 0, deep(1) end) end)
check.that(not ok and message:find("stack overflow", 1, true), message)
local function around(n) it.body:part("p", function() around(n + 1) return true end) end
ok, message = pcall(around, 1)
check.that(not ok and message:find("C stack overflow", 1, true), message)
it.solve()

-- Coroutines: around dotyk and inside a function, but not out of one.
check.equal(coroutine.wrap(function() return it.solve().converged end)(), true)
ok, message = pcall(coroutine.wrap(function() top:load(function() coroutine.yield() return 0, 0 end) end))
check.that(not ok and message:find("attempt to yield across a C-call boundary", 1, true), message)
local before <const> = it.solve().energy
local generator <const> = coroutine.wrap(function() while true do coroutine.yield(0) end end)
top:load(function() return 0, generator() end)
check.near(it.solve().energy, before)
refused(function() coroutine.wrap(function() dotyk.material{ E = -1 } end)() end, "material: E is -1")

-- A load inside a load is not lost.
local b <const> = dotyk.body{ mesh = it.mesh, material = it.material }
b:part "bottom":fix()
local asked = false
b:part "top":load(function()
  if not asked then
    asked = true
    b:part "top":load{ 0, -2 }
  end
  return 0, -1
end)
check.near({ dotyk.solve(dotyk.scene{ b }):reaction(b:part "bottom") }, { 0, 3 })
