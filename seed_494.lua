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

-- What functions of the script raise on purpose. Whoever catches it gets it as it is, or a text with the place behind.
local raised, raised_nil = {}, false
function raise(value)
  if value == nil then raised_nil = true else raised[value] = true end
  error(value, 0)
end

local function on_purpose(value)
  if value == nil then return raised_nil end
  if raised[value] then return true end
  if type(value) ~= "string" then
    for _, object in next, V do
      if rawequal(object, value) then return true end
    end
    return false
  end
  for one in next, raised do
    if type(one) == "string" and value:find(one, 1, true) then return true end
  end
end

-- Odd things that functions given to dotyk may do. Each but the first costs time, so a call has few of them.
odd = {}
local left = 0
local function spend()
  left = left - 1
  return left >= 0
end

-- f(…) in a coroutine, resumed until it ends.
function odd.inside(f, ...)
  local co <const> = coroutine.create(f)
  local function go(ok, ...)
    if not ok then error((...), 0) end
    if coroutine.status(co) == "dead" then return ... end
    return go(coroutine.resume(co, ...))
  end
  return go(coroutine.resume(co, ...))
end

-- A small problem solved, in the midst of another.
function odd.sweep()
  if not spend() then return end
  local body = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2} }, material = dotyk.material{ E = 10, nu = 0.3 } }
  body:part "left":fix()
  body:part("top", function(_, _, _, ny) return ny > 0.5 end):load(function(x) return x, -1 end)
  local scene = dotyk.scene{ body }
  scene:contact{ body:part "bottom", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 end } }
  return dotyk.solve(scene)
end

-- What works on V's objects while one of them is worked on.
local function every(act)
  if not spend() then return end
  local objects = {}
  for _, object in next, V do objects[#objects + 1] = object end
  for _, object in ipairs(objects) do pcall(act, object) end
end
function odd.touch()
  every(function(mesh) mesh:transform(function(x, y, z) return x * 1.01, y, z end) end)
  every(function(scene) scene:contact{ scene.bodies[1]:part "top", rigid = dotyk.rigid.plane{ point = {0, 5}, normal = {0, -1} } } end)
  every(function(body) body:part "right":load{ 0.1, 0.1 } end)
  every(function(body) body:part "right":fix "y" end)
  every(function(refinement) refinement:refine() end)
end
function odd.again(depth)
  every(function(scene) dotyk.solve(scene, { seconds = 1 }) end)
  every(function(design) design:along{ 1, 0, 0, 0 } end)
  every(function(beam) beam:run(1) end)
  every(function(mesh)
    mesh:transform(function(x, y, z)
      if depth > 0 then odd.again(depth - 1) end
      return x, y, z
    end)
  end)
end

-- Garbage whose end calls dotyk.
local with_end <const> = rawget(_G, "granted") or setmetatable
function odd.litter()
  for _ = 1, 5 do with_end({}, { __gc = function() odd.sweep() end }) end
  collectgarbage()
end

-- Ends by a solve, by an error, by a yield.
local endings <const> = { function() odd.sweep() end, function() raise{} end, function() raise "end" end, function() pcall(coroutine.yield) end, function() odd.close_chain(5) end }
local turn = 0
function odd.closing()
  turn = turn % #endings + 1
  return setmetatable({}, { __close = endings[turn] })
end

-- Coroutines, each closed by the end of the next; or each end raises.
function odd.close_chain(length, raising)
  if not spend() then return end
  local last
  for _ = 1, length do
    local before = last
    last = coroutine.create(function()
      local _ <close> = setmetatable({}, { __close = function()
        if before then coroutine.close(before) end
        if raising then raise(before) end
      end })
      coroutine.yield()
    end)
    coroutine.resume(last)
  end
  return coroutine.close(last)
end

-- A text into a file.
function file(name, text)
  local out <close> = assert(io.open(name, "w"))
  out:write(text)
end

local function answer(ok, first, ...)
  failed = not ok
  if ok then
    sound(first, 0, "result")
    for _, value in ipairs{ ... } do sound(value, 0, "later result") end
    return first
  end
  if on_purpose(first) then return end
  -- One line, at a line of this script: Lua's own, as of a yield that cannot be, have it behind.
  if type(first) ~= "string" then error("FUZZ: an error that is a " .. type(first), 0) end
  if not first:find "^[^\n:]+:%d+: [^\n]+$" and not first:find "^[^\n]+ at [^\n:]+:%d+%)$" then error("FUZZ: not one line at the user's line: " .. first, 0) end
end

-- A call: its first result, nil after an error.
function try(fn)
  raised, raised_nil, left, turn = {}, false, 8, 0
  return answer(pcall(fn))
end

-- Reads the fields of an object.
function look(object, ...)
  for _, name in ipairs{ ... } do try(function() return object[name] end) end
  try(function() return tostring(object) end)
end
-- seed_494
V[1] = try(function() return dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {1,3,2}, element = 'P1' } end)
V[2] = try(function() return dotyk.material{ E = 100, nu = 0.3 } end)
V[3] = try(function() return dotyk.body{ mesh = V[1], material = V[2] } end)
look(V[3], 'name', 'dimension', 'node_count', 'cell_count', 'parts')
V[4] = try(function() return V[3]:part 'bottom' end)
V[5] = try(function() return V[3]:part 'top' end)
look(V[5], 'name', 'body', 'facet_count')
V[6] = try(function() return V[5]:load{ 0, 0, -1 } end)
look(V[6], 'name', 'body', 'facet_count')
V[7] = try(function() return V[3]:part 'left':fix() end)
V[8] = try(function() return dotyk.scene{ V[3] } end)
V[9] = try(function() return dotyk.rigid.plane{ point = {0,0,0}, normal = {0,0,1} } end)
V[10] = try(function() return V[8]:contact{ V[4], rigid = V[9] } end)
V[11] = try(function() return odd.inside(function() return dotyk.solve(V[8]) end) end)
look(V[11], 'converged', 'method', 'iterations', 'reason', 'warnings', 'screw_moves', 'screws', 'kernel', 'energy', 'friction_energy', 'steps', 'unknowns', 'rows', 'time', 'residual', 'working_set', 'penalty', 'feti', 'history', 'ordering', 'factor_bytes')
V[12] = try(function() return dotyk.law.capped_elastic(644.19622717801269, 380.33963251108543) end)
V[13] = try(function() return dotyk.lcp({ file = '.', q = { 0, -1, }, }) end)
V[14] = try(function() return V[11]:moved({ body = V[3], }) end)
V[15] = try(function() return V[4]:support({ }) end)
V[16] = try(function() return V[14]:contact(V[10]) end)
V[17] = try(function() return V[10]:inf_sup({ fixed_nodes = 'kept', }) end)
V[18] = try(function() return dotyk.law.signorini() end)
V[19] = try(function() return V[14]:support(V[5]) end)
V[20] = try(function() return dotyk.shape({ scene = V[8], moves = { { degree = 2, lower = { 2, 1000, }, upper = 1000, }, { extension = 'harmonic', lower = 0.25, upper = { 4, 4, }, }, }, objective = 'volume', }) end)
V[21] = try(function() return include('y') end)
