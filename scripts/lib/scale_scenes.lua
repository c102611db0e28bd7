-- Scenes of one shape at any number of cells: what solvers are timed on. Loaded by include.

local scenes = {}

local function paraboloid(x, y) return (x - 0.5)^2 + (y - 0.5)^2 end
local function coulomb(coefficient) return coefficient and dotyk.friction.coulomb(coefficient) end

-- S3 of the benchmarks: a rigid paraboloid on a cube of n³ cells. `o` may have nu, height (of the cube), depth (of the paraboloid, over the height),
-- friction (Coulomb's coefficient), element, linear (a load in place of contact), row (so many cubes that are one body, side by side, each with a
-- paraboloid of its own), refine (cells are cut so often: several processes do that where they work).
function scenes.cube(n, o)
  o = o or {}
  local height <const>, row <const>, coarse <const> = o.height or 1, o.row or 1, n >> (o.refine or 0)
  local body <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = o.nu or 0.3 },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {row, 1, height}, cells = {row * coarse, coarse, coarse}, element = o.element }, refine = o.refine }
  body:part"bottom":fix()
  local scene <const> = dotyk.scene{ body }
  if o.linear then
    body:part"top":load{ 0, 0, -1 }
  else
    local depth <const> = (o.depth or 0.02) * height
    scene:contact{ body:part"top", friction = coulomb(o.friction), interference = true,
      rigid = dotyk.rigid.gap{ normal = {0, 0, 1}, gap = function(x, y) return paraboloid(x - math.min(math.floor(x), row - 1), y) / 2 - depth end } }
  end
  return scene
end

-- Two blocks whose meshes do not match, n³ cells together, pressed on each other. `o` may have contrast (how much stiffer the upper one is), friction,
-- linear (glue in place of contact), refine (as of the cube).
function scenes.blocks(n, o)
  o = o or {}
  local half <const> = n // 2
  local function block(name, from, to, cells, E)
    for i = 1, 3 do cells[i] = cells[i] >> (o.refine or 0) end
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3 }, mesh = dotyk.mesh.box{ from = from, to = to, cells = cells }, refine = o.refine }
  end
  local lower = block("lower", {0, 0, 0}, {1, 1, 0.5}, {n, n, half}, 1000)
  local upper = block("upper", {0, 0, 0.5}, {1, 1, 1}, {math.max(n - 4, 2), math.max(n - 4, 2), half}, 1000 * (o.contrast or 1))
  lower:part"bottom":fix()
  upper:part"top":displace{ x = 0, y = 0, z = -0.01 }
  local scene <const> = dotyk.scene{ lower, upper }
  if o.linear then
    scene:glue{ upper:part"bottom", lower:part"top" }
  else
    scene:contact{ upper:part"bottom", lower:part"top", gap = function(x, y) return paraboloid(x, y) / 50 end, friction = coulomb(o.friction) }
  end
  return scene
end

return scenes
