-- Stability atlas: more conditions at a node than it has freedom.
--
--   ./dotyk scripts/studies/stability/overconstrained.lua [CELLS]
--
-- Four blocks meet at a point, each joint of two in contact or glued: all 16 ways, without friction and with
-- Coulomb's. Around the point the jumps of each displacement component add up to zero; where all four joints
-- prescribe a component there (a glue both, a contact that along its normal, one that sticks both), one of the rows
-- is redundant and only a sum of forces is determined. By that count, without friction, the pressure is unique unless
-- both upright joints are glued, or both level ones. Every method is run on each; displacements are unique always,
-- and compared with the closed form of uniform stress; where pressures deviate from it at all is compared with the
-- count. Draws images/stability_overconstrained.png.

local n <const> = tonumber(arg[1]) or 8
local common <const> = include "../../lib/common.lua"

-- Four unit blocks around the point (1, 1), ν = 0.3, pressed from above by 1 and from the right by q; sliding on the floor
-- and along the wall. `joints`: what holds together 1-2 (below), 3-4 (above), 1-3 (left), 2-4 (right).
local function four(joints, q, friction)
  local blocks = {}
  for k = 1, 4 do
    local x, y = (k - 1) % 2, (k - 1) // 2
    blocks[k] = dotyk.body{ name = "block " .. k, material = dotyk.material{ E = 1, nu = 0.3 },
      mesh = dotyk.mesh.rectangle{ from = {x, y}, to = {x + 1, y + 1}, cells = {n, n}, element = "Q1" } }
  end
  for _, k in ipairs{ 1, 2 } do blocks[k]:part"bottom":slide() end
  for _, k in ipairs{ 1, 3 } do blocks[k]:part"left":slide() end
  for _, k in ipairs{ 3, 4 } do blocks[k]:part"top":pressure(1) end
  for _, k in ipairs{ 2, 4 } do blocks[k]:part"right":pressure(q) end
  local scene = dotyk.scene(blocks)
  local contacts = {}
  for k, pair in ipairs{ { 2, "left", 1, "right" }, { 4, "left", 3, "right" }, { 3, "bottom", 1, "top" }, { 4, "bottom", 2, "top" } } do
    local a, b = blocks[pair[1]]:part(pair[2]), blocks[pair[3]]:part(pair[4])
    if joints:sub(k, k) == "g" then scene:glue{ a, b } else contacts[#contacts + 1] = { scene:contact{ a, b, friction = friction }, k <= 2 and q or 1 } end
  end
  return scene, contacts, blocks
end
local methods <const> = { "pdas", "active_set", "interior_point", "newton", "proximal", "projected_cg", "psor", "uzawa", "feti" }
local nu <const>, q <const> = 0.3, 0.5
local strain <const> = { -((1 - nu^2) * q - nu * (1 + nu)), -((1 - nu^2) - nu * (1 + nu) * q) } -- plane strain, E = 1

local outcomes <const> = { "pressure right", "only displacement right", "not converged" }
local maps <const> = { common.map(outcomes), common.map(outcomes) } -- without friction, with it
local wrong, miscounted, missing, runs, worst = 0, 0, {}, 0, 0
print("deviation of displacements and of pressures, iterations; ! not converged; - cannot treat friction\n            " .. ("%17s"):rep(#methods):format(table.unpack(methods)))
for row = 0, 31 do
  local joints, friction = "", row >= 16 and dotyk.friction.coulomb(0.3) or nil
  for k = 0, 3 do joints = joints .. (row >> k & 1 == 1 and "g" or "c") end
  local unique = not friction and joints:sub(1, 2) ~= "gg" and joints:sub(3, 4) ~= "gg"
  local line, deviates = ("%-12s"):format(joints .. (friction and ", μ" or "")), false
  for column, name in ipairs(methods) do
    local scene, contacts, blocks = four(joints, q, friction)
    local treats, s = pcall(function() return dotyk.solver[name]{}:solve(scene) end)
    if not treats then
      assert(friction and s:find("cannot treat", 1, true), s)
      line = line .. ("%17s"):format "-"
    else
      local ux, uy = s:displacement(blocks[4], 2, 2)
      local off, pressure = math.max(math.abs(ux / (2 * strain[1]) - 1), math.abs(uy / (2 * strain[2]) - 1)), 0
      for _, c in ipairs(contacts) do
        for _, node in ipairs(s:contact(c[1]).nodes) do pressure = math.max(pressure, math.abs(node.pressure / c[2] - 1)) end
      end
      runs = runs + 1
      if s.converged then
        worst = math.max(worst, off)
        if off > 1e-8 or common.residual(s) > 1e-8 then wrong = wrong + 1 end
        deviates = deviates or pressure > 1e-6
      else missing[name] = (missing[name] or 0) + 1 end
      maps[row // 16 + 1]:add(not s.converged and "not converged" or pressure > 1e-6 and "only displacement right" or "pressure right", column, row % 16 + 1)
      line = line .. (" %5.0e %5.0e%4d%1s"):format(off, pressure, s.iterations, s.converged and "" or "!")
    end
  end
  -- Without any contact there is no pressure to deviate.
  if not friction and joints ~= "gggg" and deviates == unique then miscounted = miscounted + 1 end
  print(line)
end
local panels <const>, names <const> = {}, {}
for k, name in ipairs(methods) do names[k] = common.method(name) end
for k, title in ipairs{ "Without friction", "Coulomb's friction" } do
  panels[k] = { title = title, y = "combination of joints", categories = names, map = maps[k]:cells() }
end
dotyk.chart{ file = "images/stability_overconstrained.png", columns = 2, size = { 2100, 1000 }, x = "method", panels = panels }
print "images/stability_overconstrained.png"
local text = {}
for _, name in ipairs(methods) do if missing[name] then text[#text + 1] = name .. " " .. missing[name] end end
common.verdict(wrong == 0 and miscounted == 0 and not missing.feti, ("pressures are unique exactly where the count of rows around the point says so (16 of 16 ways without friction); of %d runs those that converge have the "
  .. "displacement right to %.0e, redundant rows or not; not converged, and said so: %s; feti, whose F the redundant rows make singular, solves all"):format(runs, worst, table.concat(text, ", ")))
