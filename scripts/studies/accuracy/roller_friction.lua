-- The roller of the NAFEMS contact benchmarks, with friction: a steel cylinder, D = 100, on an aluminium block, 200 x 200, plane
-- strain, 35 kN per mm. The friction force on half of the contact must not depend on which part is named first, nor on
-- which is meshed more finely.
--
--   ./dotyk scripts/studies/accuracy/roller_friction.lua [H] [STEPS]
--
-- H: width of cells in the contact (its half-width is 6.2 mm), twice that of order 2. A coefficient of 10 lets nothing slip: Goodman's
-- closed form, which leaves out what shear does to the pressure (of second order in Dundurs' constant, 0.14). Prints the table; fails
-- where the force differs by more than 2 % between the two orders of naming, or, of cells alike, by more than 5 % + H/4 mm from Goodman's,
-- or by more than 1 % + H/4 mm among elements, halves and wholes. With H = 0.125 and 80 steps (8 minutes) that is 2 %.

local h <const> = tonumber(arg[1]) or 0.4
local steps <const> = tonumber(arg[2]) or 40
local R <const>, F <const>, nu <const> = 50, 35000, 0.3
local E <const> = { roller = 210e3, block = 70e3 }
local fine <const> = 9 -- half-width of the evenly meshed contact

-- 1. Goodman 1962: pressure as Hertz's, no slip while the contact grows. The surfaces' strains by the pressure differ by kappa p; shear
-- grows by kappa E*^2 a/(4 pi R) ln((a + x)/(a - x))/sqrt(a^2 - x^2) with a, in sum over half the contact 2 G kappa E* F/pi^2, G Catalan's constant.
local E_star <const> = 1 / ((1 - nu^2) / E.roller + (1 - nu^2) / E.block)
local kappa <const> = (1 - 2 * nu) * (1 + nu) * (1 / E.block - 1 / E.roller)
local goodman <const> = 2 * 0.915965594177219 * kappa * E_star * F / math.pi^2

-- 2. Meshes: even cells of width h up to `fine`, growing from there to the length L.
local function grading(cell, L)
  local n, m = math.floor(fine / cell + 0.5), 0
  cell = fine / n
  local function reach(q, k) return fine + cell * q * (q^k - 1) / (q - 1) end
  repeat m = m + 1 until reach(1.3, m) >= L
  local low, high = 1 + 1e-9, 1.3
  for _ = 1, 60 do
    local q = (low + high) / 2
    if reach(q, m) < L then low = q else high = q end
  end
  local function at(s)
    local k = s * (n + m)
    return (k <= n and k * cell or reach(low, k - n)) / L
  end
  return at, n + m
end
local function mesh(element, half, cell, from, to, sign)
  local x, nx = grading(cell, to[1])
  local y, ny = grading(cell, math.abs(to[2] - from[2]))
  local function down(s) return 1 - y(1 - s) end
  local function both(s) return s < 0.5 and 0.5 - x(1 - 2 * s) / 2 or 0.5 + x(2 * s - 1) / 2 end
  return dotyk.mesh.rectangle{ from = { half and 0 or from[1], from[2] }, to = to, cells = { half and nx or 2 * nx, ny }, element = element,
                               grading = { x = half and x or both, y = sign > 0 and y or down } }
end

-- 3. The scene: half or all of the lower half of the roller, its arc up to one radian, pressed down evenly.
local function scene(o)
  local upper = mesh(o.element, o.half, o.h[1], { -R, 0 }, { R, R }, 1)
  upper:transform(function(x, y) return R * math.sin(x / R), y + (R - R * math.cos(x / R)) * (1 - y / R) end)
  local roller = dotyk.body{ name = "roller", mesh = upper, material = dotyk.material{ E = E.roller, nu = nu } }
  local block = dotyk.body{ name = "block", mesh = mesh(o.element, o.half, o.h[2], { -100, -200 }, { 100, 0 }, -1), material = dotyk.material{ E = E.block, nu = nu } }
  roller:part"top":load{ 0, -F / (2 * R * math.sin(1)) }
  block:part"bottom":fix()
  if o.half then
    roller:part"left":fix "x"
    block:part"left":fix "x"
  end
  local function near(x, y, _, ny) return math.abs(x) < fine and math.abs(ny) > 0.5 and math.abs(y) < 2 end
  local parts = { roller:part("near", near), block:part("near", near) }
  if o.block_first then parts[1], parts[2] = parts[2], parts[1] end
  local all = dotyk.scene{ roller, block }
  parts.friction = dotyk.friction.coulomb(o.mu)
  return all, all:contact(parts)
end
local function solve(o)
  local all, contact = scene(o)
  local list = {}
  for k = 1, o.steps do list[k] = { load = k / o.steps } end
  local s = dotyk.solve(all, { steps = list, method = o.method })
  local sum = 0
  for _, node in ipairs(s:contact(contact).nodes) do
    local shear = type(node.shear) == "table" and node.shear[1] or node.shear
    if node.x > 1e-9 then sum = sum + shear * node.weight end
  end
  return math.abs(sum), s
end

-- 4. The table.
print(("roller on a block, %d load steps, cells of %g mm: friction force on half of the contact [N/mm]; Goodman, no slip: %.0f"):format(steps, h, goodman))
print "           h roller h block     mu = 10: roller first  block first      mu = 0.1: roller first  block first"
local worst, off = 0, 0
local ranges <const> = { { math.huge, 0 }, { math.huge, 0 } } -- of forces by coefficient, cells alike to a quarter
local function row(element, half, h1, h2)
  local found = {}
  for _, mu in ipairs{ 10, 0.1 } do
    for _, block_first in ipairs{ false, true } do
      local force, s = solve{ element = element, half = half, h = { h1, h2 }, mu = mu, block_first = block_first, steps = steps }
      assert(s.converged, s.reason)
      found[#found + 1] = force
    end
  end
  for k = 1, 3, 2 do worst = math.max(worst, math.abs(found[k] / found[k + 1] - 1)) end
  if math.abs(math.log(h1 / h2)) < 0.25 then
    for k = 1, 4 do
      local range = ranges[(k + 1) // 2]
      range[1], range[2] = math.min(range[1], found[k]), math.max(range[2], found[k])
    end
  end
  if h1 == h2 then off = math.max(off, math.abs(found[1] / goodman - 1), math.abs(found[2] / goodman - 1)) end
  print(("%-3s %-5s %7.3g  %7.3g  %20.1f %12.1f %28.1f %12.1f"):format(element, half and "half" or "whole", h1, h2, table.unpack(found)))
end
for _, element in ipairs{ "P1", "Q1", "P2", "Q2" } do
  local second = element:sub(2) == "2"
  local w = second and 2 * h or h
  for _, half in ipairs{ true, false } do
    for _, ratio in ipairs(half and { 1 / 3, 0.8, 1, 1.25, 3 } or { 1.25 }) do
      row(element, half, ratio > 1 and w * ratio or w, ratio < 1 and w / ratio or w)
    end
  end
end
local spread <const> = { ranges[1][2] / ranges[1][1] - 1, ranges[2][2] / ranges[2][1] - 1 }
print(("greatest difference between the orders of naming %.2f %%, of cells alike from Goodman %.2f %%, among elements, halves and wholes %.2f and %.2f %%"):format(
  100 * worst, 100 * off, 100 * spread[1], 100 * spread[2]))
assert(worst < 0.02, "friction depends on which part is named first")
assert(off < 0.05 + 0.25 * h, "without slip, friction is not Goodman's")
assert(math.max(spread[1], spread[2]) < 0.01 + 0.25 * h, "friction depends on the element, or on whether half is solved")
