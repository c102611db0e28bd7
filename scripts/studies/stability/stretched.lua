-- Stability atlas: stretched and slanted cells.
--
--   ./dotyk scripts/studies/stability/stretched.lua [CELLS]
--
-- 1. A strip, held at its left end, meets at its right end a rigid wedge that presses and turns the whole end face:
--    bending by contact alone, u = (κxy, −κx²/2) for ν = 0. Bilinear cells of length l follow u_x exactly and u_y by
--    chords: the shear κ(x − middle) of each cell is false, and the strip of height H is too stiff by 1 + (l/H)²/2 (E
--    = 2G). Twice too stiff from l/H = √2 on, however many layers there are and whatever the cells' aspect ratio;
--    found by bisection for 1 to 4 layers. P1 triangles, and cells slanted to and fro by an angle, have no such
--    formula and are worse.
-- 2. A punched block with layers of cells as thin as 1/16384 of their width towards the contact: the compliance that
--    the contact sees hardly changes, and neither do iterations and force.
-- Draws images/stability_stretched.png.

local n <const> = tonumber(arg[1]) or 16
local common <const> = include "../../lib/common.lua"

-- 1. Contact moment about the middle of the end face over EIθ/L, with `cells` cells of length l in a strip of height 1.
local wrong, refused = 0, 0
local function bending(element, layers, l, slant)
  local cells <const>, turn <const>, press <const> = 4, 0.01, 0.02 * (1 + l^2) -- pressed so much that no node of the end opens
  local length = cells * l
  local mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {length, 1}, cells = {cells, layers}, element = element }
  if slant then -- inner lines between cells turned by the angle, to and fro
    mesh:transform(function(x, y)
      local k = math.floor(x / l + 0.5)
      return k > 0 and k < cells and x + (k % 2 == 0 and 1 or -1) * (y - 0.5) * math.tan(math.rad(slant)) or x, y
    end)
  end
  local body = dotyk.body{ name = "strip", material = dotyk.material{ E = 1000, nu = 0 }, mesh = mesh }
  body:part"left":fix()
  local scene = dotyk.scene{ body }
  local contact = scene:contact{ body:part"right",
    rigid = dotyk.rigid.gap{ normal = {1, 0}, gap = function(_, y) return -press - turn * (y - 0.5) end } }
  local s = dotyk.solve(scene)
  local moment, force = 0, 0
  for _, node in ipairs(s:contact(contact).nodes) do
    moment, force = moment + node.force * (node.y - 0.5), force + node.force
  end
  -- What is called converged is the discrete solution: the normal force is EH(press)/L in any of them.
  if s.converged then
    if not slant and math.abs(force * length / (1000 * press) - 1) > 1e-6 then wrong = wrong + 1 end
  else refused = refused + 1 end
  return moment / (1000 / 12 * turn / length), s
end
local series, worst, formula = {}, 0, 0
local theory = common.curve("theory: (l/H)²/2", { reference = true })
print "layers   twice too stiff from l/H = (theory √2)"
for _, layers in ipairs{ 1, 2, 4 } do
  local at = common.boundary(0.1, 10, function(l) return bending("Q1", layers, l) < 2 end, 1e-4)
  worst = math.max(worst, math.abs(at / math.sqrt(2) - 1))
  print(("%6d   %.5f"):format(layers, at))
end
for _, case in ipairs{ { "Q1, 1 layer", "Q1", 1 }, { "Q1, 4 layers", "Q1", 4 }, { "P1, 1 layer", "P1", 1 }, { "P1, 4 layers", "P1", 4 } } do
  local curve = common.curve(case[1], { style = case[3] == 1 and "line" or "both" })
  for third = -6, 12 do
    local l = 10^(third / 3)
    local stiff, s = bending(case[2], case[3], l)
    if s.converged then curve:add(l, stiff - 1) end
    if case[2] == "Q1" then formula = math.max(formula, math.abs(stiff / (1 + l^2 / 2) - 1)) end
    if case[3] == 1 and case[2] == "Q1" then theory:add(l, l^2 / 2) end
  end
  series[#series + 1] = curve
end
series[#series + 1] = theory
print "\nslanted by   too stiff by [%], l = H: Q1 of 1 layer    of 4 layers    P1 of 4 layers"
for _, angle in ipairs{ 0, 5, 10, 15, 20, 25 } do
  print(("%8d°   %37.2f    %11.2f    %14.2f"):format(angle, 100 * (bending("Q1", 1, 1, angle) - 1), 100 * (bending("Q1", 4, 1, angle) - 1), 100 * (bending("P1", 4, 1, angle) - 1)))
end
dotyk.chart{ file = "images/stability_stretched.png", log = "xy", x = "cell length / height of the strip, l/H", y = "relative excess stiffness", series = series }

-- 2. Even layers, the last one halved again and again towards the contact.
print "\nwidth / height   pdas   psor   uzawa   projected_cg        force    change [%]   residual"
local first, off, most, counts = nil, 0, 1, {}
for halvings = 0, 14, 2 do
  local even <const>, rows <const> = n // 2, n // 2 + halvings
  local function graded(t)
    local j = math.floor(t * rows + 0.5)
    return j < even and j / even or j == rows and 1 or 1 - 2.0^-(j - even + 1) / even
  end
  local body = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {-1, -1}, to = {1, 0}, cells = {n, rows}, element = "Q1", grading = { y = graded } } }
  body:part"bottom":fix()
  local scene = dotyk.scene{ body }
  local contact = scene:contact{ body:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return x^2 / 4 - 0.02 end } }
  local s = dotyk.solver.pdas{}:solve(scene)
  local line = ("%14d   %4d"):format(2^halvings, s.iterations)
  for _, method in ipairs{ "psor", "uzawa", "projected_cg" } do
    local t = dotyk.solver[method]{}:solve(scene)
    if t.converged and common.apart(t, s, contact) > 1e-6 then wrong = wrong + 1 end
    if not t.converged then refused = refused + 1 end
    counts[method] = counts[method] or t.iterations
    most = math.max(most, t.iterations / counts[method])
    line = line .. ("   %4s"):format(t.converged and t.iterations or "-")
  end
  local force = -s:contact(contact).force[2]
  first = first or force
  off = math.max(off, math.abs(force / first - 1))
  if not s.converged or common.residual(s) > 1e-8 then wrong = wrong + 1 end
  print(("%s    %12.6f   %8.2f    %.0e"):format(line, force, 100 * (force / first - 1), common.residual(s)))
end
print "images/stability_stretched.png"
common.verdict(worst < 0.05 and formula < 1e-3 and wrong == 0 and off < 0.05 and most < 1.5, ("bilinear cells are too stiff in bending by (l/H)²/2, twice from l/H = √2 on (found within %.3f %%), "
  .. "however many layers; dotyk has no element that bends, so strips want cells shorter than they are thick; layers of aspect 16384 along the contact change the force by %.1f %% "
  .. "and iterations by a factor of %.1f at most"):format(100 * worst, 100 * off, most))
