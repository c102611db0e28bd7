-- Stability atlas: bodies of very different stiffness.
--
--   ./dotyk scripts/studies/stability/contrast.lua [CELLS]
--
-- Three blocks on each other, each 2 long and 1 high, the left sides and the bottom sliding, pressed from above by p
-- = 1 without friction; E = 1, C, 1 from below, C from 1e-16 to 1e16. Closed form for every C: pressure p in both
-- contacts, the top sinks by p (1 − ν²)(1 + 1/C + 1). A body that another one carries moves as a whole, by w, and its
-- stiffness times that motion cancels but for rounding: Ku is out of equilibrium by about ε E w, ε = 2e-16, of the
-- load p. As this says nothing against displacements and forces, dotyk asks for the forces' resultants instead, and for
-- no more imbalance than that; it says whose stresses suffer, and calls no state converged of whose forces more than a
-- tenth is rounding. The greatest C is found by bisection, and compared with where this proportion, measured at
-- C = 1e4 to 1e7, meets 0.1. Forces of methods on contact rows, where motions are unknowns of their own, do not suffer
-- at all; those of methods on all displacements do, in proportion to the contrast, and are refused where they do.
-- Draws images/stability_contrast.png.

local n <const> = tonumber(arg[1]) or 16
local common <const> = include "../../lib/common.lua"
local nu <const> = 0.3

local function tower(C)
  local blocks = {}
  for k, E in ipairs{ 1, C, 1 } do
    local block = dotyk.body{ name = "block " .. k, material = dotyk.material{ E = E, nu = nu },
      mesh = dotyk.mesh.rectangle{ from = {0, k - 1}, to = {2, k}, cells = {n, n // 2}, element = "Q1" } }
    block:part"left":slide()
    blocks[k] = block
  end
  blocks[1]:part"bottom":slide()
  blocks[3]:part"top":pressure(1)
  local scene = dotyk.scene(blocks)
  local contacts = {}
  for k = 1, 2 do contacts[k] = scene:contact{ blocks[k + 1]:part"bottom", blocks[k]:part"top" } end
  return scene, contacts, blocks[3]
end

local methods <const> = { "pdas", "active_set", "interior_point", "feti", "projected_cg", "psor", "uzawa" }
local series, curves, wrong, most, same = {}, {}, 0, {}, {}
for k, name in ipairs(methods) do
  curves[name] = common.curve(common.method(name))
  series[k], most[name], same[name] = curves[name], 0, true
end
local refused = common.curve("not converged", { style = "points", crossed = true })
local function deviation(s, contacts, top, C) -- of pressures and of the top's displacement from the closed form
  local _, uy = s:displacement(top, 0, 3)
  local error = math.abs(-uy / (1 - nu^2) / (2 + 1 / C) - 1)
  for _, contact in ipairs(contacts) do
    for _, node in ipairs(s:contact(contact).nodes) do error = math.max(error, math.abs(node.pressure - 1)) end
  end
  return error
end
print("iterations and error, ! not converged\n     C   " .. ("%16s"):rep(#methods):format(table.unpack(methods)))
local rows_error, residuals = 0, common.curve("residual", { reference = true, style = "line" })
for power = -16, 16, 2 do
  local C = 10.0^power
  local scene, contacts, top = tower(C)
  local line = ("  1e%+03d  "):format(power)
  for _, name in ipairs(methods) do
    local s = dotyk.solver[name]{ max_iterations = 5000 }:solve(scene)
    local error = deviation(s, contacts, top, C)
    line = line .. ("%5s %9.0e%1s"):format(s.iterations, error, s.converged and "" or "!")
    curves[name]:add(C, math.max(error, 1e-17))
    if not s.converged then refused:add(C, math.max(error, 1e-17)) elseif error > 1e-5 then wrong = wrong + 1 end
    if name == "pdas" or name == "feti" then
      rows_error = math.max(rows_error, error)
      if s.iterations > 6 then wrong = wrong + 1 end
    end
    if name == "pdas" then residuals:add(C, s.residual.equilibrium) end
  end
  print(line)
end
series[#series + 1], series[#series + 2] = refused, residuals

-- The greatest contrast, above and below.
local limit <const> = 0.1
local function most_contrast(sign)
  local function residual(C) return dotyk.solver.pdas{}:solve((tower(C^sign))).residual.equilibrium end
  local sum = 0 -- out of equilibrium by this times C: a geometric mean
  for half = 8, 14 do sum = sum + math.log(residual(10^(half / 2)) / 10^(half / 2)) / 7 end
  local found = common.boundary(1e5, 1e16, function(C) return dotyk.solver.pdas{}:solve((tower(C^sign))).converged end, 0.01)
  return found, limit / math.exp(sum)
end
local worst, least = 0, math.huge
for _, sign in ipairs{ 1, -1 } do
  local found, predicted = most_contrast(sign)
  worst, least = math.max(worst, found / predicted, predicted / found), math.min(least, found)
  print(("C^%+d is solved up to C = %.1e; by the residual at 1e4 to 1e7, in proportion to C, %.1e"):format(sign, found, predicted))
end
series[#series + 1] = common.curve("allowed residual", { reference = true })
for power = -16, 16, 32 do series[#series]:add(10.0^power, limit) end
dotyk.chart{ file = "images/stability_contrast.png", log = "xy", x = "stiffness of the middle block / of the others",
             y = "relative error", series = series, size = { 1100, 800 } }
print "images/stability_contrast.png"
common.verdict(wrong == 0 and worst < 4 and rows_error < 1e-11, ("a nearly rigid or nearly absent body is out of equilibrium by rounding times contrast: solved up to a tenth of it, at a contrast of %.0e (found within a factor of %.1f of the law); the forces of "
  .. "methods on contact rows are right to %.0e at every contrast up to 1e16, those on all displacements lose digits in proportion, and no state that is wrong by 1e-5 is called converged"):format(least, worst, rows_error))
