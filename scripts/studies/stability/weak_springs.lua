-- Stability atlas: subdomains and bodies that nearly float.
--
--   ./dotyk scripts/studies/stability/weak_springs.lua [CELLS]
--
-- A block, E = 1, on a fixed one, in contact without friction; across, nothing holds it but springs of k per length
-- on its top, k from 1 to 1e-16, while a load pulls across by 1e-3 k: it moves by 1e-3 for every k, and the contact
-- carries the pressure 0.1. In a factor a pivot is of the size of k, known to rounding ε of the stiffness: the motion
-- is lost in proportion to ε/k, while residuals beside all forces, blind to a force of 1e-3 k, stay small. Springs that
-- hold hardly more than rounding are therefore rows: the motion is an unknown of its own, held by a compliance 1/k. pdas,
-- which ends exactly, then loses nothing, nor does FETI with all springs as rows. newton ends at a tolerance of all
-- forces, active_set adds springs to the stiffness again: what they leave of the equilibrium across is much beside 1e-3 k,
-- so that the body is moved to where the springs balance it. FETI with springs in the stiffness, with 1 and 4 subdomains
-- a body, is beside them.
-- Draws images/stability_weak_springs.png.

local n <const> = tonumber(arg[1]) or 8
local common <const> = include "../../lib/common.lua"
local fit <const> = include "../../lib/least_squares.lua"

local function scene_of(k)
  local function half(name, y)
    return dotyk.body{ name = name, material = dotyk.material{ E = 1, nu = 0 },
      mesh = dotyk.mesh.rectangle{ from = {0, y}, to = {2, y + 1}, cells = {2 * n, n}, element = "Q1" } }
  end
  local lower, upper = half("lower", 0), half("upper", 1)
  lower:part"bottom":fix()
  upper:part"top":spring{ x = k }
  upper:part"top":load{ 1e-3 * k, -0.1 }
  local scene = dotyk.scene{ lower, upper }
  return scene, scene:contact{ upper:part"bottom", lower:part"top" }, upper
end

local methods <const> = {
  { "PDAS", dotyk.solver.pdas{} }, { "Newton", dotyk.solver.newton{} }, { "active set", dotyk.solver.active_set{} },
  { "FETI, rows", dotyk.solver.feti{ supports = "rows" } }, { "FETI, stiffness", dotyk.solver.feti{ supports = "stiffness" } },
  { "FETI, 4 parts", dotyk.solver.feti{ subdomains = {2, 2} } } }
local names, series = {}, {}
for i, m in ipairs(methods) do names[i], series[i] = m[1], common.curve(m[1]) end
local missed, law = common.curve("not converged", { style = "points" }), common.curve("80 ε/k", { reference = true })
local exact <const> = { ["PDAS"] = 0, ["Newton"] = 0, ["active set"] = 0, ["FETI, rows"] = 0 } -- their greatest deviations
local lost <const> = { ["FETI, stiffness"] = true, ["FETI, 4 parts"] = true }
local wrong, missed_at, refused_at, slow = 0, 0, 0, 0
print("deviation of displacement and pressure, iterations; ! not converged\n   k   " .. ("%18s"):rep(#methods):format(table.unpack(names)))
local x, y = {}, {}
for power = 0, -16, -1 do
  local k <const> = 10.0^power
  local line = (" 1e%-4d"):format(power)
  for i, m in ipairs(methods) do
    local scene, contact, upper = scene_of(k)
    local treats, s = pcall(function() return m[2]:solve(scene) end)
    if not treats then
      line, refused_at = line .. ("%18s"):format "refused", math.max(refused_at, k)
      assert(s:find("as good as free", 1, true), s)
    else
      local off = math.abs(s:displacement(upper, 1, 2) / 1e-3 - 1)
      for _, node in ipairs(s:contact(contact).nodes) do off = math.max(off, math.abs(node.pressure / 0.1 - 1)) end
      line = line .. ("%12.0e %4d%1s"):format(off, s.iterations, s.converged and "" or "!")
      series[i]:add(k, math.max(off, 1e-16))
      if s.converged then
        slow = math.max(slow, s.iterations)
        if off > 1e-4 then wrong = wrong + 1 end
      else
        missed:add(k, math.max(off, 1e-16))
        missed_at = math.max(missed_at, k)
        assert(s.reason:find("'upper' is nearly free", 1, true), s.reason)
      end
      if exact[m[1]] then exact[m[1]] = math.max(exact[m[1]], off)
      elseif lost[m[1]] and k <= 1e-2 then x[#x + 1], y[#y + 1] = k, math.max(off, 1e-16) end
    end
  end
  if k > 1e-14 then law:add(k, 80 * 2.0^-52 / k) end
  print(line)
end
series[#series + 1], series[#series + 2] = missed, law
dotyk.chart{ file = "images/stability_weak_springs.png", log = "xy", x = "spring stiffness per length k, E = 1",
             y = "relative error", series = series, size = { 1100, 800 } }
print "images/stability_weak_springs.png"
local slope <const> = fit.order(x, y)
common.verdict(wrong == 0 and exact["PDAS"] < 1e-9 and exact["Newton"] < 1e-9 and exact["active set"] < 1e-9 and exact["FETI, rows"] < 1e-11 and math.abs(slope + 1) < 0.15 and slow <= 10 and missed_at < 1e-6 and refused_at > 0,
  ("in a factor motions are lost as ε/k (slope %.2f): for k > %.0e every method, FETI in %d iterations at most, converges to 1e-4 or better; from there on dotyk says "
  .. "of FETI how much of the motion may be lost, and FETI refuses the body as good as free from %.0e on; as rows springs keep the motion: pdas, newton and active_set to %.0e, FETI to %.0e"):format(
  slope, missed_at, slow, refused_at, math.max(exact["PDAS"], exact["Newton"], exact["active set"]), exact["FETI, rows"]))
