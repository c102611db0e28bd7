-- Materials that cannot be.
local check <const> = require "check"
local refused <const> = require "refused"

local it <const> = refused.pressed_block()
refused.intact = it.solve
local box <const> = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {1,1,1} }

for _, E in ipairs{ 0, -1, -1e-300 } do
  refused(function() dotyk.material{ E = E } end, "material: E is " .. ("%g"):format(E), "must be positive")
end
for _, E in ipairs{ 0/0, 1/0, -1/0 } do
  refused(function() dotyk.material{ E = E } end, "material: 'E' must be a finite number, got ")
end
refused(function() dotyk.material{ E = 0/0 } end, "got nan")
refused(function() dotyk.material{ nu = 0.3 } end, "material: E is missing")
refused(function() dotyk.material{} end, "material: E is missing")
refused(function() dotyk.material{ E = { 1, 2 } } end, "'E' must be a number or a function, got a table of 2")

refused(function() dotyk.material{ E = 1, nu = 0.5 } end, "nu is 0.5", "(-1, 0.5)", "0.5 is incompressible", "0.499")
refused(function() dotyk.material{ E = 1, nu = -1 } end, "nu is -1", "(-1, 0.5)")
refused(function() dotyk.material{ E = 1, nu = 0.6, plane = "stress" } end, "nu is 0.6")
refused(function() dotyk.material{ E = 1, nu = 0/0 } end, "'nu' must be a finite number")
-- Plane stress carries nu = 0.5; space does not, whatever "plane" says.
local rubber <const> = dotyk.material{ E = 1, nu = 0.5, plane = "stress" }
dotyk.body{ mesh = it.mesh, material = rubber }
refused(function() dotyk.body{ mesh = box, material = rubber } end, "body: nu is 0.5")
local soft <const> = dotyk.material{ E = 1, nu = function() return 0.5 end, plane = "stress" }
dotyk.body{ mesh = it.mesh, material = soft }
refused(function() dotyk.body{ mesh = box, material = soft } end, "body: material at (", "nu is 0.5")

-- Functions are asked when a body is made: the place is named.
local falling <const> = dotyk.material{ E = function(x, y) return 0.5 - x end }
refused(function() dotyk.body{ mesh = it.mesh, material = falling } end, "body: material at (0.833333, 0.166667): E is -0.333333", "must be positive")
local holed <const> = dotyk.material{ E = function(x, y) return y > 0.5 and 0/0 or 1 end }
refused(function() dotyk.body{ mesh = it.mesh, material = holed } end, "body: function 'E' returned nan (not a number) at (")

-- General stiffness.
local function diagonal(n)
  local rows = {}
  for i = 1, n do
    rows[i] = {}
    for j = 1, n do rows[i][j] = i == j and 1 or 0 end
  end
  return rows
end
local space <const>, plane <const> = dotyk.material{ stiffness = diagonal(6) }, dotyk.material{ stiffness = diagonal(3) }
refused(function() dotyk.body{ name = "b", mesh = it.mesh, material = space } end, "the material of 'b' is for 3-D, its mesh is 2-D")
refused(function() dotyk.body{ name = "b", mesh = box, material = plane } end, "the material of 'b' is for 2-D, its mesh is 3-D")
refused(function() dotyk.material{ stiffness = diagonal(4) } end, "stiffness is 4x4", "3x3 (plane) or 6x6 (space)")
refused(function() dotyk.material{ stiffness = {} } end, "3x3 (plane) or 6x6 (space)")
refused(function() dotyk.material{ stiffness = { {1,0,0}, {0,1}, {0,0,1} } } end, "row 2 of stiffness has 2 numbers")
refused(function() dotyk.material{ stiffness = { {1,0.5,0}, {0,1,0}, {0,0,1} } } end, "must be symmetric")
refused(function() dotyk.material{ stiffness = { {1,2,0}, {2,1,0}, {0,0,1} } } end, "positive definite", "least eigenvalue is -1")
refused(function() dotyk.material{ stiffness = { {0/0,0,0}, {0,1,0}, {0,0,1} } } end, "finite")
refused(function() dotyk.material{ E = 1, stiffness = diagonal(3) } end, "either E and nu, or stiffness")
refused(function() dotyk.material{ E = 1, density = -1 } end, "'density' must be a positive number, got the number -1")
check.equal(dotyk.material{ E = 1, density = 2 }.density, 2.0)
