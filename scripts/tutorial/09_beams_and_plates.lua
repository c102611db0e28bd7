-- Tutorial 9: beams and plates on supports that only push.
--
--   ./dotyk scripts/tutorial/09_beams_and_plates.lua

local law <const> = dotyk.law

-- 1. A beam on three rigid supports that it may lift off, pressed down between two of them.
local beam <const> = dotyk.beam{ length = 3, EJ = 1, cells = 60, load = function(x) return x < 1 and -1 or 0 end,
  left = { deflection = law.signorini() }, right = { deflection = law.signorini() }, supports = { { x = 1.5, deflection = law.signorini() } } }
print(beam)
local b <const> = dotyk.solve(beam)
print(("deflection at the right end: %.4f (it lifts), in the loaded part: %.4f"):format(b:deflection(3), b:deflection(0.6)))
assert(b:deflection(3) > 0 and b:deflection(0.6) < 0)
print("wrote", b:render{ file = "images/tutorial_09_beam.png" })

-- 2. A square plate laid on its edges lifts its corners.
local n <const> = 24
local plate <const> = dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } }, element = "hct", nu = 0.3,
  load = -1, edge = { deflection = law.signorini() } }
local p <const> = dotyk.solve(plate)
print(("corner %.2e above its support, middle %.2e below"):format(p:deflection(0, 0), -p:deflection(0.5, 0.5)))
assert(p:deflection(0, 0) > 0)
print("wrote", p:render{ file = "images/tutorial_09_plate.png", title = "A plate laid on its edges" })
