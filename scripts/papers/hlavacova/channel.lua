-- Oscillating flow of a conducting liquid in a magnetic field: what an oscillating electric field does to it.
--
--   ./dotyk scripts/papers/hlavacova/channel.lua
--
-- Walls 2 mm apart. Data chosen here (the paper that sets the problem prints none): mercury at E0 = 0.1 V/m,
-- B0 = 0.2 T, dp/dx = -20 kPa/m, 1 Hz, u0 = 1 m/s; salt water, the liquid of a water jet, at 1 kV/m, 1 T.
-- Shows the series against time stepping, the velocity profiles over a period (images/channel.png), the velocity on
-- the axis for either field oscillating (images/channel_axis.png), and how the amplitude falls with the frequency
-- (images/channel_amplitude.png): as 1/(a omega), slope -1. The paper has it omega times smaller than under a steady
-- field, amplitude(0)/omega: the slope is right, the factor is a relaxation rate short (4.9/2.3 for salt water).

local y0 <const> = 1e-3
local function mercury(keys)
  local data = { half_width = y0, density = 13546, viscosity = 1.55e-3, conductivity = 1.04e6, E0 = 0.1, B0 = 0.2,
                 pressure_gradient = -2e4, omega = 2 * math.pi, u0 = 1 }
  for key, value in pairs(keys or {}) do data[key] = value end
  return dotyk.channel(data)
end
local function salt_water(omega)
  return dotyk.channel{ half_width = y0, density = 1025, viscosity = 1.07e-3, conductivity = 5, E0 = 1000, B0 = 1, omega = omega }
end

-- 1. Series against stepping, and the stationary limit.
local electric <const>, magnetic <const> = mercury(), mercury{ oscillating = "magnetic" }
local stepped = { x = {}, y = {} }
for i, channel in ipairs{ electric, magnetic } do
  local name = ({ "electric", "magnetic" })[i]
  local stepping, greatest = channel:stepping{ step = 1 / 256 }, 0
  for step = 1, 24 do
    local t = step / 8
    stepping:run(t)
    for j = -10, 10 do
      local y = j / 10 * y0
      greatest = math.max(greatest, math.abs(stepping:velocity(y) - channel:velocity(y, t)))
    end
    table.insert(stepped.x, t)
    table.insert(stepped.y, stepping:velocity(0))
  end
  print(("%s field oscillating: series and stepping differ by %.1e m/s at most, 24 times of 3 s"):format(name, greatest))
  assert(greatest < 1e-8)
end
local off, steady = 0, mercury{ E0 = 0 }  -- without the electric field nothing oscillates
for j = -10, 10 do
  local y = j / 10 * y0
  off = math.max(off, math.abs(steady:velocity(y, 40) - steady:stationary(y)))
end
print(("without oscillation, after 40 s: %.1e m/s from Hartmann's profile"):format(off))
assert(off < 1e-12)

-- 2. Profiles over a period, long after the start.
local function profile(u)
  local x, y = {}, {}
  for j = -100, 100 do
    local s = math.sin(j / 100 * math.pi / 2)
    x[#x + 1], y[#y + 1] = s, u(s * y0)
  end
  return x, y
end
local profiles = {}
for i = 0, 5 do
  local x, y = profile(function(s) return electric:periodic(s, i / 6) end)
  profiles[#profiles + 1] = { name = ("%s"):format(({ "t = 0", "T/6", "T/3", "T/2", "2T/3", "5T/6" })[i + 1]), x = x, y = y, style = i % 3 == 1 and "line" or "both", twin = i % 3 == 2 or nil }
end
local x, y = profile(function(s) return electric:stationary(s) end)
profiles[#profiles + 1] = { name = "stationary", x = x, y = y, reference = true }
dotyk.chart{ file = "images/channel.png", x = "distance from the axis / half width", y = "velocity [m/s]", series = profiles,
  title = ("Mercury, Hartmann number %.1f, period T"):format(electric.hartmann) }

-- 3. On the axis, from the start.
local function on_axis(channel)
  local xs, ys = {}, {}
  for i = 0, 600 do xs[i + 1], ys[i + 1] = i / 200, channel:velocity(0, i / 200) end
  return xs, ys
end
local xe, ye = on_axis(electric)
local xm, ym = on_axis(magnetic)
dotyk.chart{ file = "images/channel_axis.png", x = "time [s]", y = "velocity on the axis [m/s]",
  title = "Mercury in an oscillating field", series = {
    { name = "electric field", x = xe, y = ye, style = "line" },
    { name = "magnetic field", x = xm, y = ym, twin = true, style = "line" },
    { name = "time stepping", x = stepped.x, y = stepped.y, style = "points" } } }

-- 4. Amplitude against frequency.
local function sweep(make)
  local curve = { x = {}, y = {} }
  for i = 0, 80 do
    curve.x[i + 1] = 10^(-2 + i / 10)
    curve.y[i + 1] = make(curve.x[i + 1]):amplitude()
  end
  return curve
end
local function inverse(factor, from, ratio)  -- factor/omega from there to 1e6
  local curve, omega = { x = {}, y = {} }, from
  while omega < 1.01e6 do
    table.insert(curve.x, omega)
    table.insert(curve.y, factor / omega)
    omega = omega * ratio
  end
  return curve
end
local series, limits = {}, { x = {}, y = {} }
print "             A(0)        A at 1 kHz  slope at 1e5/s   A a omega   A omega/A(0)"
for _, liquid in ipairs{ { name = "salt water", make = salt_water },
                         { name = "mercury", make = function(omega) return mercury{ omega = omega } end } } do
  local make, curve = liquid.make, sweep(liquid.make)
  local omega, a, slow = 1e5, make(1e5).a, make(0):amplitude()
  local slope = math.log(make(2 * omega):amplitude() / make(omega):amplitude()) / math.log(2)
  print(("%-11s  %.3e   %.3e   %+.6f        %.6f    %.3f"):format(liquid.name, slow, make(2000 * math.pi):amplitude(), slope,
    make(omega):amplitude() * a * omega, make(omega):amplitude() * omega / slow))
  assert(math.abs(slope + 1) < 1e-6 and math.abs(make(omega):amplitude() * a * omega - 1) < 1e-6)
  local claim, limit = inverse(slow, 1, 10), inverse(1 / a, 100, 10)
  series[#series + 1] = { name = liquid.name, x = curve.x, y = curve.y, style = "line" }
  series[#series + 1] = { name = liquid.name .. ": A₀/ω", x = claim.x, y = claim.y, style = "line", twin = true }
  for i = 1, #limit.x do table.insert(limits.x, limit.x[i]) table.insert(limits.y, limit.y[i]) end
end
series[#series + 1] = { name = "theory, 1/(aω)", x = limits.x, y = limits.y, style = "points" }
dotyk.chart{ file = "images/channel_amplitude.png", title = "Amplitude of the oscillating velocity", x = "angular frequency ω [1/s]", y = "amplitude [m/s]", log = "xy",
  slopes = { -1 }, series = series }
print "images/channel.png  images/channel_axis.png  images/channel_amplitude.png"
