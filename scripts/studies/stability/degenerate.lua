-- Stability atlas: touching without force.
--
--   ./dotyk scripts/studies/stability/degenerate.lua [CELLS]
--
-- A column, ν = 0, pulled up by p against a rigid ceiling at the distance (1 + δ) of what it would stretch without
-- it: for δ ≥ 0 there is no force, for δ < 0 it is −δp, at every node alike. At δ = 0 both force and gap are zero
-- everywhere (no strict complementarity), and the sign that active sets are chosen by is rounding. δ goes from −1/2
-- through 0 to 1/2, as near as 5e-19; force and iterations of each method, without friction and (where it can) with
-- Coulomb's, beside the closed form. An interior point, whose forces times gaps are all of the size tol, would be off by
-- √tol there; it goes on beyond tol until forces violate their laws by 1e-8 of them at most, or rounding ends it, which
-- costs it ten steps. Methods that choose a set have no such loss.
-- Draws images/stability_degenerate.png.

local n <const> = tonumber(arg[1]) or 16
local common <const> = include "../../lib/common.lua"
local p <const> = 1

local function column(delta, friction)
  local body = dotyk.body{ name = "column", material = dotyk.material{ E = 7, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, n} } }
  body:part"bottom":fix()
  body:part"top":load{ 0, p }
  local scene = dotyk.scene{ body }
  return scene, scene:contact{ body:part"top", friction = friction, rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = p / 7 * (1 + delta) } }
end

local methods <const> = { "pdas", "active_set", "interior_point", "newton", "projected_cg", "psor", "uzawa", "feti" }
local rubbing <const> = { newton = true, psor = true, uzawa = true }
local worst, inner, sets, wrong, most, unconverged = 0, 0, 0, 0, 0, 0
local pressed, apart = {}, {} -- iterations where δ < 0 and where δ > 0, against |δ|
for k, name in ipairs(methods) do pressed[k], apart[k] = common.curve(common.method(name)), common.curve(common.method(name)) end
local deltas = {}
for power = 0, -18, -1 do deltas[#deltas + 1] = -0.5 * 10.0^power end
deltas[#deltas + 1] = 0
for power = -18, 0 do deltas[#deltas + 1] = 0.5 * 10.0^power end
print("error of the force over p, iterations; ! not converged\n    delta " .. ("%16s"):rep(#methods):format(table.unpack(methods)))
for place, delta in ipairs(deltas) do
  local line = ("%9.0e "):format(delta)
  for k, name in ipairs(methods) do
    local text, off, count = "", 0, 0
    for _, friction in ipairs(rubbing[name] and { false, dotyk.friction.coulomb(0.3) } or { false }) do
      local scene, contact = column(delta, friction or nil)
      local s = dotyk.solver[name]{}:solve(scene)
      local error = 0
      for _, node in ipairs(s:contact(contact).nodes) do error = math.max(error, math.abs(node.pressure / p - math.max(0, -delta))) end
      if s.converged then
        off = math.max(off, error)
        if error > 1e-5 then wrong = wrong + 1 end -- √tol
        if name == "interior_point" then inner = math.max(inner, error)
        elseif name == "active_set" then sets = math.max(sets, error)
        else worst = math.max(worst, error) end
      else
        unconverged, text = unconverged + 1, "!"
      end
      count = math.max(count, s.iterations)
    end
    if name == "pdas" or name == "newton" then most = math.max(most, count) end
    if delta ~= 0 then (delta < 0 and pressed or apart)[k]:add(math.abs(delta), math.max(count, 1)) end
    line = line .. ("%10.0e %4d%1s"):format(off, count, text)
  end
  if place % 3 == 1 or delta == 0 then print(line) end
end
dotyk.chart{ file = "images/stability_degenerate.png", size = { 1000, 1100 }, x = "relative gap |δ|", panels = {
  { title = "Pressed, δ < 0", y = "iterations", log = "xy", series = pressed }, { title = "Apart, δ > 0", y = "iterations", log = "xy", series = apart } } }
print "images/stability_degenerate.png"
common.verdict(wrong == 0 and unconverged == 0 and worst < 1e-8 and most <= 10, ("touching without force costs nobody convergence: active sets settle in %d iterations at most and forces are right to %.0e of p at "
  .. "every δ, active_set's to %.0e, and the interior point's to %.0e, where tol alone would leave √tol = 1e-5"):format(most, worst, sets, inner))
