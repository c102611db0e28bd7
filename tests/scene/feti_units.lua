-- FETI's stopping test knows no unit: the same scene in units of length 1e±3 and of force 1e±12 times as great takes the same steps, whatever drives it,
-- but for a few that rounding decides.
local function solved(case, length, force)
  local function block(name, y, E)
    return dotyk.body{ name = name, material = dotyk.material{ E = E * force / length ^ 2, nu = 0.3 },
      mesh = dotyk.mesh.rectangle{ from = { 0, y * length }, to = { length, (y + 1) * length }, cells = { 6, 6 } } }
  end
  local lower <const>, upper <const> = block("lower", 0, 200), block("upper", 1, 200 * (case.contrast or 1))
  lower:part "bottom":fix()
  if case.overlap then upper:part "top":fix()
  else upper:part "top":load{ 0.1 * force / length ^ 2, -force / length ^ 2 } end
  local scene <const> = dotyk.scene{ lower, upper }
  scene:contact{ upper:part "bottom", lower:part "top", friction = not case.overlap and dotyk.friction.coulomb(0.4) or nil, gap = case.overlap and -case.overlap * length }
  return dotyk.solver.feti{ subdomains = case.subdomains, tol = 1e-9 }:solve(scene)
end

for _, case in ipairs{ { subdomains = 6 }, { subdomains = 6, contrast = 1e4 }, { subdomains = 2, contrast = 1e-4 }, { subdomains = 6, overlap = 1e-3 } } do
  local plain <const> = solved(case, 1, 1)
  assert(plain.converged, plain.reason)
  for _, units in ipairs{ { 1e3, 1 }, { 1e-3, 1 }, { 1, 1e-12 }, { 1, 1e12 } } do
    local s <const> = solved(case, units[1], units[2])
    assert(s.converged, s.reason)
    local more <const> = math.abs(s.feti.inner - plain.feti.inner)
    assert(s.iterations == plain.iterations and more <= 3, ("%d outer steps, not %d, and inner steps other by %d"):format(s.iterations, plain.iterations, more))
    assert(math.abs(s.energy / (plain.energy * units[2]) - 1) < 1e-7, s.energy / plain.energy)
  end
end
