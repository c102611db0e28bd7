-- One residual covers all laws: it is small at a solution, whatever the units, and printed.
local function block(unit, force)
  return dotyk.body{ name = "block", material = dotyk.material{ E = 1000 * force / unit^2, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {unit, unit}, cells = {4, 4} } }
end

-- Nothing touches: what an interior point method leaves of multipliers is no violation of a law.
do
  local b = block(1, 1)
  b:part"bottom":fix()
  b:part"top":load{ 0.1, 1 }
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"top", rigid = dotyk.rigid.plane{ point = {0, 5}, normal = {0, -1} } }
  for _, method in ipairs{ "interior_point", "pdas", "penalty", "feti", "projected_cg" } do
    local s = dotyk.solver[method]{}:solve(scene)
    assert(s.converged and s.residual.law < 1e-9, method .. ": " .. s.residual.law .. " " .. s.reason)
  end
end

-- Given friction on springs a billionth as stiff as the body: it moves far, and rounding of that is no force.
for _, unit in ipairs{ 1, 1e3 } do
  for _, force in ipairs{ 1, 1e-5 } do
    local b = block(unit, force)
    b:part"left":spring{ x = 1e-4 * force / unit^2, y = 1e-4 * force / unit^2 }
    b:part"top":load{ 0.5 * force / unit, -force / unit }
    local scene = dotyk.scene{ b }
    scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} }, friction = dotyk.friction.tresca(0.3 * force / unit) }
    local s = dotyk.solve(scene)
    assert(s.converged and s.residual.law < 1e-9, s.residual.law .. " " .. s.reason)
    assert(tostring(s):find("law %d") and tostring(s):find("friction %d"), tostring(s))
  end
end

-- A penalised state is off the laws by what the method says, and is converged; what a rough tol leaves is allowed for.
do
  local b = block(1, 1)
  b:part"left":fix "x"
  b:part"top":load{ 0, -1 }
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
  local soft = dotyk.solver.penalty{ factor = 10 }:solve(scene)
  assert(soft.converged and soft.residual.law > 1e-3, tostring(soft))
end

-- Beams and plates print it, too.
local beam = dotyk.solve(dotyk.beam{ length = 1, EJ = 1, cells = 8, load = -1,
  left = { deflection = dotyk.law.signorini() }, right = { deflection = dotyk.law.signorini() } })
assert(beam.converged and beam.residual.law < 1e-9 and tostring(beam):find("law %d"))
