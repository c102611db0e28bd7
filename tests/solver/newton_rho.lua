-- Newton's method calls no wrong state converged, whatever rho: with a small one its own natural residual hardly sees in
-- which direction a slipping point is held. A paraboloid on a cube, most of the contact slipping outwards.
local cube = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0.3 },
  mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {12, 12, 12} } }
cube:part"bottom":fix()
local scene = dotyk.scene{ cube }
scene:contact{ cube:part"top", friction = dotyk.friction.coulomb(0.3), rigid = dotyk.rigid.gap{ normal = {0, 0, 1},
  gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.02 end } }
for _, rho in ipairs{ 1e-8, 1e-7, 1e-2 } do
  local s = dotyk.solver.newton{ rho = rho, max_iterations = 12 }:solve(scene)
  -- residual.law is of the row stiffness, and measured on the recovered displacements: rounding adds to tol = 1e-10
  if s.converged then assert(s.residual.law < 1e-9, ("rho = %g: %g"):format(rho, s.residual.law)) end
  if rho >= 1e-5 then assert(s.converged, s.reason) end -- below about 1e-16/tol rounding is more than tol
end
