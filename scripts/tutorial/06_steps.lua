-- Tutorial 6: loads one after the other. Friction remembers.
--
--   ./dotyk scripts/tutorial/06_steps.lua

local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
  mesh = dotyk.mesh.rectangle{ from = { -2, 0 }, to = { 2, 1 }, cells = { 80, 20 }, element = "Q1" } }
local scene <const> = dotyk.scene{ block }
local contact <const> = scene:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } },
  friction = dotyk.friction.coulomb(0.3) }
block:part"top":load({ 0, -10 }, "press") -- loads of a case, which steps scale
block:part"top":load({ 1, 0 }, "push")

-- Press, then push forth, back, and let go: a step says what it changes, what it does not name stays.
local way <const>, steps <const> = { 0, 1, 2, 2.5, 1, 0, -1, -2, -2.5, -1, 0 }, {}
for k, push in ipairs(way) do steps[k] = { load = { press = 1, push = push } } end
local s <const> = dotyk.solve(scene, { steps = steps })
assert(s.converged, s.reason)

print "push   moved at the right end   stick  slip   dissipated"
local x <const>, y <const> = {}, {}
for k, step in ipairs(s.steps) do
  local c <const> = step:contact(contact)
  x[k], y[k] = step:displacement(block, 2, 1), way[k]
  print(("%4.1f %23.5f %7d %5d %12.6f"):format(way[k], x[k], c.stick, c.slip, c.dissipated))
end
assert(math.abs(x[1] - x[#x]) > 1e-6) -- the push is gone, what slipped stays
print("wrote", dotyk.chart{ file = "images/tutorial_06.png", x = "displacement of the right end", y = "push", title = "Pushed forth and back",
  series = { { name = "way", x = x, y = y } } })
-- Four of the states beside each other, in one scale of colours.
local frames <const> = {}
for _, k in ipairs{ 1, 4, 7, 11 } do
  frames[#frames + 1] = s.steps[k]:picture{ field = "xy", deform = 50, loads = true, pressure = "none", title = ("push %g"):format(way[k]) }
end
print("wrote", dotyk.pictures{ file = "images/tutorial_06_states.png", columns = 2, table.unpack(frames) })
