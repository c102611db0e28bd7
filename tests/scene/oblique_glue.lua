-- Glue of parts that do not match, on planes of symmetry of both: turned by any angle the scene has the energy that it has beside the axes, where
-- supports take unknowns away. Supports of both bodies and glue say the same thing in such a plane; if they said it twice, edges would be stiffer.
local check <const> = require "check"

local function energy(turn, dimension)
  local c <const>, s <const> = math.cos(turn), math.sin(turn)
  local function turned(x, y, z)
    if dimension == 2 then return c * x - s * y, s * x + c * y end
    return c * x - s * y, s * x + c * y, z
  end
  local function body(name, low, high, cells, E)
    local mesh <const> = dimension == 3 and dotyk.mesh.box{ from = {0, 0, low}, to = {1, 0.8, high}, cells = { cells, cells + 1, 2 } }
                         or dotyk.mesh.rectangle{ from = {0, low}, to = {1, high}, cells = { cells, 3 } }
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3 }, mesh = mesh:transform(turned) }
  end
  local lower <const>, upper <const> = body("lower", 0, 0.5, 5, 1000), body("upper", 0.5, 1, 7, 300)
  for _, b in ipairs{ lower, upper } do
    b:part"left":slide()
    if dimension == 3 then b:part"front":slide() end
  end
  lower:part"bottom":slide()
  local f <const> = { 2, 3 }
  upper:part"top":load(dimension == 3 and { c * f[1] - s * f[2], s * f[1] + c * f[2], 5 } or { c * f[1] - s * f[2], s * f[1] + c * f[2] })
  local scene <const> = dotyk.scene{ lower, upper }
  scene:glue{ upper:part"bottom", lower:part"top" }
  local solution <const> = dotyk.solve(scene)
  check.that(solution.converged, solution.reason)
  return solution.energy
end

-- What supports of both sides prescribe must agree, in whatever direction.
for _, turn in ipairs{ 0, 0.3 } do
  local c <const>, s <const> = math.cos(turn), math.sin(turn)
  local function body(name, low, cells)
    local mesh <const> = dotyk.mesh.rectangle{ from = {0, low}, to = {1, low + 0.5}, cells = { cells, 2 } }
    return dotyk.body{ name = name, material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = mesh:transform(function(x, y) return c * x - s * y, s * x + c * y end) }
  end
  for _, cells in ipairs{ 4, 5 } do
    local lower <const>, upper <const> = body("lower", 0, 4), body("upper", 0.5, cells)
    lower:part"bottom":slide()
    lower:part"left":slide()
    upper:part"left":support{ normal = dotyk.law.prescribed(0.1) }
    local scene <const> = dotyk.scene{ lower, upper }
    scene:glue{ upper:part"bottom", lower:part"top" }
    local solved <const>, said <const> = pcall(dotyk.solve, scene)
    check.that(not solved and said:find("prescribed displacements that differ by 0.1", 1, true), said)
  end
end

for _, dimension in ipairs{ 2, 3 } do
  local straight <const> = energy(0, dimension)
  for _, turn in ipairs{ 0.3, math.pi / 4, 2 } do
    local turned <const> = energy(turn, dimension)
    check.that(math.abs(turned / straight - 1) < 1e-10, ("%d-D, turned by %g: energy %.15g, not %.15g"):format(dimension, turn, turned, straight))
  end
end
