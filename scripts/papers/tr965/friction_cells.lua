-- Cells of friction on a contact line: how many, and which are right? (TR965 (2.13)–(2.16), theorem 2.3)
--
--   ./dotyk scripts/papers/tr965/friction_cells.lua [FINEST]
--
-- On a straight part with m edges the report's friction is constant between the midpoints of edges. It prints these cells for
-- j = 0 … m − 1, but midpoints bound m − 1 of them. The half edges at the two ends are left: cells of their own (m + 1 in all, the
-- default here), joined to the next cells, or without friction ("bare", as printed).
-- 1. A block on a rigid plane with given friction g, its top moved along it: all of the bottom slips, or its middle sticks. Energy and the
--    slip of a corner of the bottom with each choice, and how far they are from their limit (Aitken's of the last three meshes). All have
--    the same limit. "bare" drops the friction of two half edges, g h, an error of first order in the energy; "own" and
--    "joined" are alike where the ends slip.
-- 2. A wedge in a notch: on the broken line each flank has m edges, and the tip two conditions across. With half cells of their own at the
--    tip its two tangential rows are combinations of the normal ones: the inf-sup constant is 0 and forces there depend on the
--    method. Joined to the next cells, as is done there whatever the choice, the kernel is empty.
-- Prints tables, and draws images/papers_friction_cells.png. Meshes have 4 to FINEST edges along the contact.

local finest <const> = tonumber(arg[1]) or 128
local common <const> = include "../../lib/common.lua"
local g <const>, choices <const> = 1, { "own", "joined", "bare" }
local names <const> = { own = "cells of their own", joined = "joined to the next", bare = "no friction there" } -- of the half edges

-- 1. A straight line.
local function block(m, ends, move)
  local body <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 100, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { m, m // 2 } } }
  body:part"top":displace{ x = move, y = -0.02 }
  local scene <const> = dotyk.scene{ body }
  scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }, friction = dotyk.friction.tresca(g),
    multipliers = "P1-P0", friction_ends = ends }
  local s <const> = dotyk.solve(scene)
  assert(s.converged and #s.warnings == 0, s.reason)
  return { m = m, energy = s.energy + s.friction_energy, slip = (s:displacement(body, 2, 0)) }
end
local function aitken(list, what)
  local a <const>, b <const>, c <const> = list[#list - 2][what], list[#list - 1][what], list[#list][what]
  return c - (c - b)^2 / (c - 2 * b + a)
end
local panels, same, farther, order = {}, 0, math.huge, {}
for _, case in ipairs{ { "all of it slips", 0.1 }, { "the middle sticks", 0.02 } } do
  local found <const> = {}
  for _, ends in ipairs(choices) do
    found[ends] = {}
    local m = 4
    while m <= finest do
      table.insert(found[ends], block(m, ends, case[2]))
      m = 2 * m
    end
  end
  local limit <const> = { energy = aitken(found.own, "energy"), slip = aitken(found.own, "slip") }
  same = math.max(same, math.abs(aitken(found.bare, "slip") / limit.slip - 1))
  print(("\n%s: limit of the energy %.5f, of the slip %.6f; deviations in %% of the limit"):format(case[1], limit.energy, limit.slip))
  print "         energy                        slip\nedges      own    joined      bare      own    joined      bare"
  for k in ipairs(found.own) do
    local off <const>, line = {}, ("%5d"):format(found.own[k].m)
    for _, what in ipairs{ "energy", "slip" } do
      for _, ends in ipairs(choices) do
        off[what .. ends] = found[ends][k][what] / limit[what] - 1
        line = line .. ("  %8.3f"):format(100 * off[what .. ends])
      end
    end
    print(line)
    if k > 1 then farther = math.min(farther, math.abs(off.slipbare / off.slipown)) end
  end
  panels[#panels + 1] = { title = case[1]:gsub("^%l", string.upper), log = "xy", x = "edges of the contact line", y = "relative error of the slip", series = {} }
  local n <const> = #found.bare
  order[#order + 1] = math.log((found.own[n - 1].energy - found.bare[n - 1].energy) / (found.own[n].energy - found.bare[n].energy), 2)
  for _, ends in ipairs(choices) do
    local x, y = {}, {}
    for k, f in ipairs(found[ends]) do x[k], y[k] = f.m, math.abs(f.slip / limit.slip - 1) end
    x[#x], y[#y] = nil, nil -- the limit is made from the last
    panels[#panels].series[#panels[#panels].series + 1] = { name = names[ends], x = x, y = y, style = ends == "joined" and "points" or nil }
  end
end

-- 2. A wedge in a notch.
local function fold(n, from, to)
  return dotyk.mesh.rectangle{ from = from, to = to, cells = { 2 * n, n } }:transform(function(x, y) return x, y + math.abs(x) end)
end
print "\na wedge of 2 x n edges: multipliers, kernel of B^T and inf-sup constant\n  n             at the tip kept         joined (as solved)"
local kernels <const> = { kept = math.huge, shared = 0 }
for n = 2, math.min(16, finest // 4), 2 do
  for _, multipliers in ipairs{ "nodal", "P1-P0" } do
    local wedge <const> = dotyk.body{ name = "wedge", material = dotyk.material{ E = 100, nu = 0.3 }, mesh = fold(n, { -1, 0 }, { 1, 1 }) }
    wedge:part"top":fix()
    local notch <const> = dotyk.body{ name = "notch", material = dotyk.material{ E = 100, nu = 0.3 }, mesh = fold(n, { -1, -1 }, { 1, 0 }) }
    notch:part"bottom":fix()
    local scene <const>, line = dotyk.scene{ wedge, notch }, ("%3d  %-6s"):format(n, multipliers)
    local contact <const> = scene:contact{ wedge:part"bottom", notch:part"top", multipliers = multipliers, friction = dotyk.friction.tresca(g) }
    for _, fixed in ipairs{ "kept", "shared" } do
      local found <const> = contact:inf_sup{ part = "both", fixed_nodes = fixed }
      line = line .. ("  %5d  %d  %9.3e"):format(found.multipliers, found.kernel, found.constant)
      kernels[fixed] = (fixed == "kept" and math.min or math.max)(kernels[fixed], found.kernel)
    end
    print(line)
  end
end

print(dotyk.chart{ file = "images/papers_friction_cells.png", columns = 2, size = { 2000, 850 }, title = "Friction on the half edges at the ends", panels = panels })
common.verdict(same < 0.02 and farther > 1.5 and math.abs(order[1] - 1) < 0.1 and kernels.kept == 2 and kernels.shared == 0, (
  "all choices have one limit (to %.1f %%); ends without friction, as printed, are %.1f times and more as far from it, with an energy too low by a term of order %.2f; "
  .. "at a corner within the line only cells joined to the next leave B its rank: kernel %d for 2"):format(100 * same, farther, order[1], kernels.shared))
