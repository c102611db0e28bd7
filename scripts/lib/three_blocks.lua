-- Three blocks of rock over an excavation, own weight; see scripts/papers/dostal/three_blocks.lua. Loaded by include; solves nothing itself.

-- Lengths in m, the modulus and the weight are of sandstone.
local rock <const> = dotyk.material{ E = 10e9, nu = 0.2 }
local weight <const> = { 0, 0, -25e3 } -- N/m³
local deep <const>, layer <const> = 40, 12

-- cells: nx, ny, nz of an upper block, and of the bottom block along z. open: the part of half its length, of its depth and of its
-- height that the excavation takes, in whole cells. Scene, contacts, bodies (bottom, left, right).
return function(cells, open)
  local function block(name, from, to, count, keep)
    local mesh = dotyk.mesh.box{ from = from, to = to, cells = count, element = "Q1" }
    if keep then mesh = mesh:keep(keep, "excavation") end
    return dotyk.body{ name = name, mesh = mesh, material = rock, force = weight }
  end
  local nx <const>, ny <const>, nz <const> = cells[1], cells[2], cells[3]
  local bottom <const> = block("bottom", { -20, 0, -layer }, { 20, deep, 0 }, { 2 * nx, ny, cells[4] },
    function(x, y, z) return math.abs(x) > 20 * open[1] or y > deep * open[2] or z > -layer * (1 - open[3]) end)
  local left <const> = block("left", { -20, 0, 0 }, { 0, deep, 1.5 * layer }, { nx, ny, nz })
  local right <const> = block("right", { 0, 0, 0 }, { 20, deep, 1.5 * layer }, { nx, ny, nz })
  for _, body in ipairs{ bottom, left, right } do
    body:part "front":slide()
    body:part "back":slide()
  end
  bottom:part "left":slide()
  bottom:part "right":slide()
  bottom:part "bottom":slide()
  left:part "left":slide()
  right:part "right":slide()
  local scene <const> = dotyk.scene{ bottom, left, right }
  return scene, {
    scene:contact{ left:part "bottom", bottom:part("under left", function(x, _, _, _, _, nz_) return nz_ > 0.9 and x < 0 end) },
    scene:contact{ right:part "bottom", bottom:part("under right", function(x, _, _, _, _, nz_) return nz_ > 0.9 and x > 0 end) },
    scene:contact{ left:part "right", right:part "left" } }, { bottom, left, right }
end
