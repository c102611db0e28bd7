-- Tutorial 10: which shape is best? Derivatives of a contact solution, and optimisation.
--
--   ./dotyk scripts/tutorial/10_shapes.lua

-- A block pressed onto the ground, more at its right end than at its left.
local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
  mesh = dotyk.mesh.rectangle{ from = { -1, 0 }, to = { 1, 1 }, cells = { 32, 16 }, element = "Q1" } }
block:part"top":load(function(x) return 0, -10 - 8 * x end)
block:part"left":fix "x"
block:part"right":fix "x"
local scene <const> = dotyk.scene{ block }
local contact <const> = scene:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }

-- Five control points of a B-spline move the bottom up, at most by 0.02. The greatest pressure is to be least.
local shape <const> = dotyk.shape{ scene = scene, objective = "peak_pressure", exponent = 12,
  moves = { { part = block:part"bottom", control_points = 5, direction = { 0, 1 }, lower = 0, upper = 0.02 } } }

-- method = "slsqp" suits optima inside the bounds, the default "slp" those at bounds.

-- One design, and the exact derivatives of its numbers: dual numbers, which any arithmetic carries on.
local design <const> = shape:design{ 0.002, 0.001, 0.001, 0.001, 0.004 }
local _, uy <const> = design:displacement(block, 0, 1)
print("peak pressure, smoothed:", design.peak_pressure)
print("displacement of the top:", uy)
print("their product:          ", design.peak_pressure * uy)

local best <const> = shape:optimise{ method = "slsqp", on_design = function(k, d) print(("  design %2d: %.4f"):format(k, d.objective)) end }
print(best)
local before <const>, after <const> = shape:design().solution:contact(contact).max_pressure, best.solution:contact(contact).max_pressure
print(("peak pressure %.2f before, %.2f after"):format(before, after))
assert(best.objective < best.history[1].objective and after < before)
print("wrote", best.solution:render{ file = "images/tutorial_10.png", title = "The bottom that evens out the pressure" })
