-- Lua's own functions that dotyk replaces do what they did, and refuse what would break C++.
local refused <const> = require "refused"
local check <const> = require "check"

-- Nothing, again and again; places beyond counting are another test's (command_line.sh).
check.equal((""):rep(math.maxinteger), "")
check.equal((""):rep(3, "x"), "xx")
check.equal(("ab"):rep(3, ","), "ab,ab,ab")
check.equal(("ab"):rep(-1), "")
refused(function() ("x"):rep() end, "number expected, got no value")
refused(function() ("x"):rep(math.maxinteger) end, "resulting string too large")

-- Patterns that may take long, matched in a state of their own, give what Lua's do: those of a text with much before it are
-- the same but for the places.
do
  local long <const> = ("."):rep(4000)
  local function captured(f, ...) return table.pack(pcall(f, ...)) end
  local function alike(name, text, pattern, ...)
    for _, more in ipairs{ "", long } do
      local plain <const>, guarded <const> = captured(string[name], text .. more, pattern, ...), captured(string[name], text .. more, pattern .. ("%z?"):rep(30), ...)
      check.equal(guarded, plain, name .. " " .. pattern)
    end
  end
  for _, text in ipairs{ "", "one two  three", "key = value; other=thing", "(a(b)c) [x]", "^a^b", "aaa" } do
    for _, pattern in ipairs{ "", "a*", "a-", "%w+", "(%w+)%s*=%s*(%w+)", "()%w+()", "%b()", "%f[%w]%w+", "^%w+", "(.)%1", "^", "%s*", "x" } do
      alike("find", text, pattern)
      alike("find", text, pattern, 3)
      alike("find", text, pattern, -2)
      alike("match", text, pattern)
      alike("gsub", text, pattern, "<%0>")
      alike("gsub", text, pattern, "<%0>", 2)
      alike("gsub", text, pattern, { one = 1, two = "2", a = false })
      alike("gsub", text, pattern, function(first, second) return second and tostring(second) .. tostring(first) end)
      local function all(s, p, ...)
        local found <const> = {}
        for a, b in s:gmatch(p, ...) do found[#found + 1] = { a, b } end
        return found
      end
      for _, first in ipairs{ 1, 4, -3 } do
        check.equal(captured(all, text .. long, pattern .. ("%z?"):rep(30), first), captured(all, text .. long, pattern, first), "gmatch " .. pattern)
      end
    end
  end
  local costly <const> = ("a?"):rep(30)
  refused(function() return long:find(costly .. "[a") end, "malformed pattern (missing ']')")
  refused(function() return long:gsub(costly .. ".", "%9") end, "invalid capture index %9")
  refused(function() return long:gsub(costly .. ".", function() return {} end) end, "invalid replacement value (a table)")
  refused(function() return long:gsub(costly .. ".", true) end, "bad argument #2 to 'gsub'")
  refused(function() return long:find(costly, {}) end, "bad argument #2 to 'find'")
  check.equal({ pcall(long.gsub, long, costly .. ".", error) }, { false, "." })
  -- As it stands, in linear time.
  local many <const> = ("a"):rep(1 << 22)
  check.equal({ many:find(("a"):rep(1 << 21) .. "b") }, {})
  check.equal({ (many .. "b"):find("aab", 1, true) }, { (1 << 22) - 1, (1 << 22) + 1 })
  check.equal({ (many .. "b"):find("aab", -2, true) }, {})
  -- One within another.
  check.equal((("ab"):rep(2000)):gsub("(%w)" .. ("%z?"):rep(30), function(c) return (("x"):rep(50)):match("x*" .. ("%z?"):rep(30)) and c:upper() end), ("AB"):rep(2000))
end

local function text(t) return table.concat(t, " ") end
check.equal(text(table.move({ 1, 2, 3 }, 1, 3, 2)), "1 1 2 3")
check.equal(text(table.move({ 1, 2, 3 }, 2, 3, 1)), "2 3 3")
check.equal(text(table.move({ 1, 2, 3 }, 1, 3, 2, { 9 })), "9 1 2 3")
refused(function() table.move({}, -5, math.maxinteger, 2) end, "too many elements to move")
refused(function() table.move({}, 1, math.maxinteger, 2) end, "destination wrap around")
refused(function() table.move({}, 1, 2) end, "bad argument #4")
-- More than are moved without a look at Ctrl-C, forwards, backwards and into another table.
local n <const>, long <const> = (1 << 20) + 5, {}
for i = 1, n do long[i] = i end
local other <const> = table.move(long, 1, n, 3, {})
assert(other[3] == 1 and other[n + 2] == n and other[2] == nil)
table.move(long, 1, n, 2)
assert(long[1] == 1 and long[2] == 1 and long[n + 1] == n and long[n] == n - 1)
table.move(long, 2, n + 1, 1)
assert(long[1] == 1 and long[n] == n and long[n // 2] == n // 2)

-- Tables that say themselves how long they are.
local own <const> = setmetatable({}, { __len = function(t) return rawlen(t) end })
for i = 1, 5 do table.insert(own, 1, i) end
table.insert(own, 3, 9)
table.insert(own, 0)
check.equal(text(own), "5 4 9 3 2 1 0")
check.equal(table.remove(own, 2), 4)
check.equal(table.remove(own), 0)
check.equal(table.remove(own, 5), 1)
check.equal(table.remove(own, 5), nil)
check.equal(text(own), "5 9 3 2")
refused(function() table.insert(own, 9, 1) end, "position out of bounds")
refused(function() table.remove(own, 9) end, "position out of bounds")
refused(function() table.insert(own, 1, 2, 3) end, "wrong number of arguments")
local plain <const> = { 1, 2 }
table.insert(plain, 1, 0)
check.equal(text(plain) .. table.remove(plain, 1) .. #plain, "0 1 202")

-- What C++ relies on cannot be changed from Lua.
local material <const> = dotyk.material{ E = 1 }
refused(function() debug.setupvalue(dotyk.solve, 1, nil) end, "debug.setupvalue: expected a function written in Lua, not one of Lua's or dotyk's own")
refused(function() debug.setupvalue(string.rep, 1, nil) end, "debug.setupvalue: expected a function written in Lua")
refused(function() debug.upvaluejoin(dotyk.solve, 1, dotyk.body, 1) end, "Lua function expected")
refused(function() debug.setmetatable(io.stdout, debug.getmetatable(material)) end, "debug.setmetatable: an object of dotyk's, or a file, keeps its metatable")
refused(function() debug.setmetatable(material, debug.getmetatable(io.stdout)) end, "debug.setmetatable: an object of dotyk's, or a file, keeps its metatable")
refused(function() debug.setuservalue(material, {}) end, "debug.setuservalue: an object of dotyk's keeps its value")
refused(function() debug.getregistry() end, "debug.getregistry: the registry is Lua's and dotyk's own")
refused(function() table.sort({ 2, 1 }, function(a, b) debug.setlocal(2, 1, nil) return a < b end) end, "debug.setlocal: expected a function written in Lua")
-- Nor looked into: what a hook or a callback finds there would be no value of Lua's.
check.equal({ debug.getupvalue(dotyk.solve, 1) }, {})
check.equal({ debug.getupvalue(debug.setupvalue, 1) }, {})
refused(function() debug.setmetatable(debug.upvalueid(dotyk.solve, 1), debug.getmetatable(material)) end, "keeps its metatable")
do
  local seen = {}
  ("x"):rep(5000):gsub("x", function() seen[#seen + 1] = debug.getlocal(2, 1) end)
  table.sort({ 2, 1 }, function(a, b) seen[#seen + 1] = debug.getlocal(2 + (1 << 32), 1) return a < b end)
  check.equal(seen, {})
  refused(function() table.sort({ 2, 1 }, function(a, b) debug.setlocal(2 + (1 << 32), 1, nil) return a < b end) end, "debug.setlocal: expected a function")
end
-- The state of a loop and a table that is being filled are Lua's own.
local function set_unnamed(level, value)
  for n = 1, 50 do
    if (debug.getlocal(level + 1, n) or ""):find "^%(" then debug.setlocal(level + 1, n, value) end
  end
end
local function three() set_unnamed(2, "text") return 1, 2, 3 end
for _, f in ipairs{ function() for _ = 1, 3 do set_unnamed(1, {}) end end, function() return { three(), three() } end } do
  check.that(select(2, pcall(f)):find("debug.setlocal: expected a variable that has a name", 1, true))
end
collectgarbage()
local function varied(...) debug.setlocal(1, -1, 5) return ... end
check.equal(varied(1), 5)
-- Compiled chunks may be wrong in any way; no way takes one.
do
  local compiled <const> = string.dump(function() end)
  local path <const> = "compiled.lua"
  assert(io.open(path, "wb")):write(compiled):close()
  check.equal(select(2, load(compiled, "x", "b")), "attempt to load a binary chunk (mode is 't')")
  check.equal(select(2, load(coroutine.wrap(function() coroutine.yield(compiled) end), "x")), "attempt to load a binary chunk (mode is 't')")
  check.that(select(2, loadfile(path, "b")):find "binary chunk")
  for _, run in ipairs{ dofile, function() require "compiled" end } do
    check.that(select(2, pcall(run, path)):find("attempt to load a binary chunk", 1, true))
  end
  os.remove(path)
end
-- Metamethods moved elsewhere, or called with anything.
do
  local file <const>, one <const>, two <const> = debug.getmetatable(io.stdout), debug.getmetatable(material), debug.getmetatable(dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } })
  for _, event in ipairs{ "__gc", "__close", "__eq" } do
    for _, value in ipairs{ io.stdout, 5, {}, print, dotyk.mesh, debug.upvalueid(dotyk.solve, 1) } do
      one[event](value, value)
      two[event](value, value)
    end
    one[event](nil)
    one[event]()
  end
  check.equal(tostring(material), tostring(dotyk.material{ E = 1 }))
  local gc <const> = file.__gc
  file.__gc = one.__gc
  for _ = 1, 9 do io.open(debug.getinfo(1, "S").source:sub(2)) end
  collectgarbage()
  file.__gc = gc
  local strict <const>, globals <const> = getmetatable(dotyk.mesh), getmetatable(_G)
  for _, value in ipairs{ 5, "text", print, io.stdout, {} } do
    refused(function() strict.__index(value, "x") end, "unknown field 'x'")
    refused(function() globals.__index(value, "x") end, "unknown variable 'x'")
    strict.__absent = value
    refused(function() return dotyk.mesh.x end, "unknown field 'x'")
    strict.__absent = nil
  end
end
-- Lua's own coroutine functions, which a hook could call past the guard of the stack, are called nowhere.
do
  local called <const> = {}
  local wrapped = coroutine.wrap(function() coroutine.yield(1) error "x" end)
  debug.sethook(function()
    local f <const> = debug.getinfo(2, "f").func
    if debug.getinfo(2, "S").what == "C" then called[f] = true end
  end, "c")
  local again <const> = coroutine.wrap(print)
  local first <const> = wrapped()
  local ok <const>, message <const> = pcall(wrapped)
  debug.sethook()
  check.equal({ first, ok }, { 1, false })
  check.that(message:find ": x$", message)
  for f in pairs{ [coroutine.wrap] = 0, [wrapped] = 0, [pcall] = 0, [error] = 0, [coroutine.yield] = 0, [debug.sethook] = 0 } do called[f] = nil end
  check.equal(next(called), nil)
end
local function changed() local x = 1 debug.setlocal(1, 1, 5) return x end
check.equal(changed(), 5)
refused(function() debug.setlocal(1000, 1, 5) end, "level out of range")
local function counter() local k = 0 return function() k = k + 1 return k end end
local f <const> = counter()
check.equal(debug.setupvalue(f, 1, 41), "k")
check.equal(f(), 42)
check.equal(getmetatable(debug.setmetatable({}, { x = 1 })).x, 1)

-- xpcall as ever.
local ok <const>, message <const> = xpcall(error, function(m) return "handled " .. m end, "x", 0)
assert(not ok and message == "handled x")
check.equal(select("#", xpcall(function(...) return ... end, print, 1, 2, 3)), 4)
refused(function() xpcall(print) end, "bad argument #2")
xpcall(error, function() check.equal(debug.getinfo(2, "f").func, error) end)
local co <const> = coroutine.wrap(function() return xpcall(function() return coroutine.yield(1) end, print) end)
assert(co() == 1 and select(2, co(5)) == 5)

-- A picture has nowhere to go: said before it is drawn, and what to do.
refused(function() dotyk.chart{ file = "nowhere/x.png", series = { { x = { 0, 1 }, y = { 0, 1 } } } } end,
  "chart: cannot write 'nowhere/x.png': folder nowhere: No such file or directory; it must be there first: mkdir -p nowhere")
