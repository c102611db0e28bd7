-- dotyk.thermoelastic_beam: what it gives, what it refuses.
local check <const> = require "check"
local refused <const> = require "refused"
local l <const> = dotyk.law

local function data(keys)
  local all = { height = 0.5, E = 100, expansion = 0.1, conductivity = 1, heat_capacity = 1, reference_temperature = 3, step = 0.1 }
  for key, value in pairs(keys or {}) do all[key] = value end
  return all
end
local function beam(keys) return dotyk.thermoelastic_beam(data(keys)) end

-- A state, its fields, steps and chained calls.
local b <const> = beam{ left = { deflection = l.signorini(), displacement = l.prescribed(0.25), temperature = function(t) return 2 * t end },
                        right = { deflection = l.signorini() }, load = function(x, t) return -2 - t end, supports = { { x = 0.3, deflection = l.load(-0.5) } },
                        initial = { gradient = function(x) return x end, temperature = 1 } }
check.equal(b.time, 0)
check.equal(b.steps, 0)
check.near(b:gradient(0.5), 0.5)
check.near(b:temperature(0.5, 0.2), 1 + 0.2 * 0.5)
check.equal(b:step().steps, 1)
check.near(b.time, 0.1)
check.equal(b:step():run(1).time, 1)
check.equal(b.steps, 10)
check.near(b:temperature(0), 2)
check.near(b:displacement(0), 0.25)
check.near(b:reaction("left").force + b:reaction("right").force, 3.5, 1e-10)
check.near(b:reaction(0.3).force, -0.5)
check.near(b:reaction("right").force, 1.5 + 0.15, 1e-10)
check.near(b:shear(0.31) - b:shear(0.29), 0.5 + 3 * 0.02, 1e-9)
check.near(b:reaction("left").displacement, 0.25)
check.equal(b.decomposed, { "stretching", "bending" })
check.that(b.energy.dissipated > 0 and math.abs(b.energy.defect) < 0.2 * b.energy.dissipated)
check.that(tostring(b):find("stretching and bending decomposed", 1, true))
check.that(math.abs(b:normal(0.5)) < 1e-9)

-- A support that breaks: said with its time; the beam goes on as a cantilever.
local breaking <const> = beam{ left = { deflection = l.prescribed(), rotation = l.prescribed() }, right = { deflection = l.breaking(40, 0.3) }, load = function(x, t) return -t end }
check.equal(#breaking:run(0.5).broken, 0)
check.equal(breaking.decomposed, { "stretching" })
check.equal(breaking:run(3).broken[1].name, "right deflection")
check.that(breaking.broken[1].time > 0.5 and breaking.broken[1].time < 3 and breaking.energy.released > 0)
check.equal(breaking:reaction("right").force, 0)
check.equal(breaking.decomposed, { "stretching", "bending" })
check.that(tostring(breaking):find("right deflection broke at t = ", 1, true))

-- One-sided ends of the axis, a named method.
local bar <const> = beam{ left = { displacement = l.signorini() }, right = { displacement = l.signorini() }, initial = { temperature = 1 }, solver = dotyk.solver.newton{}, order = 1 }
check.near(bar:reaction("left").axial, 5)
check.near(bar:reaction("right").axial, -5)
bar:run(0.5)
check.that(bar.problems >= 5 and bar.method:find("ewton"))
check.equal(beam{ decompose = false }.decomposed, {})

-- Refusals, at the line of the call, the state left alone.
refused(function() dotyk.thermoelastic_beam(data{ heigth = 1 }) end, "heigth", "height")
refused(function() dotyk.thermoelastic_beam{ height = 1 } end, "missing key 'E'")
refused(function() dotyk.thermoelastic_beam(data{ height = 0 }) end, "'height' must be a positive number")
refused(function() dotyk.thermoelastic_beam(data{ order = 3 }) end, "'order'")
refused(function() dotyk.thermoelastic_beam(data{ exchange = { above = -1 } }) end, "above")
refused(function() dotyk.thermoelastic_beam(data{ load = -1 }) end, "no solution at t = 0", "nothing stops")
refused(function() dotyk.thermoelastic_beam(data{ axial_load = 1, left = { deflection = l.prescribed(), rotation = l.prescribed() } }) end, "towards the right along the axis")
refused(function() dotyk.thermoelastic_beam(data{ load = function() return 0/0 end }) end, "function 'load' returned nan")
refused(function() dotyk.thermoelastic_beam(data{ exchange = { above = 1 }, ambient = { above = function() end } }) end, "function 'ambient.above' returned nothing")
refused(function() dotyk.thermoelastic_beam(data{ load = function() end }) end, "function 'load' returned nothing")
refused(function() dotyk.thermoelastic_beam(data{ initial = { gradient = function(x) return x / 0 end } }) end, "gradient", "inf")
refused(function() dotyk.thermoelastic_beam(data{ supports = { { x = 2, deflection = l.prescribed() } } }) end, "x = 2", "from 0 to 1")
refused(function() b:run(0.5) end, "it is at 1 now")
refused(function() b:run(math.huge) end, "time")
refused(function() b:run(1e12) end, "steps of 0.1")
refused(function() b:deflection(2) end, "not on the beam")
refused(function() b:reaction(0.4) end, "left, x = 0.3, right")
refused(function() b:temperature(0.5, 1) end, "not within the beam")
local lifted <const> = beam{ left = { deflection = l.signorini() }, right = { deflection = l.signorini() }, load = function(_, t) return t < 0.35 and -1 or 1 end }
refused(function() lifted:run(1) end, "no solution at t = 0.35", "theorem 3")
check.near(lifted.time, 0.3)
local broken = false
local failing <const> = beam{ load = function(_, t) if t > 0.25 then broken = true; error("no load", 0) end return 0 end }
check.that(not pcall(failing.run, failing, 1))
check.that(broken)
check.near(failing.time, 0.2)

-- A load that steps its own beam.
local own
own = beam{ load = function() if own then own:step() end return 0 end }
check.that(select(2, pcall(own.step, own)):find("it is being stepped", 1, true))
check.equal(own.steps, 0)

-- A loose bar with nothing to hold it but a stop: any position, and the reason says so.
local loose <const> = beam{ left = { deflection = l.prescribed(), rotation = l.prescribed() }, right = { displacement = l.signorini() }, exchange = { above = 1, below = 1 },
                            ambient = { above = function(t) return math.sin(5 * t) end } }
loose:run(1)
check.near(loose:normal(0.5), 0, 1e-12)
check.that(loose.reason:find("unique up to", 1, true))

-- Units of length: 1e-9 and 1e9 of them.
local forces = {}
for i, u in ipairs{ 1, 1e-9, 1e9 } do
  local s = dotyk.thermoelastic_beam{ length = u, height = 0.02 * u, width = u, E = 2.1e11 / u^2, expansion = 1.2e-5, conductivity = 50, heat_capacity = 3.8e6 / u^2,
    exchange = { above = 250 / u, below = 10 / u }, ambient = { above = function(t) return -130 * (1 - math.exp(-t / 60)) end }, load = -1540 / u, step = 6,
    left = { deflection = l.prescribed(), rotation = l.prescribed(), displacement = l.prescribed() }, right = { deflection = l.signorini() } }
  forces[i] = s:run(30):reaction("right").force
end
check.near(forces[2], forces[1], 1e-6 * forces[1])
check.near(forces[3], forces[1], 1e-6 * forces[1])

-- Supports that move and forces at them, as numbers and functions of t, at ends and within; E and expansion as functions of x.
local driven <const> = beam{ left = { deflection = l.prescribed(), deflection_at = math.sin, rotation_at = 0, rotation = l.elastic(1), displacement = l.prescribed(), displacement_at = function(t) return -t end },
  right = { deflection = l.elastic(2), deflection_at = function(t) return 3 * t end, force = function(t) return 2 * t end, moment = 0.25, axial_force = function(t) return t end },
  supports = { { x = 0.7, force = function(t) return -t end }, { x = 0.3, deflection = l.elastic(1), deflection_at = 0.5, moment = function(t) return t end } },
  E = function(x) return 100 + x end, expansion = function() return 0.1 end }
driven:run(1)
check.near(driven:deflection(0), math.sin(1), 1e-10)
check.near(driven:displacement(0), -1, 1e-10)
check.near(driven:normal(0.5), 1, 1e-9)
check.near(driven:reaction("right").force, 2 + 2 * (3 - driven:deflection(1)), 1e-9)
check.near(driven:reaction("right").moment, 0.25)
check.near(driven:reaction(0.7).force, -1)
check.near(driven:reaction(0.3).force, 0.5 - driven:deflection(0.3), 1e-9)
check.near(driven:reaction(0.3).moment, 1)
local sum = 0
for _, at in ipairs{ "left", 0.3, 0.7, "right" } do sum = sum + driven:reaction(at).force end
check.near(sum, 0, 1e-9)
refused(function() dotyk.thermoelastic_beam(data{ left = { deflection_at = math.sin } }) end, "'deflection_at'", "that is free")
refused(function() dotyk.thermoelastic_beam(data{ right = { displacement_at = 1 } }) end, "'displacement_at'", "that is free")
refused(function() dotyk.thermoelastic_beam(data{ supports = { { x = 0.5, axial_force = 1 } } }) end, "unknown key 'axial_force'")
refused(function() dotyk.thermoelastic_beam(data{ E = function(x) return -x end, left = { deflection = l.prescribed(), rotation = l.prescribed() } }) end, "Young's modulus E is -", "it must be positive")
refused(function() dotyk.thermoelastic_beam(data{ E = -1 }) end, "'E'")
refused(function() dotyk.thermoelastic_beam(data{ supports = { { x = 0.5, force = function() end } } }) end, "function 'supports[1].force' returned nothing")
