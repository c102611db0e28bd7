-- A plate with friction along its edge (P5, variational inequality of the second kind): methods, and what refinement costs.
--
--   ./dotyk scripts/examples/plate_friction.lua [FINEST]
--
-- D = 1, ν = 0.3 on the unit square; the edge does not rotate and bears at most κ = 1 per length, 4 in all, before it slips. Loads of
-- 2.7 (little of it slips), 3.5 and 3.99 (a corner hardly sticks). Shown: that methods of different kinds find one solution,
-- and which do not converge; iterations under refinement with both elements, of the method that dotyk.solve takes bounded;
-- how the solution reaches that of an edge that slips all along. FINEST: cells along a side.
-- Draws images/plate_friction.png and images/plate_friction_iterations.png.
--
-- dotyk.solve begins on a part of the rows, for each of which it solves a small system (counted apart), then iterates on all of
-- them; where active sets return, sweeps or steps of a barrier method come between. First-order methods pay
-- for the condition of the compliance along the edge, which grows with the third power of 1/h.

local law <const> = dotyk.law
local finest <const> = tonumber(arg[1]) or 128
local elements <const>, loads <const> = { "morley", "hct" }, { 2.7, 3.5, 3.99 }

local function plate(n, element, p)
  return dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } }, element = element, nu = 0.3, load = -p,
    edge = { rotation = law.prescribed(), deflection = law.friction(1) } }
end

-- Greatest difference of two deflections over a grid, relative to the greatest deflection.
local function apart(s, t)
  local off, size = 0, 0
  for i = 0, 8 do
    for j = 0, 8 do
      local u <const>, v <const> = s:deflection(i / 8, j / 8), t:deflection(i / 8, j / 8)
      off, size = math.max(off, math.abs(u - v)), math.max(size, math.abs(v))
    end
  end
  return off / size
end

-- 1. Methods.
local names <const> = { "pdas", "newton", "proximal", "projected_cg", "feti", "psor", "uzawa_pdas" }
local function by(name, problem) return dotyk.solver[name]{ max_iterations = 20000 }:solve(problem) end
local coarse <const> = finest // 4
print(("iterations, and how far energy and deflection are from those of pdas; %d cells along a side"):format(coarse))
for _, element in ipairs(elements) do
  for _, p in ipairs(loads) do
    local problem <const>, first, line, agree = plate(coarse, element, p), nil, ("%-6s %.2f"):format(element, p), 0
    for _, name in ipairs(names) do
      local s <const> = by(name, problem)
      first = first or s
      if s.converged then
        local energy <const>, deflection <const> = math.abs(s.energy / first.energy - 1), apart(s, first)
        line = line .. ("  %s %d %.0e %.0e"):format(name, s.iterations, energy, deflection)
        assert(energy < 1e-6 and deflection < 1e-6, name)
        agree = agree + 1
      else
        line = line .. ("  %s %d none"):format(name, s.iterations)
      end
    end
    print(line)
    assert(first.converged and agree >= 5)
  end
end

-- 2. Refinement.
local series <const> = {} -- the most of all loads and both elements
for k, name in ipairs{ "default", "proximal", "Newton", "projected CG" } do series[k] = { name = name, x = {}, y = {} } end
print "\niterations under refinement; of dotyk.solve: on all rows + on parts of them\nelement  load  cells   dotyk.solve   newton  proximal  projected_cg   slips on   middle"
for _, element in ipairs(elements) do
  for _, p in ipairs(loads) do
    local n = 16
    while n <= finest do
      local problem <const> = plate(n, element, p)
      local s <const>, found <const> = dotyk.solve(problem), {}
      for k, name in ipairs{ "newton", "proximal", "projected_cg" } do
        local other <const> = by(name, problem)
        assert(other.converged and math.abs(other.energy / s.energy - 1) < 1e-6, name)
        found[k] = other.iterations
      end
      local slips, length = 0, 0
      for _, point in ipairs(s:reaction "edge".points) do
        length = length + point.length
        if point.status == "slip" then slips = slips + point.length end
      end
      print(("%-7s  %.2f  %5d   %4d + %-4s   %6d  %8d  %12d   %8.3f   %.5f"):format(element, p, n, s.iterations, s.reason:match "(%d+) solves on a part" or 0,
        found[1], found[2], found[3], slips / length, s:deflection(0.5, 0.5)))
      assert(s.converged and s.iterations <= 25)
      for k, count in ipairs{ s.iterations, found[2], found[1], found[3] } do
        local x <const>, y <const> = series[k].x, series[k].y
        local at <const> = math.tointeger(math.log(n / 16, 2)) + 1
        x[at], y[at] = n, math.max(y[at] or 0, count)
      end
      n = 2 * n
    end
  end
end

for _, p in ipairs{ 3, 3.2, 3.3 } do -- a row or two of 768 stick beside each corner
  local n <const> = 3 * finest // 2
  local s <const> = dotyk.solve(plate(n, "morley", p))
  print(("morley   %.2f  %5d   %4d + %-4s"):format(p, n, s.iterations, s.reason:match "(%d+) solves on a part" or 0))
  assert(s.converged and s.iterations <= 25)
end

-- 3. Towards the limit: w = -(x²(1 - x)² + y²(1 - y)²)/12 where all the edge slips (scripts/papers/horak_fibinger/plate_cases.lua).
print "\nload       energy       off the limit's -1/180   middle      off the limit's -1/96"
local before = 1
for power = 1, 5 do
  local s <const> = dotyk.solve(plate(coarse, "hct", 4 - 4 * 10.0^-power))
  local energy <const>, middle <const> = math.abs(s.energy * 180 + 1), math.abs(s:deflection(0.5, 0.5) * 96 + 1)
  print(("%.5f   %.7f   %.1e                 %.7f   %.1e"):format(4 - 4 * 10.0^-power, s.energy, energy, s:deflection(0.5, 0.5), middle))
  assert(middle < before)
  before = middle
end
assert(before < 2 / coarse^2) -- what the mesh leaves

dotyk.chart{ file = "images/plate_friction_iterations.png", title = "Edge friction, most of six cases", x = "cells along a side", y = "iterations", y_range = { 1, 1000 },
  log = "xy", series = series }
dotyk.solve(plate(coarse, "morley", 3)):render{ file = "images/plate_friction.png", view = "plan", title = "Edge friction: loaded by 3 of 4" }
print "images/plate_friction.png, images/plate_friction_iterations.png"
