-- A steel strip in the weather: a thermoelastic beam clamped at one end and resting on a stop at the other.
--
--   ./dotyk scripts/examples/thermoelastic.lua [steps]
--
-- Ten minutes of hot air above it, then ten of cold: the strip bends onto its stop, then lifts off it
-- (images/thermoelastic.png, images/thermoelastic_lines.png; images/thermoelastic_state.png while it is lifted). Then what the numbers are worth: the orders in time
-- of both schemes through closing and opening (images/thermoelastic_orders.png), in space, the balance of energy, and the
-- decomposition: in the six exceptional cases, and where solvability forces one, the heat is solved without the
-- displacement; the same to rounding, at a fraction of the work.

local steps <const> = math.tointeger(tonumber(arg and arg[1] or 200))
local l <const> = dotyk.law

local function merged(first, second)
  local all = {}
  for key, value in pairs(first) do all[key] = value end
  for key, value in pairs(second or {}) do all[key] = value end
  return all
end

-- 1. The strip. Its own weight presses it on the stop; hot air above bends it down, cold air up.
local weight <const> = -7850 * 9.81 * 0.02
local function weather(t) return t < 600 and 150 * (1 - math.exp(-t / 60)) or -130 + (130 + 150 * (1 - math.exp(-10))) * math.exp(-(t - 600) / 60) end
local function strip(keys)
  return dotyk.thermoelastic_beam(merged({ length = 1, height = 0.02, E = 2.1e11, expansion = 1.2e-5, conductivity = 50, heat_capacity = 3.8e6,
    exchange = { above = 250, below = 10 }, ambient = { above = weather }, load = weight, step = 1200 / steps,
    left = { deflection = l.prescribed(), rotation = l.prescribed(), displacement = l.prescribed(), temperature = 0 },
    right = { deflection = l.signorini() } }, keys))
end

local b <const> = strip()
local history, lines = { t = {}, force = {}, air = {}, mean = {}, tip = {} }, {}
local function note()
  table.insert(history.t, b.time / 60)
  table.insert(history.force, b:reaction("right").force)
  table.insert(history.tip, 1e6 * b:deflection(1))
  table.insert(history.air, weather(b.time))
  table.insert(history.mean, b:temperature(0.9))
end
local function line(name)
  local x, y = {}, {}
  for i = 0, 100 do x[#x + 1], y[#y + 1] = i / 100, 1e3 * b:deflection(i / 100) end
  lines[#lines + 1] = { name = name, x = x, y = y }
end
note()
line "cold, own weight"
for i = 1, steps do
  b:run(i * 1200 / steps)
  note()
  if i == steps // 2 then line "10 min of hot air" end
  if i == math.floor(0.61 * steps) then
    line "2 min of cold air, lifted"
    b:render{ file = "images/thermoelastic_state.png", title = "The strip after 2 min of cold air", size = { 2100, 1500 },
      units = { length = "m", force = "N", temperature = "K" } }
  end
  if i == steps then line "10 min of cold air" end
end
print(b)
local least, most = math.huge, -math.huge
for _, tip in ipairs(history.tip) do least, most = math.min(least, tip), math.max(most, tip) end
assert(least > -1e-6 and most > 10 and math.min(table.unpack(history.force)) == 0)
print(("the stop bears %.0f N under the weight alone, %.0f N at most, and none while the tip is up to %.0f µm above it")
  :format(history.force[1], math.max(table.unpack(history.force)), most))

dotyk.chart{ file = "images/thermoelastic.png", title = "A strip on its stop: hot, then cold air", x = "time [min]", panels = {
  { y = "temperature above 20 °C [K]", series = { { name = "air above", x = history.t, y = history.air }, { name = "strip near its tip", x = history.t, y = history.mean } } },
  { y = "force of the stop [N]", series = { { x = history.t, y = history.force, style = "line" } } },
  { y = "tip above the stop [µm]", series = { { x = history.t, y = history.tip, style = "line" } } } } }
dotyk.chart{ file = "images/thermoelastic_lines.png", title = "Deflection of the strip", x = "x [m]", y = "deflection [mm]", series = lines }

-- 2. Orders in time, through closing and opening of the stop; the energy's balance.
local function at_end(n, order)
  local s = strip{ step = 1200 / n, order = order }:run(1200)
  return { s:deflection(0.5), s:temperature(0.9), s:reaction("left").moment, s:reaction("right").force }, s.energy
end
local exact <const> = at_end(64 * steps, 2)
local orders, balance = {}, {}
for order = 1, 2 do
  local x, y, defects = {}, {}, {}
  for level = 0, 3 do
    local n = steps // 4 * 2 ^ level
    local values, energy = at_end(n, order)
    local error = 0
    for i = 1, #values do error = math.max(error, math.abs(values[i] / exact[i] - 1)) end
    x[#x + 1], y[#y + 1], defects[#defects + 1] = 1200 / n, error, math.abs(energy.defect) / energy.dissipated
  end
  orders[order] = { name = ({ "deflection, Euler", "deflection, TR-BDF2" })[order], x = x, y = y }
  balance[order] = { name = ({ "energy, Euler", "energy, TR-BDF2" })[order], x = x, y = defects }
  local last = #y
  print(("order %d: errors %.1e … %.1e, falling by %.2f when steps halve; balance of energy off by %.1e … %.1e of what is dissipated")
    :format(order, y[1], y[last], (y[1] / y[last]) ^ (1 / (last - 1)), defects[1], defects[last]))
  assert((y[1] / y[last]) ^ (1 / (last - 1)) > (order == 1 and 1.8 or 3.2))
end
dotyk.chart{ file = "images/thermoelastic_orders.png", title = "Errors through closing and opening", x = "step [s]", y = "relative error",
  log = "xy", slopes = { 1, 2 }, series = { orders[1], orders[2], balance[1], balance[2] } }

-- Orders in space, everything coupled: a plastic clamped at both ends between two walls, against 256 cells.
local function plastic(keys)
  return dotyk.thermoelastic_beam(merged({ length = 1, height = 0.5, E = 100, expansion = 0.1, conductivity = 1, heat_capacity = 1, reference_temperature = 3,
    exchange = { above = 0.2, below = 0.2 }, ambient = { above = function(t) return math.sin(3 * t) end }, load = -1, step = 0.01 }, keys))
end
local function clamped(cells)
  local ends <const> = { deflection = l.prescribed(), rotation = l.prescribed(), displacement = l.prescribed(), temperature = 0, gradient = 0 }
  local s = plastic{ cells = cells, left = ends, right = ends, exchange = { above = 0.2, below = 0.8 }, step = 0.05,
    load = function(x) return math.exp(2 * x) end, axial_load = function(x) return math.cos(3 * x) end,
    heat = function(x, t) return t * math.exp(x) end, heat_gradient = function(x, t) return 50 * math.sin(3 * x + t) end }:run(0.2)
  local values = { deflection = {}, gradient = {}, temperature = {}, displacement = {} }
  for name, list in pairs(values) do
    for i = 0, 320 do list[#list + 1] = s[name](s, i / 320) end
  end
  return values
end
local finest <const>, off = clamped(256), {}
for _, cells in ipairs{ 16, 32 } do
  local values = clamped(cells)
  for name, list in pairs(values) do
    local worst = 0
    for i, value in ipairs(list) do worst = math.max(worst, math.abs(value - finest[name][i])) end
    off[name] = off[name] or {}
    table.insert(off[name], worst)
  end
end
for _, name in ipairs{ "deflection", "gradient", "temperature", "displacement" } do
  local order = math.log(off[name][1] / off[name][2], 2)
  print(("order in space of the %-12s %.2f (error %.1e with 32 cells)"):format(name, order, off[name][2]))
  assert(order > (name == "displacement" and 2.85 or 3.7))
end

-- 3. Decomposed against coupled: a plastic with strong coupling, 200 steps.
local spring, weak = l.elastic(20), l.elastic(5)
local cases <const> = {
  { "1 simply supported", { deflection = l.prescribed() }, { deflection = l.prescribed() } },
  { "2 cantilever", { deflection = l.prescribed(), rotation = l.prescribed() }, {} },
  { "3 simply supported, guided", { deflection = l.prescribed() }, { rotation = l.prescribed() } },
  { "4 on two springs", { deflection = spring }, { deflection = weak } },
  { "5 cantilever on springs", { deflection = spring, rotation = weak }, {} },
  { "6 sprung, guided by a spring", { deflection = spring }, { rotation = weak } },
  { "theorem 2, one-sided springs", { deflection = l.one_sided_elastic(20) }, { deflection = l.one_sided_elastic(5) } },
  { "theorem 3, Signorini", { deflection = l.signorini() }, { deflection = l.signorini() } },
  { "theorem 4, friction at the pin", { deflection = l.prescribed(), rotation = l.friction(1) }, {} },
  { "theorem 5, friction at both ends", { deflection = l.friction(1) }, { deflection = l.friction(1) } },
}
local function median(values)
  table.sort(values)
  return values[#values // 2 + 1]
end
print(("%-34s %12s %14s %12s %12s"):format("200 steps, 32 cells", "difference", "decomposed", "coupled", "coupled is"))
for _, case in ipairs(cases) do
  local name, left, right = table.unpack(case)
  local seconds, run = { {}, {} }, {}
  for _ = 1, 5 do
    for k, decompose in ipairs{ true, false } do
      run[k] = plastic{ left = left, right = right, decompose = decompose }
      local from = os.clock()
      run[k]:run(2)
      table.insert(seconds[k], os.clock() - from)
    end
  end
  local off, scale = 0, 0
  for i = 0, 20 do
    local x = i / 20
    for _, value in ipairs{ "deflection", "gradient" } do
      off = math.max(off, math.abs(run[1][value](run[1], x) - run[2][value](run[2], x)))
      scale = math.max(scale, math.abs(run[2][value](run[2], x)))
    end
  end
  assert(#run[1].decomposed == 2 and #run[2].decomposed == 0 and off < 1e-8 * scale)
  local apart, coupled = median(seconds[1]) / 200, median(seconds[2]) / 200
  print(("%-34s %12.1e %9.1f µs/step %6.1f µs/step %7.1f times"):format(name, off / scale, 1e6 * apart, 1e6 * coupled, coupled / apart))
end
