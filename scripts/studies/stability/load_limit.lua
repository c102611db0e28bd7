-- Stability atlas: loads at the limit of what contact can carry.
--
--   ./dotyk scripts/studies/stability/load_limit.lua [CELLS]
--
-- A free block, 1 wide and h high, on a rough floor under its weight per volume (t, −1). It slides where t > μ and
-- tips where the line of action leaves the foot, t > 1/h: a solution exists for t ≤ min(μ, 1/h). The verdict of
-- scene:balance() is bisected over t for many μ and two heights. Then the elastic block is solved at relative
-- distances from 1e-1 to 1e-13 to either side of both limits: inside, the resultant must be the load, its line of
-- action that of the load; beyond, there is no solution and no state may be called one. As the limit comes near the
-- bounds of friction are reached at every node, or all the force goes through the last node: iterations and the part
-- of the foot that carries show it. Draws images/stability_load_limit.png.

local n <const> = tonumber(arg[1]) or 8
local common <const> = include "../../lib/common.lua"

local function block(h, mu, t)
  local body = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 }, force = { t, -1 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, h}, cells = {n, math.floor(n * h)}, element = "Q1" } }
  local scene = dotyk.scene{ body }
  return scene, scene:contact{ body:part"bottom", friction = dotyk.friction.coulomb(mu), rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = 0 } }
end

-- 1. The verdict.
local map <const> = common.map{ "both carried", "low block alone", "neither" }
local heights <const>, worst, series = { 1, 2 }, 0, {}
local found = common.curve("boundary", { style = "points" })
local function solvable(h, mu, t) return block(h, mu, t):balance().solvable end
for _, h in ipairs(heights) do series[h] = common.curve(h == 1 and "height 1: min(μ, 1)" or "height 2: min(μ, ½)", { reference = true }) end
for k = 1, 15 do
  local mu = 0.1 * k + 0.013
  for _, h in ipairs(heights) do
    local limit = math.min(mu, 1 / h)
    local at = common.boundary(0.01, 10, function(t) return solvable(h, mu, t) end, 1e-12)
    worst = math.max(worst, math.abs(at / limit - 1))
    series[h]:add(mu, limit)
    found:add(mu, at)
  end
  for twentieth = 1, 29, 2 do
    local t = twentieth / 20
    local low, high = solvable(1, mu, t), solvable(2, mu, t)
    assert(low or not high)
    map:add(high and "both carried" or low and "low block alone" or "neither", mu, t)
  end
end
print(("verdicts: limit within %.1e of min(μ, 1/h)"):format(worst))

-- 2. Solving near it.
local wrong, refused, worst_force, most = 0, 0, 0, 0
print "inside by   sliding (h = 1, μ = 0.3)                            tipping (h = 2, μ = 1)"
for _, sign in ipairs{ -1, 1 } do
  for power = -1, -13, -1 do
    local line = ("%8.0e "):format(-sign * 10.0^power)
    for _, case in ipairs{ { 1, 0.3, 0.3 }, { 2, 1, 0.5 } } do
      local h, mu, limit = table.unpack(case)
      local t = limit * (1 + sign * 10.0^power)
      local scene, contact = block(h, mu, t)
      local ok, s = pcall(dotyk.solve, scene)
      if not ok then
        refused = refused + 1
        if sign < 0 and power > -12 then wrong = wrong + 1 end
        line = line .. ("  %-52s"):format("refused: " .. s:match "[^:]*$":sub(1, 42))
      else
        local c = s:contact(contact)
        local moment, carrying = 0, 0
        for _, node in ipairs(c.nodes) do
          moment, carrying = moment + node.force * node.x, carrying + (node.status ~= "open" and 1 or 0)
        end
        -- about (0, 0): the weight acts at (1/2, h/2)
        local off = math.max(math.abs(c.force[2] / h - 1), math.abs(c.force[1] / (t * h) + 1), math.abs(moment - h * (1 + t * h) / 2))
        if s.converged then
          worst_force, most = math.max(worst_force, off), math.max(most, s.iterations)
          if sign > 0 and power > -9 or off > 1e-6 then wrong = wrong + 1 end
        end
        line = line .. ("  %2d iterations, %2d nodes carry, off %.0e%-13s"):format(s.iterations, carrying, off, s.converged and "" or ", not conv.")
      end
    end
    print(line)
  end
end
series[#series + 1] = found
dotyk.chart{ file = "images/stability_load_limit.png", x = "coefficient of friction μ", y = "horizontal load / weight", map = map:cells(), series = series }
print "images/stability_load_limit.png"
common.verdict(worst < 1e-8 and wrong == 0 and worst_force < 1e-8, ("the verdict turns at min(μ, 1/h) within %.0e; inside the limit, as near as 1e-13, the solver ends in %d iterations at most with the resultant "
  .. "right to %.0e; beyond it, from 1e-9 on, dotyk names the motion and the turn of the load that would help"):format(worst, most, worst_force))
