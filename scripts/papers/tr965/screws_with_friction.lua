-- Free bodies with given friction, held by magnetic screws: TR965, sections 2.2 and 3.2, (3.32)–(3.33), remark 3.5.
--
--   ./dotyk scripts/papers/tr965/screws_with_friction.lua [CELLS]
--
-- Contact nodes taken as closed hold the motions across the contact. Along a planar contact the report asks for p(v) = ∫ g [v_t]₁ = 0 on
-- one cell of friction Δ₀: the cell sticks in direction 1. So many rows are held as there are motions, and their multipliers, two of M
-- and one of Λ in the report's scene, follow from equilibrium (remark 3.5); the alternating algorithm or Newton's method
-- then works on a problem without motions. The state is a solution where the screws press and the cell bears no more than
-- its bound. Else the program moves them: the report takes "a suitably chosen" Δ₀.
-- 1. Bodies in the plane and in space, the screws chosen, and placed wrong on purpose (the first that hold): forces against those of the
--    exact kernel, which has the motions as unknowns of its own.
-- 2. The bound on V₂² of section 2.2: a block that only slides along its contact is held for V < ∫ g, with friction on all of it. Beyond
--    the load is refused; near it all but one cell slip, and screws move until they find a cell that sticks.
-- 3. Does it end in space? Free cubes of 3³ cells and more on a plane, three loads, nodal and P1-P0 multipliers. With the exact kernel both methods
--    solve all. Newton's method with screws solves all with nodal multipliers. With screws the alternating algorithm does not always end: on 5³ cells
--    and more, nodal, its residual stops falling. With P1-P0 on coarse meshes (four cells of friction on 3³ and 4³) often no placement is right, for
--    Newton's method neither: where one cell alone sticks, its two components hold two of the three motions along the plane.
-- CELLS: along bodies in the plane; the cubes of 3 have up to CELLS/2 + 1. Prints tables and draws images/papers_screws_with_friction.png.

local n <const> = tonumber(arg[1]) or 8
local scenes <const>, common <const> = include "../../lib/friction.lua", include "../../lib/common.lua"
local given <const> = dotyk.friction.tresca

-- 1. The cases.
local function cube(held, multipliers, cells, load)
  local body <const> = dotyk.body{ name = "cube", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { cells, cells, cells } } }
  if held then body:part"front":slide() end
  body:part"top":load(load)
  local scene <const> = dotyk.scene{ body }
  return scene, scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0, 0 }, normal = { 0, 0, 1 } }, friction = given(1), multipliers = multipliers }
end
local cases <const> = {
  { "plane, a free block", function() return scenes.blocks(n, given(2.5)) end },
  { "plane, the same, P1-P0", function() return scenes.blocks(n, given(2.5), nil, "P1-P0") end },
  { "plane, lifted at one end", function() return scenes.lifted(n, given(2.5)) end },
  { "space, front slides", function() return cube(true, "P1-P0", n // 2, { 0.6, 0, -3 }) end },
  { "space, a free cube, 4³", function() return cube(false, "nodal", 4, { 0.4, 0.3, -3 }) end }, -- whatever CELLS: see 3
}
print "case                       method      kernel         motions  moves  iterations  regularity  forces off"
local worst, most = 0, 0
for _, case in ipairs(cases) do
  local scene <const>, contact <const> = case[2]()
  local exact <const> = dotyk.solver.newton{ tol = 1e-12 }:solve(scene)
  local forces <const>, size = exact:contact(contact).nodes, 0
  for _, node in ipairs(forces) do size = math.max(size, math.abs(node.pressure)) end
  print(("%-26s %-11s %-20s"):format(case[1], "newton", "exact") .. ("%18d"):format(exact.iterations))
  assert(exact.converged, exact.reason)
  for _, name in ipairs{ "newton", "uzawa_pdas" } do
    local chosen = nil
    for _, place in ipairs{ "screws", "placed wrong" } do
      local rows = nil
      if place == "placed wrong" then -- the chosen ones, the first of them moved to the node at the end where least presses
        rows = table.move(chosen, 1, #chosen, 1, {})
        local least, at = math.huge, 1
        for k, node in ipairs(forces) do
          if node.pressure < least and math.tointeger(k) then least, at = node.pressure, k end
        end
        local taken = false
        for _, r in ipairs(rows) do taken = taken or r == at end
        if not taken then rows[1] = at end
      end
      local s <const> = dotyk.solver[name]{ tol = 1e-12, max_iterations = 20000, kernel = "screws", screws = rows }:solve(scene)
      assert(s.converged, s.reason)
      chosen = chosen or s.screws[1].rows
      local off = 0
      for k, node in ipairs(s:contact(contact).nodes) do
        off = math.max(off, math.abs(node.pressure - forces[k].pressure) / size)
        for i = 1, #node.shear do off = math.max(off, math.abs(node.shear[i] - forces[k].shear[i]) / size) end
      end
      worst, most = math.max(worst, off), math.max(most, s.screw_moves)
      print(("%-26s %-11s %-15s %5d  %5d  %10s  %10.2g  %9.0e"):format("", name, place, #s.screws[1].rows, s.screw_moves,
        s.reason:match "(%d+) iterations of" or "?", s.screws[#s.screws].regularity, off))
    end
  end
end

-- 2. The bound on V₂².
print "\na block that slides along its contact alone, g = 1 on a length of 2: iterations, moves, nodes that stick"
local x, slips = {}, {}
local function sliding(share)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 2 * n, n } } }
  block:part"top":load{ share, -3 }
  local scene <const> = dotyk.scene{ block }
  return scene, scene:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }, friction = given(1), multipliers = "P1-P0" }, block
end
for _, share in ipairs{ 0.5, 0.8, 0.9, 0.95, 0.98, 0.99, 0.999 } do
  local scene <const>, contact <const>, block <const> = sliding(share)
  assert(scene:balance().solvable)
  local exact <const> = dotyk.solver.newton{ tol = 1e-12 }:solve(scene)
  local s <const> = dotyk.solver.newton{ tol = 1e-12, kernel = "screws" }:solve(scene)
  local sticks <const> = exact:contact(contact).stick
  print(("V = %.3f of the bound: exact %2d, screws %3s, moves %2d, %2d stick%s"):format(share, exact.iterations, s.reason:match "(%d+) iterations of", s.screw_moves, sticks,
    s.converged and "" or ": " .. s.reason:match "^[^;]*"))
  assert(exact.converged and (s.converged or sticks < 2))
  if s.converged then assert(math.abs(s:distance(exact).displacement) < 1e-8) end
  x[#x + 1], slips[#slips + 1] = share, 1000 * (exact:displacement(block, 2, 0))
end
for _, share in ipairs{ 1.001, 1.1 } do
  local scene <const> = sliding(share)
  for _, kernel in ipairs{ "exact", "screws" } do
    local solved <const>, why = pcall(function() return dotyk.solver.newton{ kernel = kernel }:solve(scene) end)
    assert(not solved and tostring(why):find("not held", 1, true), why)
  end
end
print "beyond the bound both kernels refuse it"
print(dotyk.chart{ file = "images/papers_screws_with_friction.png", x = "horizontal load V / its bound", y = "slip of the right corner · 10³", series = { { x = x, y = slips } } })

-- 3. Free cubes.
print "\nfree cubes: placements tried, iterations in all; – where it does not end\ncells  multipliers  load            kernel = \"exact\": newton  uzawa_pdas    \"screws\": newton      uzawa_pdas  corner cells that stick"
local ended <const>, tried = {}, 0
for cells = 3, n // 2 + 1 do
  for _, multipliers in ipairs{ "nodal", "P1-P0" } do
    for _, load in ipairs{ { 0.3, 0.2, -3 }, { 0.3, 0, -3 }, { 0.6, 0.1, -3 } } do
      local scene <const>, contact <const> = cube(false, multipliers, cells, load)
      local exact <const> = dotyk.solver.newton{ tol = 1e-12 }:solve(scene)
      local other <const> = dotyk.solver.uzawa_pdas{ tol = 1e-12, max_iterations = 20000 }:solve(scene)
      assert(exact.converged and other.converged and common.apart(other, exact, contact) < 1e-8, exact.reason .. other.reason)
      local sticks = 0 -- of the cells at the four corners: all there are on 3³ and 4³
      for _, node in ipairs(exact:contact(contact).nodes) do
        if math.abs(node.x - 0.5) > 0.499 and math.abs(node.y - 0.5) > 0.499 and node.shear[1]^2 + node.shear[2]^2 < 1 - 1e-6 then sticks = sticks + 1 end
      end
      local line, key = ("%3d    %-11s  %-23s %14d  %10d         "):format(cells, multipliers, ("%g, %g, %g"):format(table.unpack(load)), exact.iterations, other.iterations), nil
      for _, name in ipairs{ "newton", "uzawa_pdas" } do
        local s <const> = dotyk.solver[name]{ tol = 1e-12, max_iterations = 20000, kernel = "screws" }:solve(scene)
        key = name .. ", " .. multipliers
        ended[key] = (ended[key] or 0) + (s.converged and 1 or 0)
        if name == "newton" and multipliers == "P1-P0" and cells < 5 then assert(s.converged == (sticks > 1), "newton with screws ends where two cells stick") end
        if s.converged then worst = math.max(worst, common.apart(s, exact, contact)) end
        line = line .. ("%15s"):format(s.converged and ("%d, %s"):format(s.iterations, s.reason:match "(%d+) iterations of" or "?") or "–")
      end
      tried = tried + 1
      print(line .. (multipliers == "P1-P0" and ("%16d"):format(sticks) or ""))
    end
  end
end
local of <const> = tried // 2 -- of each kind of multipliers
assert(ended["newton, nodal"] == of, "Newton's method with nodal multipliers ends")
local summary <const> = ("free cubes with screws: newton solves %d of %d (nodal) and %d (P1-P0), uzawa_pdas %d and %d; with the exact kernel both solve all"):format(ended["newton, nodal"], of,
  ended["newton, P1-P0"], ended["uzawa_pdas, nodal"], ended["uzawa_pdas, P1-P0"])
common.verdict(worst < 1e-8, ("%s; where screws end, chosen or placed wrong, after %d moves at most in 1, it is at the forces of the exact kernel, to %.0e of the greatest pressure"):format(
  summary, most, worst))
