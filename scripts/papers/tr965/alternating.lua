-- The report's alternating algorithm, as printed, beside the full Newton method that it left open.
--
--   ./dotyk scripts/papers/tr965/alternating.lua [FINEST]
--
-- One iteration of the algorithm (uzawa_pdas) takes two linear problems: contact with friction frozen, friction
-- with contact frozen; before each, a projected step of length rho on what is frozen, and the sets of both from
-- the same rho. Iterations against the mesh with rho at half of Uzawa's bound 2/λ_max, then against rho from 1 to
-- 10^6 (force per displacement; E = 1000), for the two blocks with given and Coulomb friction (T2, C2) and the
-- punch in space: S3T with given friction 5, S3C with Coulomb's, S3P with given friction 1 and the report's own
-- multipliers (friction constant on cells). Draws images/alternating.png.
--
-- What the numbers say.
-- 1. Small rho, in the plane: the sets settle, and from then on rho is without influence. On a row of A the jump
--    is zero, and step 2a changes nothing; on a row that sticks the jump is zero, on one that slips the force is
--    at its bound, and step 1a changes nothing. What remains is exact minimisation in turn over the normal and
--    over the tangential forces, whose contraction is their squared coupling: the count does not depend on the
--    mesh either (part of it is the equilibrium of the free block, an outer augmented Lagrangian).
-- 2. Small rho, in space: the force of a slipping node is not known from its sign, step 2c takes it as
--    π(Λ + rho·x). It turns towards the slip by an Uzawa step in each iteration: of a length rho far below the
--    bound it takes (bound/rho) times as many iterations, and below some rho more than anybody waits for.
-- 3. Large rho: a row that was left out of A and closes in step 1c (x > 0) is pushed by rho·x in step 2a. The
--    pushes together change the jumps by −rho W x. Where that turns x into less than −x, that is from rho = 2/λ_max
--    on (W the compliance of those rows together), the next step 1b sees rho·x + rho·x' < 0 and leaves the same
--    rows out again: the iteration repeats itself at a state that is no solution, or goes round a cycle. With
--    Coulomb's law the pushes are friction bounds as well, and drive each other to infinity. So the bound is
--    Uzawa's: below it (for all rows) all runs in the plane converge, and above it those do whose changing rows are
--    few. λ_max of nodal forces grows with the number of nodes in a patch: the bound falls with refinement, and no fixed rho,
--    the report's 10^3 to 10^4 included, serves all meshes.
-- 4. In space no rho at all need be small enough. In step 2c a point either sticks, whatever force that takes, or
--    keeps a force on its circle: the derivative of π that would turn the force is left out. A force that comes out
--    beyond its bound is cut back by 1a, the slip that 1c then finds makes 2b choose the other set, and stick and
--    slip go round among the same few cells for every rho (S3P on 8³ cells; on 12³ it converges).
-- 5. Newton's method on both parts together takes the exact derivative where the algorithm takes a step: a
--    handful of iterations on every mesh, for every rho of its own, half as many linear problems in each.

local finest <const> = tonumber(arg[1]) or 256
local scenes <const> = include "../../lib/friction.lua"
local most <const> = 3000
local coulomb <const>, given <const> = dotyk.friction.coulomb(0.3), dotyk.friction.tresca(2.5)
local hard <const>, soft <const> = dotyk.friction.tresca(5), dotyk.friction.tresca(1)
local function cells(n, law) return scenes.cube(n, law, "P1-P0") end

local function alternate(scene, rho, unit)
  return dotyk.solver.uzawa_pdas{ rho = rho, unit = unit, max_iterations = most }:solve(scene)
end

local function bound(s) -- 2/λ_max in force per displacement
  return tonumber(s.reason:match "bound 2/λ_max of ([%d%.e+-]+)")
end

-- How it ended, in a word.
local function ending(s)
  if s.converged then return ("%d"):format(s.iterations) end
  if s.reason:find("repeats itself", 1, true) then return "same" end
  if s.reason:find("return every", 1, true) then return "cycle" end
  return s.reason:find("diverge", 1, true) and "grows" or s.reason:find("no convergence", 1, true) and ">" .. most or "stalls"
end

-- 1. Against the mesh.
print("rho at half of Uzawa's bound: iterations\nscene     n   2/λ_max  alternating  Newton")
local newton_most = 0
for _, case in ipairs{ { "T2", scenes.blocks, given, { 16, 32, 64, 128, 256 } }, { "C2", scenes.blocks, coulomb, { 16, 32, 64, 128, 256 } },
                       { "S3T", scenes.cube, hard, { 8, 12 } }, { "S3P", cells, soft, { 8, 12 } }, { "S3C", scenes.cube, coulomb, { 8, 12, 16, 24 } } } do
  local name, build, law, sizes = table.unpack(case)
  for _, n in ipairs(sizes) do
    if n <= finest // (name:find "3" and 10 or 1) or n == sizes[1] then
      local scene = build(n, law)
      local newton, s = dotyk.solver.newton{}:solve(scene), alternate(scene, 0.5, "bound")
      local absolute = bound(dotyk.solver.uzawa_pdas{ rho = 1, unit = "force/displacement", max_iterations = 1 }:solve(scene))
      print(("%-5s %5d  %8.3g  %11s  %6d"):format(name, n, absolute, ending(s), newton.iterations))
      assert(newton.converged and newton.iterations <= 12)
      newton_most = math.max(newton_most, newton.iterations)
    end
  end
end

-- 2. Against rho.
print("\niterations against rho [force/displacement]; same: repeats a state that is no solution; cycle: goes round\n"
  .. "several; grows: without bound; stalls: does not improve; >" .. most .. ": slow")
local rhos, header = {}, "scene     n   2/λ_max"
for half = 0, 12 do
  rhos[#rhos + 1] = 10^(half / 2)
  header = header .. ("%7s"):format(half % 2 == 0 and "1e" .. half // 2 or "")
end
print(header .. "  Newton")
local series = {}
local called <const> = { T2 = "plane, given", C2 = "plane, Coulomb", S3T = "space, given", S3C = "space, Coulomb", S3P = "space, P1-P0" }
local shown <const> = math.min(128, finest)
for _, case in ipairs{ { "T2", scenes.blocks, given, 16 }, { "T2", scenes.blocks, given, shown }, { "C2", scenes.blocks, coulomb, 16 },
                       { "C2", scenes.blocks, coulomb, shown }, { "S3T", scenes.cube, hard, 8 }, { "S3C", scenes.cube, coulomb, 8 }, { "S3P", cells, soft, 8 } } do
  local name, build, law, n = table.unpack(case)
  local scene, line, x, y, lost, limit = build(n, law), "", {}, {}, {}, nil
  for _, rho in ipairs(rhos) do
    local s = alternate(scene, rho, "force/displacement")
    limit = limit or bound(s)
    line = line .. ("%7s"):format(ending(s))
    if s.converged then
      x[#x + 1], y[#y + 1] = rho, s.iterations
    else
      lost[#lost + 1] = rho
    end
  end
  local newton = dotyk.solver.newton{}:solve(scene)
  print(("%-5s %5d  %8.3g%s  %6d"):format(name, n, limit, line, newton.iterations))
  newton_most = math.max(newton_most, newton.iterations)
  series[#series + 1] = { name = ("%s, %d"):format(called[name], n), x = x, y = y }
  if #lost > 0 then series[#series + 1] = { x = lost, twin = true, crossed = true, style = "points" } end
end
series[#series + 1] = { name = ("Newton: at most %d"):format(newton_most), x = { 1, 1e6 }, y = { newton_most, newton_most }, reference = true }

dotyk.chart{ file = "images/alternating.png", size = { 2000, 1000 }, log = "xy",
  title = "Alternating method on 8 to 128 cells", x = "ρ [force/displacement]", y = "iterations", series = series }
print "images/alternating.png"
