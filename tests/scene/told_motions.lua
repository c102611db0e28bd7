-- Motions are told as a person sees them: a turn about a point, a translation along a plane, whatever modes they are made of.
local check <const> = require "check"
local refused <const> = require "refused"
local steel <const> = dotyk.material{ E = 1000, nu = 0.3 }

-- A block on a slope slides along it, downhill.
local function slider(tilt)
  local c <const>, s <const> = math.cos(tilt), math.sin(tilt)
  local block <const> = dotyk.body{ name = "block", material = steel, force = { 0, -1 },
    mesh = dotyk.mesh.rectangle{ from = { 2, 0 }, to = { 3, 1 }, cells = { 2, 2 } }:transform(function(x, y) return c * x - s * y, s * x + c * y end) }
  local scene <const> = dotyk.scene{ block }
  scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { -s, c } } }
  return scene
end
refused(function() dotyk.solve(slider(-math.atan(0.75))) end, "nothing stops 'block': translation along (0.8, -0.6); the load does work", "Hold 'block' along (0.8, -0.6) (a slide or a spring on a part of it)")
check.equal(slider(-math.atan(0.75)):balance().motion, "'block': translation along (0.8, -0.6)")

-- A block whose load is beside its foot tips over the foot's end, though its own modes are about its middle; the sense is told.
local function tipping(side)
  local block <const> = dotyk.body{ name = "block", material = steel, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 8, 4 } } }
  block:part("cap", function(x, _, _, ny) return ny > 0.5 and (x - 1) * side > 0.75 end):load{ 0, -1 }
  local scene <const> = dotyk.scene{ block }
  scene:contact{ block:part("foot", function(x, _, _, ny) return ny < -0.5 and (x - 1) * side < 0.5 end), rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }
  return scene
end
refused(function() dotyk.solve(tipping(1)) end, "nothing stops 'block': clockwise rotation about (1.5, 0.5); the load", "Fix or spring a part of 'block' away from the point")
refused(function() dotyk.solve(tipping(-1)) end, "nothing stops 'block': rotation about (0.5, 0.5); the load")

-- Several bodies, each with its share: a wedge that sinks drives another one aside, twice as far as steep.
local function wedges()
  local function wedge(name, f) return dotyk.body{ name = name, material = steel, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 4, 2 }, element = "Q1" }:transform(f) } end
  local low <const> = wedge("low", function(x, y) return x, y * (0.5 + x / 2) end)
  local high <const> = wedge("high", function(x, y) return x, 0.5 + x / 2 + y * (1.5 - x / 2) end)
  high:part "top":pressure(1)
  high:part "left":slide()
  local scene <const> = dotyk.scene{ low, high }
  scene:contact{ low:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }
  scene:contact{ high:part "bottom", low:part "top" }
  return scene
end
refused(function() dotyk.solve(wedges()) end, "nothing stops 'low': translation along x by 1, 'high': translation along -y by 0.5; the load does work")

-- A limit case is one of a load: a body without any, that touches what it could leave, is none; a load above the edge of a block's foot is.
local function resting(load, at)
  local block <const> = dotyk.body{ name = "block", material = steel, mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 4, 2 } } }
  if load > 0 then block:part("cap", function(x, _, _, ny) return ny > 0.5 and x > at end):load{ 0, -load } end
  local scene <const> = dotyk.scene{ block }
  scene:contact{ block:part("foot", function(x, _, _, ny) return ny < -0.5 and x < 1.5 end), rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }
  return scene
end
for _, case in ipairs{ { 0, 0, false }, { 1, 0, false }, { 1, 1, true } } do
  local scene <const> = resting(case[1], case[2])
  check.equal(scene:balance().limit, case[3])
  check.equal(scene:plan():find("limit case", 1, true) ~= nil, case[3])
end
