-- FETI where rows depend on each other: four blocks around a point, joints in contact or glued, as
-- scripts/studies/stability/overconstrained.lua has them. Under uniform pressure the multipliers that the coarse space begins
-- with are the solution, and what is left of the dual's right-hand side is rounding; under others there is work to do.
local check <const> = require "check"

local function four(joints, friction, above, beside)
  local blocks = {}
  for k = 1, 4 do
    local x, y = (k - 1) % 2, (k - 1) // 2
    blocks[k] = dotyk.body{ name = "block " .. k, material = dotyk.material{ E = 1, nu = 0.3 },
      mesh = dotyk.mesh.rectangle{ from = {x, y}, to = {x + 1, y + 1}, cells = {3, 3}, element = "Q1" } }
  end
  for _, k in ipairs{ 1, 2 } do blocks[k]:part"bottom":slide() end
  for _, k in ipairs{ 1, 3 } do blocks[k]:part"left":slide() end
  for _, k in ipairs{ 3, 4 } do blocks[k]:part"top":pressure(above) end
  for _, k in ipairs{ 2, 4 } do blocks[k]:part"right":pressure(beside) end
  local scene = dotyk.scene(blocks)
  for k, pair in ipairs{ { 2, "left", 1, "right" }, { 4, "left", 3, "right" }, { 3, "bottom", 1, "top" }, { 4, "bottom", 2, "top" } } do
    local a, b = blocks[pair[1]]:part(pair[2]), blocks[pair[3]]:part(pair[4])
    if joints:sub(k, k) == "g" then scene:glue{ a, b } else scene:contact{ a, b, friction = friction } end
  end
  return scene, blocks
end

local uneven <const> = { function(x) return 1 + 0.3 * x^2 end, function(_, y) return 0.5 + y end }
for bits = 0, 31 do
  local joints, friction = "", bits >= 16 and dotyk.friction.coulomb(0.3) or nil
  for k = 0, 3 do joints = joints .. (bits >> k & 1 == 1 and "g" or "c") end
  for _, loads in ipairs{ { 1, 0.5 }, uneven } do
    local scene, blocks = four(joints, friction, loads[1], loads[2])
    local exact = dotyk.solver[friction and "newton" or "pdas"]{ max_iterations = 500 }:solve(scene)
    for _, preconditioner in ipairs{ "none", "lumped", "dirichlet" } do
      local s = dotyk.solver.feti{ preconditioner = preconditioner }:solve(scene)
      assert(s.converged, joints .. ", " .. preconditioner .. ": " .. s.reason)
      for k, block in ipairs(blocks) do
        local x, y = (k - 1) % 2 + 0.5, (k - 1) // 2 + 0.5
        local ux, uy = s:displacement(block, x, y)
        local ex, ey = exact:displacement(block, x, y)
        check.near(ux, ex, 1e-8) -- tol 1e-10, contact and friction of condition 1e2
        check.near(uy, ey, 1e-8)
      end
    end
  end
end
