-- Tutorial 4: is the mesh fine enough? Error estimate and adaptive meshes.
--
--   ./dotyk scripts/tutorial/04_fine_enough.lua

local function scene_of(mesh)
  local block <const> = dotyk.body{ name = "block", mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 } }
  block:part"bottom":fix()
  local scene <const> = dotyk.scene{ block }
  local punch <const> = dotyk.rigid.gap{ normal = { 0, 1 }, gap = function(x) return math.abs(x) < 0.5 and -0.02 or 1 end } -- flat, with sharp edges
  return scene, scene:contact{ block:part"top", rigid = punch }
end

-- 1. The same scene on finer and finer meshes. The estimate needs no exact solution.
print "cells a side  unknowns  estimated error"
local first <const>, last <const> = {}, {}
for _, n in ipairs{ 16, 32, 64 } do
  local s <const> = dotyk.solve((scene_of(dotyk.mesh.rectangle{ from = { -1, -1 }, to = { 1, 0 }, cells = { 2 * n, n } })))
  local relative <const> = s:error_estimate()
  print(("%12d %9d %15.1f %%"):format(n, s.unknowns, 100 * relative))
  if not first.error then first.error, first.unknowns = relative, s.unknowns end
  last.error, last.unknowns = relative, s.unknowns
end

-- 2. Cells only where they are needed: at the punch's edges.
local s <const>, history <const> = dotyk.adapt{ tol = last.error, scene = scene_of,
  mesh = dotyk.mesh.rectangle{ from = { -1, -1 }, to = { 1, 0 }, cells = { 16, 8 } } }
print(("adapted: %d unknowns for %.1f %%, after %d rounds (%s)"):format(s.unknowns, 100 * history[#history].estimate, #history, history.reason))
assert(history.converged and s.unknowns < last.unknowns / 2)
print("wrote", s:render{ file = "images/tutorial_04.png", field = "error", edges = true, title = "A flat punch: cells where they are needed" })
