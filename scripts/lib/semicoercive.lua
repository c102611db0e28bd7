-- Bodies that nothing but contact holds (Netuka, ODAM 2001, 101–125). Each scene: name, sizes, make(n) → scene. None of the
-- bodies has a support. Loaded by include; solves nothing itself.

local stone <const> = dotyk.material{ E = 2000, nu = 0.25 }

local function block(name, n, low, high, arch)
  return dotyk.body{ name = name, material = stone, force = {0, -4},
    mesh = dotyk.mesh.rectangle{ from = {-1, low}, to = {1, high}, cells = {n, math.max(2, n // 4)}, element = "Q1" }
      :transform(function(x, y) return x, y + arch * x^2 * (high - y) / (high - low) end) } -- hollow below, flat above
end

return {
  { name = "arch on the ground", sizes = { 8, 16, 32, 64 }, make = function(n)
    -- Touches in one node; that it does not roll is left to contact.
    local arch = block("arch", n, 0, 0.5, 0.02)
    arch:part"top":load(function(x) return 0, -20 - 5 * x end)
    local scene = dotyk.scene{ arch }
    scene:contact{ arch:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
    return scene
  end },
  { name = "five blocks apart", sizes = { 8, 16, 32, 64 }, make = function(n)
    -- Nothing touches at rest: every body has to fall first.
    local blocks = {}
    for k = 1, 5 do blocks[k] = block("block " .. k, n, 0.51 * k - 0.5, 0.51 * k, 0.003 * k) end
    local scene = dotyk.scene(blocks)
    scene:contact{ blocks[1]:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
    for k = 2, 5 do scene:contact{ blocks[k - 1]:part"top", blocks[k]:part"bottom" } end -- normals of the flat sides
    blocks[5]:part("load", function(x, _, _, ny) return ny > 0.9 and math.abs(x - 0.3) < 0.3 end):pressure(10)
    return scene
  end },
  { name = "block in a notch", sizes = { 8, 16, 32, 64 }, make = function(n)
    -- Two walls at 45°, at a distance: falls, meets one wall, slides down along it to the other.
    local b = dotyk.body{ name = "block", material = stone, force = { 0.5, -4 },
      mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, n}, element = "Q1" }:transform(
        function(x, y) return (x - y) / math.sqrt(2), (x + y) / math.sqrt(2) end) }
    local scene = dotyk.scene{ b }
    for side, nx in pairs{ left = -1, bottom = 1 } do
      scene:contact{ b:part(side), rigid = dotyk.rigid.plane{ point = {0, -0.02 + 0.004 * nx}, normal = { -nx, 1 } } }
    end
    return scene
  end },
  { name = "ball in a corner", sizes = { 4, 6, 8, 10 }, make = function(n)
    -- Three planes at right angles to each other, at three distances; the ball is free to spin.
    local ball = dotyk.body{ name = "ball", material = stone, force = { 0.3, 0.1, -4 },
      mesh = dotyk.mesh.box{ from = {-1, -1, -1}, to = {1, 1, 1}, cells = {n, n, n}, element = "Q1" }
        :transform(function(x, y, z) -- the cube onto the ball
          return x * math.sqrt(1 - y^2 / 2 - z^2 / 2 + y^2 * z^2 / 3),
                 y * math.sqrt(1 - z^2 / 2 - x^2 / 2 + z^2 * x^2 / 3),
                 z * math.sqrt(1 - x^2 / 2 - y^2 / 2 + x^2 * y^2 / 3)
        end) }
    local scene = dotyk.scene{ ball }
    for k = 1, 3 do
      local a = math.rad(120 * k + 10)
      local nx, ny, nz = math.sqrt(2 / 3) * math.cos(a), math.sqrt(2 / 3) * math.sin(a), math.sqrt(1 / 3)
      local distance = 1 + 0.005 * k
      local part = ball:part("side " .. k, function(_, _, _, mx, my, mz) return mx * nx + my * ny + mz * nz < -0.75 end)
      scene:contact{ part, rigid = dotyk.rigid.plane{ point = { -distance * nx, -distance * ny, -distance * nz },
                                                      normal = { nx, ny, nz } } }
    end
    return scene
  end },
}
