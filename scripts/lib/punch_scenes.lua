-- What the benchmarks share: the rigid parabola on a block in the plane (S2) and in space (S3), and a
-- median. Loaded by include; solves nothing itself.

local scenes = {}
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }

function scenes.median(values)
  local sorted = table.move(values, 1, #values, 1, {})
  table.sort(sorted)
  return sorted[(#sorted + 1) // 2]
end

-- Each returns the body, its scene, and the punch that scene:contact takes for the part "top".
function scenes.plane(n)
  local block = dotyk.body{ material = material,
    mesh = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {n, n // 2} } }
  return block, dotyk.scene{ block }, dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 - 0.02 end }
end

function scenes.space(n)
  local cube = dotyk.body{ material = material,
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n} } }
  return cube, dotyk.scene{ cube }, dotyk.rigid.gap{ normal = {0, 0, 1},
    gap = function(x, y) return ((x - 0.5)^2 + (y - 0.5)^2) / 2 - 0.02 end }
end

return scenes
