-- Numbers too large or too far apart: an error or "not converged", never nan and never a wrong solution.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
refused.intact = it.solve

local function column(options)
  local b = dotyk.body{ mesh = options.mesh or it.mesh, material = options.material or it.material }
  b:part "bottom":fix()
  return b, dotyk.scene{ b }
end

-- Loads.
for _, f in ipairs{ 1e308, -1e308, 1e200 } do
  local b, scene = column{}
  b:part "top":load{ 0, f }
  refused(function() dotyk.solve(scene) end, "beyond the range of numbers", "choose units")
  local c, pressed = column{}
  pressed:contact{ c:part "right", rigid = dotyk.rigid.plane{ point = {1,0}, normal = {-1,0} } }
  c:part "top":load{ f, 0 }
  refused(function() dotyk.solve(pressed) end, "beyond the range of numbers")
end
do
  local b, scene = column{}
  for _ = 1, 4 do b:part "top":load{ 0, 1e308 } end  -- their sum is infinite
  refused(function() dotyk.solve(scene) end, "beyond the range of numbers")
end
-- Displacements, stiffness, sizes.
do
  local b, scene = column{}
  b:part "top":displace{ y = 1e308 }
  refused(function() dotyk.solve(scene) end, "beyond the range of numbers")
  b, scene = column{ material = dotyk.material{ E = 1e308, nu = 0.3 } }
  refused(function() dotyk.solve(scene) end, "beyond the range of numbers")
end
refused(function() dotyk.mesh.rectangle{ from = {-1e308,0}, to = {1e308,1}, cells = {1,1} } end, "the extent along x", "choose another unit of length")
local wide <const> = dotyk.mesh.rectangle{ from = {0,0}, to = {1e308,1}, cells = {1,1} }
refused(function() dotyk.body{ mesh = wide, material = it.material } end, "cell 1 is so large", "choose another unit of length")
local tiny <const> = dotyk.mesh.rectangle{ from = {0,0}, to = {1e-200,1e-200}, cells = {1,1} }
refused(function() dotyk.body{ mesh = tiny, material = it.material } end, "cell 1 is so small", "choose another unit of length")

-- Within the range all scales are alike.
for _, scale in ipairs{ 1e-100, 1e100 } do
  local b, scene = column{ material = dotyk.material{ E = scale, nu = 0 } }
  b:part "top":pressure(0.25 * scale)
  local s = dotyk.solve(scene)
  check.that(s.converged)
  check.near(s:stress(b, 0.5, 0.5).von_mises / scale, 0.25)
  check.near(select(2, s:displacement(b, 0.5, 1)), -0.25)
end
for _, scale in ipairs{ 1e-30, 1e30 } do
  local m = dotyk.mesh.rectangle{ from = {0,0}, to = {scale,scale}, cells = {2,2} }
  local b, scene = column{ mesh = m }
  b:part "top":pressure(1)
  check.near(select(2, dotyk.solve(scene):displacement(b, 0.5 * scale, scale)) / scale, -0.1)
end
-- von Mises stress whose square is out of range.
do
  local b, scene = column{ material = dotyk.material{ E = 1e180, nu = 0 } }
  b:part "top":displace{ y = -1e-60 }
  b:part "left":fix "x"
  check.near(dotyk.solve(scene):stress(b, 0.5, 0.5).von_mises / 1e120, 1)
  b, scene = column{ material = dotyk.material{ E = 1e260, nu = 0 } }
  b:part "top":displace{ y = -1e-120 }
  check.near(dotyk.solve(scene):stress(b, 0.5, 0.5).von_mises / 1e140, 1)
end

-- Where rounding eats the answer it is not called a solution, or the factorisation notices it.
local function doubtful(b, scene)
  b:part "top":load{ 0, -1 }
  local ok, s = pcall(dotyk.solve, scene)
  if not ok then return check.that(s:find("the stiffness of 'body' is singular at node", 1, true), s) end
  check.that(not s.converged)
  check.that(s.reason:find("stiffnesses, supports or sizes are too far apart", 1, true), s.reason)
  check.that(s.residual.equilibrium > 1e-6)
end
doubtful(column{ material = dotyk.material{ E = 1, nu = 0.49999999999999994 } })
local fine <const> = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} }
doubtful(column{ mesh = fine, material = dotyk.material{ E = function(x, y) return x > 0.5 and 1e300 or 1e-300 end } })
do
  local b = dotyk.body{ mesh = it.mesh, material = it.material }
  b:part "bottom":spring{ x = 1e-300, y = 1e-300 }
  b:part "top":load{ 0, -1 }
  refused(function() dotyk.solve(dotyk.scene{ b }) end,
    "beyond the range of numbers")
end

-- Squares that leave the range would lose friction, or the error: that is said, whatever the method.
local function rubbing(E, strain)
  local b, scene = column{ mesh = fine, material = dotyk.material{ E = E, nu = 0.3 } }
  b:part "top":load{ 0.3 * E * strain, -E * strain }
  return b, scene, scene:contact{ b:part "right", rigid = dotyk.rigid.plane{ point = {1,0}, normal = {-1,0} }, friction = dotyk.friction.coulomb(0.3) }
end
local _, moderate <const>, rubs <const> = rubbing(1, 0.1)
local known <const> = dotyk.solve(moderate)
for _, case in ipairs{ { 1e100, 0.1 }, { 1e-100, 0.1 }, { 1, 1e-90 }, { 1e-50, 1e90 }, { 1e-80, 1e150 } } do
  local _, scene, c = rubbing(case[1], case[2])
  local s = dotyk.solve(scene)
  check.that(s.converged)
  for i = 1, 2 do check.near(s:contact(c).force[i] / (case[1] * case[2]), known:contact(rubs).force[i] / 0.1, 1e-9) end
  check.near((s:error_estimate()), (known:error_estimate()), 1e-9)
end
for _, case in ipairs{ { 1e156, 0.1 }, { 1e200, 0.1 }, { 1e-160, 0.1 }, { 1e-290, 0.1 }, { 1e100, 1e80 }, { 1e-100, 1e-100 } } do
  local _, scene = rubbing(case[1], case[2])
  for _, method in ipairs{ dotyk.solver.newton{}, dotyk.solver.pdas{}, dotyk.solver.feti{} } do
    refused(function() method:solve(scene) end, "beyond the range of numbers", "choose units")
  end
end
for _, E in ipairs{ 1e155, 1e200, 1e-160, 1e-200 } do
  local b, scene = column{ mesh = fine, material = dotyk.material{ E = E, nu = 0.3 } }
  b:part "top":load{ 0, -E / 10 }
  local s = dotyk.solve(scene)
  check.that(s.converged)
  refused(function() s:error_estimate() end, "the error estimate has values beyond the range of numbers", "choose units")
end
-- Loads of steps are looked at as well.
do
  local b, scene = column{}
  b:part "top":load{ 0, -1 }
  scene:contact{ b:part "right", rigid = dotyk.rigid.plane{ point = {1,0}, normal = {-1,0} } }
  for _, method in ipairs{ dotyk.solver.feti{}, dotyk.solver.pdas{} } do
    refused(function() method:solve(scene, { steps = { { load = 1 }, { load = 1e308 } } }) end, "step 2: values beyond the range of numbers: loads are about")
  end
end

-- A body so thin that rounding takes its stiffness against bending is refused with that reason, the place, and what to do.
do
  local strip <const> = dotyk.body{ name = "strip", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1e-5 }, cells = { 10, 1 }, element = "Q2" } }
  strip:part "left":fix()
  strip:part "top":load{ 0, -1e-18 }
  local scene <const> = dotyk.scene{ strip }
  check.error(dotyk.solve, "singular at node", scene)
  check.error(dotyk.solve, "times as long as they are thick", scene)
  scene:contact{ strip:part "bottom", rigid = dotyk.rigid.plane{ point = { 0, -1e-7 }, normal = { 0, 1 } } }
  check.error(dotyk.solve, "times as long as they are thick", scene)
end
