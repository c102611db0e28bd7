-- Closing one coroutine closes the next: Lua counts nested calls of C anew in each, so that only the stack's end stopped it.
local function chain(length, close)
  local last
  for _ = 1, length do
    local before = last
    last = coroutine.create(function()
      local _ <close> = setmetatable({}, { __close = function()
        if before then close(before) end
      end })
      coroutine.yield()
    end)
    coroutine.resume(last)
  end
  return last
end

local deepest, depth = nil, 0
local function close(co)
  depth = depth + 1
  local closed, message = coroutine.close(co)
  deepest = deepest or message
  assert(closed or tostring(message):find "C stack overflow", message)
end
coroutine.close(chain(200000, close))
assert(depth > 100 and depth < 200000 and deepest:find "C stack overflow", deepest)
assert(coroutine.close(chain(50, function(co) assert(coroutine.close(co)) end)))

-- The same by the end that an error in a wrapped one brings, from a loop's closing value and under pcall.
local function fail(n)
  for _ in function(_, done) return not done or nil end, nil, nil, setmetatable({}, { __close = function()
    if n > 0 then pcall(coroutine.wrap(fail), n - 1) end
  end }) do error "failed" end
end
local ok, message = pcall(coroutine.wrap(fail), 100000)
assert(not ok and tostring(message):find "failed", message)

-- Errors name the line as without dotyk.
local _, own = pcall(function() coroutine.close(coroutine.running()) end)
assert(own:find "coroutines_closed_in_a_chain.lua:%d+: cannot close a running coroutine", own)
assert(not pcall(coroutine.close) and not pcall(coroutine.resume, 3))
