-- A thermoelastic beam whose loads or first temperatures overflow gave energies and rotations that were no numbers.
local refused <const> = require "refused"
local held <const> = { deflection = dotyk.law.prescribed(), rotation = dotyk.law.prescribed(), displacement = dotyk.law.prescribed() }
local function beam(t)
  t.height, t.E, t.expansion, t.conductivity, t.heat_capacity, t.step = 0.1, 0.01, 40, 600, 50, 0.02
  return t
end
local function large(x) return 1e300 * (x or 1) end
for _, key in ipairs{ "load", "axial_load" } do
  refused(function() dotyk.thermoelastic_beam(beam{ [key] = large, left = held }) end, "beyond the range of numbers")
  refused(function() dotyk.thermoelastic_beam(beam{ [key] = large }) end, "nothing stops the motion")
end
refused(function() dotyk.thermoelastic_beam(beam{ initial = { temperature = large } }) end, "beyond the range of numbers")
