-- Stability atlas: where multigrid loses its speed.
--
--   ./dotyk scripts/studies/stability/multigrid.lua [CELLS]
--
-- A rigid paraboloid on a cube of CELLS³ cells of six tetrahedra. Gauss and Seidel smooth what couples strongly. Errors that couple weakly on the fine mesh
-- and are no functions of the coarser one are left to conjugate gradients, whose iterations grow as the root of the condition:
-- 1. Cells s times as high as wide: coupling along them is s² times weaker, so that iterations grow as s (point smoothers: Trottenberg, Oosterlee and
--    Schüller, Multigrid, 2001, §5.1).
-- 2. ν → ½: displacements without divergence cost μ, all others λ = 2μν/(1 − 2ν), and a sweep tells them not apart: iterations grow as (1 − 2ν)^−½.
-- 3. The default method sees the rate after ten iterations, on a coarser mesh where there is one, and takes factors where these are faster.
-- Draws images/stability_multigrid.png.

local n <const> = tonumber(arg[1]) or 16
local common <const> = include "../../lib/common.lua"

local function cube(cells, nu, height) return include "../../lib/scale_scenes.lua".cube(cells, { nu = nu, height = height, depth = 0.02 / height }) end

-- Iterations of conjugate gradients a linear system, with the last system solved to twelve digits.
local function iterations(nu, height)
  local s <const> = dotyk.solver.multigrid{ nested = false }:solve(cube(n, nu, height))
  assert(s.converged, s.reason)
  return s.multigrid.cg / s.multigrid.newton
end

-- 1. and 2. The exponent between the last two values.
local function exponent(values, counts)
  local k <const> = #values
  return math.log(counts[k] / counts[k - 1]) / math.log(values[k] / values[k - 1])
end
local function map(name, values, of)
  local curve <const> = common.curve()
  local counts <const> = {}
  for k, value in ipairs(values) do
    counts[k] = of(value)
    curve:add(value, counts[k])
    print(("%-24s %8g  %6.1f iterations"):format(name, value, counts[k]))
  end
  return curve, exponent(values, counts)
end
local stretched <const>, by_height <const> = map("height of the cells s", { 1, 2, 4, 8, 16 }, function(s) return iterations(0.3, s) end)
local locking <const>, by_ratio <const> = map("1/(1 − 2ν)", { 2.5, 10, 50, 250, 1000 }, function(r) return iterations(0.5 - 0.5 / r, 1) end)

-- 3.
local method = {}
for _, case in ipairs{ { 0.3, 1 }, { 0.499, 1 }, { 0.3, 16 } } do
  local s <const> = dotyk.solve(cube(n + n // 2, case[1], case[2]))
  assert(s.converged, s.reason)
  method[#method + 1] = s.method
end
print(("The default method on %d³ cells: %s; nu = 0.499: %s; s = 16: %s."):format(n + n // 2, table.unpack(method)))

dotyk.chart{ file = "images/stability_multigrid.png", columns = 2, size = { 2100, 800 }, panels = {
  { title = "Tall cells", x = "height / width of the cells", y = "iterations per linear system", log = "xy", series = { stretched }, slopes = { 1 } },
  { title = "Nearly incompressible", x = "1/(1 − 2ν), ν Poisson's ratio", y = "iterations per linear system", log = "xy", series = { locking }, slopes = { 0.5 } } } }
assert(n < 16 or math.abs(by_height - 1) < 0.25 and math.abs(by_ratio - 0.5) < 0.15, "not as theory says")
print(("Iterations grow as s^%.2f (theory: 1) and as (1 − 2ν)^−%.2f (theory: 0.50)."):format(by_height, by_ratio))
