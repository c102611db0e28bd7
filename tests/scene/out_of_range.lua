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
local wide <const> = dotyk.mesh.rectangle{ from = {-1e308,0}, to = {1e308,1}, cells = {1,1} }
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
  if not ok then return check.that(s:find("the stiffness of 'body' is singular near node", 1, true), s) end
  check.that(not s.converged)
  check.that(s.reason:find("rounding leaves a residual of", 1, true), s.reason)
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
    "'body' is as good as free: translation along x, translation along y, rotation about (0.5, 0.5) is held only by "
    .. "spring on bottom", "lost in rounding")
end
