-- Optimisations that are stopped and go on: to the same end. What they write.
local check <const> = require "check"
local png_size <const> = require "png_size"

local function pressed_block()
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {-1, 0}, to = {1, 1}, cells = {16, 8} } }
  block:part "top":load{ 0, -1 }
  block:part "left":fix "x"
  local scene <const> = dotyk.scene{ block }
  scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
  return scene, block
end

-- Its lower edge is to bear evenly.
local function uneven(objective)
  local scene <const>, block <const> = pressed_block()
  return dotyk.shape{ scene = scene, objective = objective, constraints = { { quantity = "volume", most = 1.9965 } },
    moves = { { part = block:part "bottom", control_points = 5, direction = {0, 1}, lower = 0, upper = 0.005, start = { 0.003, 0.001, 0.001, 0.002, 0.003 } } } }
end

-- The compliance is least in a corner of its bounds and constraint, the smoothed peak where the edge is straight.
for method, objective in pairs{ slp = "compliance", mma = "compliance", ccsaq = "compliance", slsqp = "peak_pressure" } do
  local shape <const> = uneven(objective)
  local seen <const> = {}
  local whole <const> = shape:optimise{ method = method, on_design = function(k, record, design)
    check.equal(k, #seen + 1)
    check.equal(record.design, k)
    check.equal(record.admissible, design ~= nil)
    if design then check.near(design[objective].value, record.objective) end
    seen[k] = record
  end }
  check.that(whole.converged, whole.reason)
  check.that(whole.objective < 0.9 * seen[1].objective)
  check.that(whole.constraints[1] <= 1e-8, method)
  check.equal(whole.history, seen)
  check.equal(whole.cost.designs, #seen)
  check.near(whole.design[objective].value, whole.objective)
  check.equal(whole.alpha, (function(a) for i, x in ipairs(a) do a[i] = x.value end return a end)(whole.design.alpha))

  -- Stopped after two designs, it goes on from the result, from start and radius, or from a file.
  os.remove "go_on.lua"
  local first <const> = shape:optimise{ method = method, file = "go_on.lua", figures = "design_%02d.png", on_design = function(k) return k < 2 end }
  check.equal(#first.history, 2)
  check.that(not first.converged and first.reason:find "^stopped")
  check.that(first.objective > whole.objective)
  local written <const> = dofile "go_on.lua"
  check.equal(written.start, first.alpha)
  written.method = method
  local ways <const> = { { method = method, start = first }, written,
                         { method = method, start = first.alpha, radius = first.radius > 0 and first.radius or nil } }
  for k, way in ipairs(ways) do
    local rest <const> = shape:optimise(way)
    check.near(rest.history[1].objective, first.objective, 1e-12)
    check.that(rest.converged, rest.reason)
    check.near(rest.objective, whole.objective, (method == "slsqp" and 1e-4 or 1e-6) * whole.objective, method .. " " .. k)
  end
  for k = 1, 2 do check.equal(png_size(("design_%02d.png"):format(k)), png_size "design_01.png") end
  for k = 1, 2 do os.remove(("design_%02d.png"):format(k)) end
end

-- slp remembers nothing but the place and the radius where no constraint is active: the same designs as in one run.
local free <const> = uneven(function(d) return (d.alpha[1] * 200 - 0.2)^2 + (d.alpha[2] * 200 - 0.4)^2 + (d.peak_pressure - 1)^2 end)
local whole <const> = free:optimise{ max_designs = 12 }
local part
for k = 1, 4 do part = free:optimise{ max_designs = k == 1 and 3 or 4, start = part } end
for i, x in ipairs(whole.alpha) do check.near(part.alpha[i], x, 1e-12) end

-- Designs that are not admissible are told of with the reason, and answered by shorter steps.
local reasons <const> = {}
local scene <const>, block <const> = pressed_block()
local lower <const> = dotyk.shape{ scene = scene, objective = function(d) return -d.volume end,
  moves = { { part = block:part "bottom", control_points = 4, direction = {0, 1}, lower = -1, upper = 0.1, start = 0.1 } } }
local o <const> = lower:optimise{ on_design = function(k, record, design)
  check.equal(record.admissible, record.reason == nil)
  check.equal(design ~= nil, record.admissible)
  reasons[#reasons + 1] = record.reason
end }
check.that(#reasons > 0 and reasons[1]:find("the rigid plane penetrates the part", 1, true))
local told <const> = {}
for _, record in ipairs(o.history) do told[#told + 1] = record.reason end
check.equal(told, reasons)
check.that(o.objective < -1.99, "nearly down to the plane") -- which holds it: alpha = 0, volume 2
