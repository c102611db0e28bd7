-- Bodies displaced as a whole by far more than they are pressed together: the forces are those of the pressing alone, by every
-- method that says that it has converged. The interior-point method's gap is relative to the energy of the displacement.
local check <const> = require "check"

local function scene(far, near)
  local material <const> = dotyk.material{ E = 1000, nu = 0.3 }
  local function block(name, y) return dotyk.body{ name = name, material = material, mesh = dotyk.mesh.rectangle{ from = {-1, y}, to = {1, y + 1}, cells = {12, 6} } } end
  local a <const>, b <const> = block("a", 0), block("b", 1)
  a:part"bottom":displace{ x = far, y = 0 }
  b:part"top":displace{ x = far + near / 2, y = -near }
  local it <const> = dotyk.scene{ a, b }
  return it, it:contact{ b:part"bottom", a:part"top" }
end

for _, near in ipairs{ 1e-2, 1e-4, 1e-5, 1e-6 } do
  local it <const>, contact <const> = scene(1, near)
  local right <const> = dotyk.solver.pdas{}:solve(it):contact(contact)
  for _, reduced in ipairs{ true, false } do
    local s <const> = dotyk.solver.interior_point{ reduced = reduced }:solve(it)
    local c <const> = s:contact(contact)
    if near >= 1e-5 then check.that(s.converged, s.reason) end
    if s.converged then
      check.near(c.force[2] / right.force[2], 1, 1e-3)
      check.near(c.max_pressure / right.max_pressure, 1, 1e-3)
    end
  end
end
