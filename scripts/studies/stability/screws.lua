-- Stability atlas: magnetic screws on a surface that hardly holds.
--
--   ./dotyk scripts/studies/stability/screws.lua [CELLS]
--
-- A screw is a contact node taken as closed; in space three of them hold the two rotations and the translation which
-- a free body has left here (TR965 1.2.2). Between two blocks a groove, flat but for a part a of its depth: as a → 0
-- the third screw's condition becomes that of the other two, the regularity (least over greatest singular value of
-- the screws' equilibrium) falls in proportion to a, and rounding may take ε over it of the forces. At a = 0 the
-- plane does not notice one motion: two screws and a linear condition (remark 1.6). a from 1 to 1e-16, against the
-- exact kernel. Draws images/stability_screws.png.

local n <const> = tonumber(arg[1]) or 6
local common <const>, fit <const> = include "../../lib/common.lua", include "../../lib/least_squares.lua"

local function bodies(a)
  local function body(name, bottom, E)
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3 },
      mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {n, n, n}, element = "Q1" }:transform(
        function(x, y, z) return x, y, z + bottom + a * math.abs(x - 0.5) * (0.6 + 0.1 * y) end) }
  end
  local lower, upper = body("lower", -1, 200), body("upper", 0, 700)
  lower:part"bottom":fix()
  upper:part"front":slide()
  upper:part"top":load{ 0, 0, -3 }
  upper:part"back":load{ 0, 0, 2 }
  local scene = dotyk.scene{ lower, upper }
  return scene, scene:contact{ upper:part"bottom", lower:part"top" }
end

local names <const> = { [2] = "two screws, one linear condition", [3] = "three screws" }
local regularity, difference = {}, {} -- by the number of screws
for screws, name in pairs(names) do
  regularity[screws], difference[screws] = common.curve(name, { style = "points" }), common.curve(name, { style = "points" })
end
local x, y, wrong, worst, refused, gave_up = {}, {}, 0, 0, {}, 0
print "      a   kernel  screws  regularity   forces apart   ends"
for half = 0, 32 do
  local a = 10.0^(-half / 2)
  local scene, contact = bodies(a)
  local said, exact = pcall(function() return dotyk.solver.pdas{}:solve(scene) end)
  local held, s = pcall(function() return dotyk.solver.pdas{ kernel = "screws" }:solve(scene) end)
  local text = ("%7.0e   %6s"):format(a, said and exact.kernel or "-")
  if not held then
    refused[#refused + 1] = a
    if not s:find("the screws do not hold every rigid motion", 1, true) then wrong = wrong + 1 end
    print(text .. "  refused: " .. s:match "solve: (.*)":sub(1, 90))
  else
    local least, screws = math.huge, 0
    for _, placed in ipairs(s.screws) do least, screws = math.min(least, placed.regularity), #placed.rows end
    regularity[screws]:add(a, least)
    if screws == 3 and a < 2e-3 and a > 2e-7 then x[#x + 1], y[#y + 1] = a, least end
    if common.residual(s) > 1e-8 and s.converged then wrong = wrong + 1 end
    if said and exact.converged and s.converged then
      local apart = common.apart(s, exact, contact)
      worst = math.max(worst, apart)
      difference[screws]:add(a, math.max(apart, 1e-17))
      print(("%s  %6d  %10.1e   %12.1e   %s"):format(text, screws, least, apart, s.reason:sub(1, 60)))
    else
      gave_up = gave_up + 1
      print(("%s  %6d  %10.1e   %12s   exact: %s; screws: %s"):format(text, screws, least, "-", said and exact.reason:sub(1, 60) or "refused", s.reason:sub(1, 40)))
    end
  end
end
local slope <const> = fit.order(x, y)
local no_screws <const> = { name = "refused", x = refused, crossed = true }
dotyk.chart{ file = "images/stability_screws.png", x = "slope a of the groove", size = { 1000, 1000 }, panels = {
  { y = "regularity", log = "xy", strip = "refused", slopes = { 1 }, series = { regularity[3], regularity[2], no_screws } },
  { y = "difference of forces", log = "xy", strip = "refused", y_range = { 1e-16, 1e-10 }, series = { difference[3], difference[2], no_screws } } } }
print "images/stability_screws.png"
common.verdict(math.abs(slope - 1) < 0.05 and worst < 1e-10 and wrong == 0 and #refused <= 4 and gave_up <= 2, ("the screws' regularity falls in proportion to the groove (exponent %.3f), and the forces stay "
  .. "those of the exact kernel to %.0e; at a = %.0e … %.0e dotyk refuses to place three screws, and from there on takes two and a linear condition, unique up to the sliding"):format(
  slope, worst, refused[1] or 0, refused[#refused] or 0))
