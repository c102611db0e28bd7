-- Supports that break under a coupled thermoelastic beam (Horák, ODAM 2001, section 4, figures 16 and 17: the evolutionary
-- hemivariational inequality).
--
--   ./dotyk scripts/papers/horak/beam_breaking.lua [FINEST]
--
-- 1. A thermal fuse: a steel strip, clamped at the left, is heated from above and presses its right end on a latch that breaks under a
--    given force. Force and deflection over time for latches of several strengths (images/papers_beam_breaking.png). Heat bends the strip by
--    1.5 αϑ₂EJ/L on a rigid latch, which is what the force tends to; what a break sets free is g²(1/k + L³/3E*J)/2, E* = E (1 + θ₀Eα²/c):
--    no heat passes in no time.
-- 2. Orders of both schemes through a break, where the coupling is strong (θ₀Eα²/c = 3): a step is divided where the support breaks.
-- 3. Which problems decompose? (The paper says that a class does.) Where statics alone gives the reactions, the heat is solved without the
--    displacement, until a support breaks; then, where no other support waits open, nothing holds the beam, and there is no solution. Where
--    statics does not, the beam is coupled until so many supports are broken that it does; from then on it decomposes. A beam over an open stop
--    takes both ways: until its support breaks statics gives the reactions, but whether the stop stays open depends on the displacement, so it is
--    solved coupled; then it lies on the stop, and decomposes. Decomposed and coupled agree.
-- Supports are examined at the ends of steps: a pulse of load that comes and goes within one step breaks none.
-- FINEST: steps of part 2, 64, 128, …

local common <const> = include "../../lib/common.lua"
local finest <const>, l <const> = math.tointeger(tonumber(arg[1]) or 256), dotyk.law
local clamped <const> = { deflection = l.prescribed(), rotation = l.prescribed(), displacement = l.prescribed() }

-- 1. The fuse.
local E <const>, J <const>, alpha <const>, c <const>, theta <const>, k <const> = 2.1e11, 0.02^3 / 12, 1.2e-5, 3.8e6, 293.15, 1e6
local function strip(limit)
  return dotyk.thermoelastic_beam{ length = 1, height = 0.02, E = E, expansion = alpha, conductivity = 50, heat_capacity = c, reference_temperature = theta,
    exchange = { above = 250, below = 10 }, ambient = { above = function(t) return 150 * (1 - math.exp(-t / 60)) end },
    left = clamped, right = { deflection = l.breaking(k, limit) }, step = 1 }
end
local force <const>, deflection <const> = {}, {}
local at_once <const> = 1 / k + 1 / (3 * E * J * (1 + theta * E * alpha^2 / c)) -- deflection of latch and end, by force
print "latch bears [N]   breaks after [s]   set free [J]   g²(1/k + L³/3E*J)/2"
for _, limit in ipairs{ 150, 300, 420, 1e6 } do
  local b <const>, name <const> = strip(limit), limit < 1e6 and ("breaks at %g N"):format(limit) or "does not break"
  local of <const> = { common.curve(name, { style = "line" }), common.curve(name, { style = "line" }) }
  local function note()
    of[1]:add(b.time / 60, b:reaction("right").force)
    of[2]:add(b.time / 60, 1e3 * b:deflection(1))
  end
  note()
  for t = 1, 240 do
    local breaks <const> = #b.broken
    b:run(t)
    if #b.broken > breaks then -- drawn upright
      local at <const> = b.broken[1].time / 60
      of[1]:add(at, limit)
      of[1]:add(at, 0)
      of[2]:add(at, -1e3 * limit / k)
    end
    note()
  end
  for i, list in ipairs{ force, deflection } do list[#list + 1] = of[i] end
  local expected <const> = limit^2 * at_once / 2
  if limit < 1e6 then
    assert(#b.broken == 1 and math.abs(b.energy.released / expected - 1) < 1e-6)
    print(("%8g          %10.2f         %10.5f     %10.5f"):format(limit, b.broken[1].time, b.energy.released, expected))
  else
    assert(#b.broken == 0)
    local gradient <const> = b:gradient(0.5)
    local rigid <const>, found <const> = 1.5 * alpha * gradient * E * J / (1 + 3 * E * J / k), b:reaction("right").force
    print(("does not break: %.2f N under %.1f K/m; 1.5 αϑ₂EJ/L on the latch's spring: %.2f N"):format(found, gradient, rigid))
    assert(math.abs(found / rigid - 1) < 0.01) -- ϑ₂ is not the same everywhere: bending heats
  end
end

-- 2. Orders where the coupling is strong.
local function strong(keys)
  local all <const> = { height = 0.5, E = 100, expansion = 0.1, conductivity = 1, heat_capacity = 1, reference_temperature = 3, cells = 8,
    exchange = { above = 0.2, below = 0.2 }, left = clamped, right = { deflection = l.breaking(40, 0.4) },
    load = function(x, t) return -3 * t * (1 + 0.3 * math.sin(5 * t) * x) end, heat_gradient = function(x, t) return 3 * math.cos(2 * t) * x end }
  for key, value in pairs(keys) do all[key] = value end
  return dotyk.thermoelastic_beam(all)
end
local exact <const> = strong{ step = 1 / (8 * finest) }:run(1)
local times_off <const>, ends_off <const> = {}, {}
print "\nscheme          steps   error of the time [1]   order   error of the end's deflection   order   defect of the energy"
for order, name in ipairs{ "Euler", "TR-BDF2" } do
  local when <const>, where <const>, n = common.curve(name), common.curve(name), 16
  while n <= finest do
    local b <const> = strong{ step = 1 / n, order = order }:run(1)
    when:add(1 / n, math.abs(b.broken[1].time - exact.broken[1].time))
    where:add(1 / n, math.abs(b:deflection(1) - exact:deflection(1)))
    local function observed(curve) return #curve.y > 1 and math.log(curve.y[#curve.y - 1] / curve.y[#curve.y], 2) end
    local function shown(curve) return observed(curve) and ("%.2f"):format(observed(curve)) or "" end
    print(("%-14s  %5d   %.1e                 %5s   %.1e                         %5s   %.1e"):format(name, n, when.y[#when.y], shown(when), where.y[#where.y], shown(where), b.energy.defect))
    if n == finest then assert(observed(when) > order - 0.2 and observed(where) > order - 0.2) end
    n = 2 * n
  end
  times_off[order], ends_off[order] = when, where
end

-- 3. Decomposed and coupled. A heavier load at each time until the last support breaks, or to time 3.
local breaking <const>, stop <const>, held <const> = l.breaking(40, 0.5), l.signorini(), l.prescribed()
local beams <const> = {
  { "on two breaking supports", { deflection = breaking, displacement = held }, { deflection = breaking } },
  { "on a stop and a breaking one", { deflection = stop, displacement = held }, { deflection = breaking } },
  { "on a pin whose rotation breaks", {}, { deflection = held, rotation = l.breaking(40, 0.3), displacement = held } },
  { "propped cantilever", clamped, { deflection = breaking } },
  { "clamped, rotation breaks as well", clamped, { deflection = breaking, rotation = l.breaking(40, 0.1) } },
  { "three supports, the middle one breaks", { deflection = held, displacement = held }, { deflection = held }, { { x = 0.4, deflection = breaking } } },
  { "over an open stop", { deflection = held, displacement = held }, { deflection = stop, deflection_at = -0.5 }, { { x = 0.6, deflection = breaking } }, waits = true },
}
local function upto(b, time) return pcall(b.run, b, time) end
print "\nbeam                                     decomposed at first     breaks at          decomposed then        coupled is off by"
for _, beam in ipairs(beams) do
  local function make(decompose)
    return strong{ left = beam[2], right = beam[3], supports = beam[4], step = 0.02, decompose = decompose, heat_gradient = 1, load = function(x, t) return -1.5 * t end }
  end
  local b <const>, coupled <const> = make(true), make(false)
  local before <const> = table.concat(b.decomposed, ", ")
  local stands <const>, why = upto(b, 3)
  if beam.waits then -- the support at 0.6 bears what statics says, then the stop
    coupled:run(0.3)
    assert(coupled:reaction("right").force == 0 and math.abs(coupled:reaction(0.6).force / (1.5 * 0.3 * 0.5 / 0.6) - 1) < 1e-9)
    assert(math.abs(b:reaction("right").force / (1.5 * b.time / 2) - 1) < 1e-9)
  end
  coupled:run(b.time)
  local times <const>, off, size = {}, 0, 0
  for i, broken in ipairs(b.broken) do
    times[i] = ("%.3f"):format(broken.time)
    assert(math.abs(broken.time - coupled.broken[i].time) < 1e-9 and broken.name == coupled.broken[i].name)
  end
  for i = 0, 20 do
    off = math.max(off, math.abs(b:deflection(i / 20) - coupled:deflection(i / 20)))
    size = math.max(size, math.abs(coupled:deflection(i / 20)))
  end
  assert(off < 1e-8 * size)
  print(("%-39s  %-22s  %-17s  %-22s %.0e"):format(beam[1], before, stands and table.concat(times, ", ") or ("%.3f: falls"):format(why:match "broke at t = ([%d.]+)"),
    stands and table.concat(b.decomposed, ", ") or "no solution", off / size))
  assert(stands == (before ~= "stretching, bending"), "without a solution are the beams that statics holds, and no other support waits under these")
end

dotyk.chart{ file = "images/papers_beam_breaking.png", columns = 2, size = { 2100, 1400 }, panels = {
  { title = "Force on the latch", x = "time [min]", y = "force [N]", series = force },
  { title = "Deflection of the end", x = "time [min]", y = "deflection [mm]", series = deflection },
  { title = "Strong coupling: time of the break", x = "time step", y = "error of the time", log = "xy", series = times_off, slopes = { 1, 2 } },
  { title = "Strong coupling: deflection of the end", x = "time step", y = "error of the deflection", log = "xy", series = ends_off, slopes = { 1, 2 } },
} }
print "images/papers_beam_breaking.png"
