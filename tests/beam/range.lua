-- A bending stiffness beyond what numbers can hold is refused as such, not as a beam or a plate that nothing holds.
local check <const> = require "check"

for _, stiffness in ipairs{ 1e308, 1e150, 1e-150, 1e-310 } do
  local support = { deflection = dotyk.law.signorini() }
  local beam = { EJ = stiffness, load = -1, left = support, right = support }
  check.error(function() return dotyk.solve(dotyk.beam(beam)) end, "values beyond the range of numbers: stiffnesses")
  check.error(function()
    local mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4}, element = "P1" }
    return dotyk.solve(dotyk.plate{ mesh = mesh, D = stiffness, load = -1, edge = { deflection = dotyk.law.signorini() } })
  end, "values beyond the range of numbers: stiffnesses")
end
