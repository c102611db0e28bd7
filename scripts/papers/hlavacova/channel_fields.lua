-- The channel of Hlaváčová and Hlaváč (ODAM 2001, 27–37) in all three combinations of fields, along x and across.
--
--   ./dotyk scripts/papers/hlavacova/channel_fields.lua [STEPS]
--
-- B = (0, B₀β, 0), E of amplitude E₀ along z or x, force density j × B, j = σ(E + v × B), v = (u, 0, w). Divided by
-- σE₀B₀ (E = −E₀ε along z, as dotyk.channel has it; E = E₀ε along x),
--   a u_t − b u_yy + cβ² u = d + βε,   a w_t − b w_yy + cβ² w = βε for E along x, 0 for E along z,   u = w = 0 at y = ±y₀.
-- Combinations: 1. β = 1, ε = cos ωt; 2. β = cos ωt, ε = 1; 3. β = cos ωt, ε = cos(ωt + φ).
-- 1. (14) as printed has σE_zB_y, which j × B does not have along z; E_x belongs there. (16) is then right for E along x.
-- 2. Series in cos α_k y, α_k = (2k+1)π/(2y₀): with q = e^{−g sin 2ωt} v, g = c/(4aω) (0 for β = 1), v_k has the constant
--    rate bα_k² + c/2 (c for β = 1), and its force is a Fourier series in ωt. Time stepping, independent of it: central
--    differences and an L-stable Runge–Kutta method of order two with 2 stages. Both steps are halved three times: the
--    difference from the series must fall by four. Combinations 1 and 2 must agree with dotyk.channel to 1e-9.
-- 3. Combination 3 has the steady force ½ cos φ and the frequency 2ω. For ω → ∞, on the axis, with S = 1 − 1/cosh(M/√2):
--    mean ū = (2d + cos φ) S/c, fluctuation |½ e^{iφ} − ½ cū| / (2aω). Combination 2: ū = 2d S/c, fluctuation
--    (sin ωt − ¼ cū sin 2ωt)/(aω). Combination 1: 1/(aω). The distance from these limits must fall like 1/ω or faster.
-- The field that a changing B induces is left out, as in the paper. Data as in scripts/papers/hlavacova/channel.lua (none are printed).
-- Draws images/papers_channel_fields.png and images/papers_channel_fields_phase.png. STEPS a second on the finest grid.

local finest <const>, pi <const>, y0 <const> = tonumber(arg[1]) or 512, math.pi, 1e-3
local common <const> = include "../../lib/common.lua"
local modes <const>, samples <const>, fine <const>, cos <const> = 2000, 128, 512, math.cos
local mercury <const> = dotyk.channel{ half_width = y0, density = 13546, viscosity = 1.55e-3, conductivity = 1.04e6, E0 = 0.1,
  B0 = 0.2, pressure_gradient = -2e4, u0 = 1 }
local water <const> = dotyk.channel{ half_width = y0, density = 1025, viscosity = 1.07e-3, conductivity = 5, E0 = 1000, B0 = 1 }
local combinations <const> = { { name = "E oscillates" }, { name = "B oscillates" },
  { name = "both, φ = 0", phase = 0 }, { name = "both, φ = 90°", phase = pi / 2 }, { name = "both, φ = 180°", phase = pi } }
local function padded(f) return f.name .. (" "):rep(16 - utf8.len(f.name)) end
for i, f in ipairs(combinations) do
  function f.beta(angle) return i == 1 and 1 or cos(angle) end
  function f.drive(angle) return f.beta(angle) * (i == 2 and 1 or cos(angle + (f.phase or 0))) end
  f.magnetic = i > 1
end

-- 1. The force of random fields and velocities, by the cross product, against (13) and (14).
local function cross(p, q) return { p[2] * q[3] - p[3] * q[2], p[3] * q[1] - p[1] * q[3], p[1] * q[2] - p[2] * q[1] } end
local right, printed = 0, 0 -- greatest distance of the first from j × B; of the second from σB|E_z − E_x|
math.randomseed(1)
for _ = 1, 1000 do
  local function number() return 0.5 + math.random() end
  local E, v, B = { number(), 0, number() }, { number(), 0, number() }, number()
  local j = cross(v, { 0, B, 0 })
  for i = 1, 3 do j[i] = j[i] + E[i] end
  local f = cross(j, { 0, B, 0 })
  right = math.max(right, math.abs(f[1] + E[3] * B + B^2 * v[1]), math.abs(f[3] - E[1] * B + B^2 * v[3]))
  printed = math.max(printed, math.abs(E[3] * B - B^2 * v[3] - f[3] - B * (E[3] - E[1])))
end
print(("force along x as (13) and along z with E_x: %.0e from j × B; with E_z, as (14) is printed, it is off by σB(E_z − E_x)"):format(right))
assert(right < 1e-14 and printed < 1e-14)

-- 2. Series of the flow from rest: its harmonics at y, and the velocity.
local function series(liquid, d, f, omega)
  local a, b, c = liquid.a, liquid.b, f.magnetic and liquid.c / 2 or liquid.c
  local g = f.magnetic and liquid.c / (4 * a * omega) or 0
  local harmonics, greatest, known = {}, 0, {}
  for n = 0, samples // 3 do
    local p, q = 0, 0
    for j = 1, samples do
      local angle = 2 * pi * j / samples
      local value = math.exp(g * math.sin(2 * angle)) * (d + f.drive(angle)) * (n == 0 and 1 or 2) / samples
      p, q = p + value * cos(n * angle), q + value * math.sin(n * angle)
    end
    greatest = math.max(greatest, math.abs(p), math.abs(q))
    if math.abs(p) + math.abs(q) > 1e-15 * greatest then harmonics[#harmonics + 1] = { n = n, p = p, q = q } end
  end
  local function at(y) -- x cos nωt + z sin nωt of each harmonic, and the transient's coefficient and rate of each mode
    if known[y] then return known[y] end
    local here = { modes = {} }
    for i = 1, #harmonics do here[i] = { n = harmonics[i].n, x = 0, z = 0 } end
    for k = 0, modes - 1 do
      local alpha = (k + 0.5) * pi
      local shape, rate, start = (k % 2 == 0 and 2 or -2) / alpha * cos(alpha * y / y0), b * (alpha / y0)^2 + c, 0
      for i, h in ipairs(harmonics) do
        local s = a * h.n * omega
        local x, z = shape * (rate * h.p - s * h.q) / (rate^2 + s^2), shape * (rate * h.q + s * h.p) / (rate^2 + s^2)
        here[i].x, here[i].z, start = here[i].x + x, here[i].z + z, start + x
      end
      here.modes[k] = { start, rate / a }
    end
    known[y] = here
    return here
  end
  local function periodic(y, t)
    local sum = 0
    for _, h in ipairs(at(y)) do sum = sum + h.x * cos(h.n * omega * t) + h.z * math.sin(h.n * omega * t) end
    return sum * math.exp(-g * math.sin(2 * omega * t))
  end
  local function velocity(y, t)
    local sum = 0
    for k = 0, modes - 1 do
      local mode = at(y).modes[k]
      if mode[2] * t > 40 then break end
      sum = sum + mode[1] * math.exp(-mode[2] * t)
    end
    return periodic(y, t) - sum * math.exp(-g * math.sin(2 * omega * t))
  end
  local function fluctuation(y) -- mean and half the range of the periodic state
    local mean, low, high = 0, math.huge, -math.huge
    for j = 1, fine do
      local value = periodic(y, 2 * pi / omega * j / fine)
      mean, low, high = mean + value / fine, math.min(low, value), math.max(high, value)
    end
    return mean, (high - low) / 2
  end
  return { velocity = velocity, periodic = periodic, fluctuation = fluctuation }
end
local function decay(f, omega, u0) -- from the initial profile (36), without force
  return dotyk.channel{ half_width = y0, a = mercury.a, b = mercury.b, c = mercury.c, drive = 0, omega = omega, u0 = u0,
    oscillating = f.magnetic and "magnetic" or "electric" }
end
local function step_through(liquid, d, f, omega, start, cells, step, times, seen) -- half the channel
  local gamma <const>, a <const>, u, upper = 1 - math.sqrt(0.5), liquid.a, {}, {}
  local k <const> = liquid.b / (y0 / cells)^2
  for i = 0, cells - 1 do u[i] = start(i * y0 / cells) end
  local function stage(r, t) -- (a/(γ step) + cβ² + bA) v = a/(γ step) r + force
    local factor, force, v = a / (gamma * step), d + f.drive(omega * t), {}
    local diagonal = factor + liquid.c * f.beta(omega * t)^2 + 2 * k
    upper[0], v[0] = -2 * k / diagonal, (factor * r[0] + force) / diagonal
    for i = 1, cells - 1 do
      local pivot = diagonal + k * upper[i - 1]
      upper[i], v[i] = -k / pivot, (factor * r[i] + force + k * v[i - 1]) / pivot
    end
    for i = cells - 2, 0, -1 do v[i] = v[i] - upper[i] * v[i + 1] end
    return v
  end
  for n = 1, math.floor(times[#times] / step + 0.5) do
    local t = (n - 1) * step
    local first = stage(u, t + gamma * step)
    for i = 0, cells - 1 do u[i] = u[i] + (1 - gamma) / gamma * (first[i] - u[i]) end
    u = stage(u, t + step)
    for _, time in ipairs(times) do if math.abs(time - n * step) < step / 2 then seen(time, u) end end
  end
end

local omega <const>, times, curves, points, worst <const> = 2 * pi, {}, { u = {}, w = {} }, { x = {}, u = {}, w = {} }, { order = 0, program = 0 }
for i = 1, 24 do times[i] = i / 8 end
print "\n                    greatest difference of stepping and series [m/s]   orders             from dotyk.channel"
for i, f in ipairs(combinations) do
  for _, component in ipairs{ "u", "w" } do
    local d, u0 = component == "u" and mercury.d or 0, component == "u" and 1 or 0
    local forced, free = series(mercury, d, f, omega), decay(f, omega, 1)
    for _, t in ipairs(f.phase and times or {}) do -- half the period
      assert(math.abs(forced.periodic(0, t + pi / omega) - forced.periodic(0, t)) < 1e-12, "odd harmonics")
    end
    local function exact(y, t) return forced.velocity(y, t) + (u0 == 1 and free:velocity(y, t) or 0) end
    local line, last, orders = component .. "  " .. padded(f), nil, ""
    for level = 3, 0, -1 do
      local cells, most = (finest * 5 // 8) >> level, 0
      step_through(mercury, d, f, omega, function(y) return u0 == 1 and free:velocity(y, 0) or 0 end, cells, 2^level / finest, times, function(t, u)
        for j = 0, 9, 3 do
          local here = u[j * cells // 10]
          most = math.max(most, math.abs(here - exact(j * y0 / 10, t)))
          if level == 0 and j == 0 then table.insert(points[component], here) table.insert(points.x, t) end
        end
      end)
      line, orders = line .. ("  %.2e"):format(most), orders .. (last and ("  %.3f"):format(math.log(last / most) / math.log(2)) or "")
      if level == 0 then worst.order = math.max(worst.order, math.abs(math.log(last / most) / math.log(2) - 2)) end
      last = most
    end
    if i <= 2 then -- the program's series has these combinations
      local most, channel = 0, dotyk.channel{ half_width = y0, a = mercury.a, b = mercury.b, c = mercury.c, d = d, omega = omega, u0 = u0,
        oscillating = f.magnetic and "magnetic" or "electric" }
      for _, t in ipairs(times) do for j = 0, 9, 3 do most = math.max(most, math.abs(channel:velocity(j * y0 / 10, t) - exact(j * y0 / 10, t))) end end
      worst.program, orders = math.max(worst.program, most), orders .. ("   %.0e"):format(most)
    end
    print(line .. "   " .. orders)
    local curve = common.curve(f.name, { style = i == 1 and "line" or "both", twin = i == 3 or i == 5 or nil })
    for n = 0, 240 do curve:add(n / 80, n == 0 and u0 or exact(0, n / 80)) end
    table.insert(curves[component], curve)
  end
end
local nothing = common.curve("E along z, from w = 0.2 m/s", { reference = true })
for n = 0, 240 do nothing:add(n / 80, decay(combinations[1], omega, 0.2):velocity(0, n / 80)) end
table.insert(curves.w, nothing)
for component, list in pairs(curves) do
  local x, y = {}, {}
  for n = 2, #points[component], 3 do x[#x + 1], y[#y + 1] = times[(n - 1) % #times + 1], points[component][n] end
  table.insert(list, { name = "time stepping", x = x, y = y, style = "points" })
end
dotyk.chart{ file = "images/papers_channel_fields.png", title = ("Mercury, Hartmann number %.1f"):format(mercury.hartmann),
  x = "time [s]", size = { 2100, 1000 }, columns = 2, panels = {
  { title = "Along the channel, E along z", y = "velocity u on the axis [m/s]", series = curves.u, x_range = { -0.04, 3.04 } },
  { title = "Across the channel, E along x", y = "velocity w on the axis [m/s]", series = curves.w, x_range = { -0.04, 3.04 } } } }

-- 3. Mean and fluctuation on the axis, and their limits for ω → ∞: fluctuation times ω.
local function limits(liquid, i, phase)
  local a, c, S = liquid.a, liquid.c, 1 - 2 / (math.exp(liquid.hartmann / math.sqrt(2)) + math.exp(-liquid.hartmann / math.sqrt(2)))
  if i == 1 then return liquid.d / c * (1 - 2 / (math.exp(liquid.hartmann) + math.exp(-liquid.hartmann))), 1 / a end
  local mean = (2 * liquid.d + (i > 2 and cos(phase) or 0)) * S / c
  if i > 2 then return mean, math.sqrt((cos(phase) - c * mean)^2 + math.sin(phase)^2) / (4 * a) end
  local most = 0
  for j = 1, fine do most = math.max(most, math.abs(math.sin(2 * pi * j / fine) - c * mean / 4 * math.sin(4 * pi * j / fine)) / a) end
  return mean, most
end
local rate = 0
print "\nmercury          mean at 1000/s   ω → ∞     mean and ω × fluctuation, off at ω = 500/s and 1000/s"
for i, f in ipairs(combinations) do
  local off, mean, limit, fluctuation = {}, nil, limits(mercury, i, f.phase)
  for k, w in ipairs{ 500, 1000 } do
    local m, half = series(mercury, mercury.d, f, w).fluctuation(0)
    off[k], mean = math.abs(m - limit) + math.abs(half * w / fluctuation - 1), m
  end
  print(("%s     %.5f     %.5f   %.1e  %.1e"):format(padded(f), mean, limit, off[1], off[2]))
  if off[2] > 1e-9 then rate = math.max(rate, off[2] / off[1]) end
end
local by_phase = { mean = {}, range = {} }
for _, w in ipairs{ 2, 2 * pi, 20, false } do
  local name = w and ("ω = %.2g/s"):format(w) or "ω → ∞"
  local mean, range = common.curve(name, { style = "line", reference = not w }), common.curve(name, { style = "line", reference = not w })
  for degrees = 0, 180, 3 do
    local phase = degrees / 180 * pi
    local f = { beta = cos, magnetic = true, drive = function(angle) return cos(angle) * cos(angle + phase) end }
    local m, half = limits(mercury, 3, phase)
    if w then
      m, half = series(mercury, mercury.d, f, w).fluctuation(0)
      half = half * w
    end
    mean:add(degrees, m)
    range:add(degrees, half * mercury.a)
  end
  table.insert(by_phase.mean, mean)
  table.insert(by_phase.range, range)
end
local by_frequency = {}
for _, liquid in ipairs{ water, mercury } do
  local list, points = {}, { name = "limit, ω → ∞", x = {}, y = {}, style = "points" }
  for i, f in ipairs(combinations) do
    local curve, _, limit = common.curve(f.name, { style = i == 1 and "line" or "both", twin = (i == 3 or i == 5) and liquid == mercury }), limits(liquid, i, f.phase)
    for power = -0.25, 3.01, 0.125 do
      local w = 10^power
      local _, half = series(liquid, liquid.d, f, w).fluctuation(0)
      local scale = liquid == water and 1 or liquid.a * w
      curve:add(w, half * scale)
      if power >= 2 and power % 0.5 == 0 then table.insert(points.x, w) table.insert(points.y, limit / w * scale) end
    end
    list[i] = curve
  end
  if liquid == water then -- the magnetic brake is weak (M = 0.07): two curves
    for k = 1, #list[1].x do assert(math.abs(list[2].y[k] / list[1].y[k] - 1) < 0.01 and math.abs(list[5].y[k] / list[3].y[k] - 1) < 0.01) end
    list = { list[1], list[4] }
    list[1].name, list[2].name = "E or B oscillates", "both, any φ"
  end
  list[#list + 1] = points
  by_frequency[#by_frequency + 1] = list
end
dotyk.chart{ file = "images/papers_channel_fields_phase.png", columns = 2, size = { 2100, 1300 }, panels = {
  { title = "Mercury, both oscillate: mean", x = "phase φ [degrees]", y = "mean u [m/s]", series = by_phase.mean, x_range = { 0, 180 } },
  { title = "Mercury, both oscillate: fluctuation", x = "phase φ [degrees]", y = "amplitude · aω", series = by_phase.range, x_range = { 0, 180 } },
  { title = "Salt water, no pressure gradient", x = "angular frequency ω [1/s]", y = "amplitude [m/s]", log = "xy", slopes = { -1 }, series = by_frequency[1] },
  { title = "Mercury, −20 kPa/m", x = "angular frequency ω [1/s]", y = "amplitude · aω", log = "x", series = by_frequency[2] } } }
print "images/papers_channel_fields.png  images/papers_channel_fields_phase.png"
common.verdict(worst.order < 0.05 and worst.program < 1e-9 and rate < 0.55, (
  "u and w in all combinations: series and stepping differ by an error of order two (to %.3f), the program's series by at most %.0e; "
  .. "all fluctuations fall like 1/ω, and those of the third combination have twice the frequency"):format(worst.order, worst.program))
