-- Stability atlas: locking of displacement elements as Poisson's ratio goes to 1/2.
--
--   ./dotyk scripts/studies/stability/locking.lua [FINEST]
--
-- Two concentric rings in frictionless contact at r = 2, 1 < r < 3, plane strain, pressed from inside: by Lamé σ_r =
-- A − B/r², u_r = (1 + ν)/E ((1 − 2ν) A r + B/r), A = 1/8, B = 9/8, for every ν. Elements that cannot stretch without
-- a change of volume store the energy of a false one, a part C h²/(1 − 2ν) of that of the true strain: then the
-- displacement is 1/(1 + C h²/(1 − 2ν)) of the true one, half of it is lost at 1 − 2ν = C h². For Q1 the place of one
-- half is found by bisection on each mesh and compared with the law, its exponent with 2; P1 on diagonals keeps a
-- third by those fields that its triangles leave free, and the wrong pressure.
-- Draws images/stability_locking.png.

local finest <const> = tonumber(arg[1]) or 32
local common <const>, fit <const> = include "../../lib/common.lua", include "../../lib/least_squares.lua"

-- 1. A quarter of the rings, in the plane or as a slice of tubes between two planes; what is lost of the displacement at
-- the inner edge, and of the contact pressure.
local function rings(element, n, incompressibility, in_space)
  local nu = (1 - incompressibility) / 2
  local function ring(name, from, to)
    local function bend(u, v, ...)
      local r, t = from + (to - from) * u, v * math.pi / 2
      if in_space then return r * math.cos(t), r * math.sin(t), ... end
      return r * math.cos(t), r * math.sin(t)
    end
    local mesh = in_space and dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 4 / n}, cells = {n // 2, n, 2}, element = element }
      or dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n // 2, n}, element = element }
    return dotyk.body{ name = name, material = dotyk.material{ E = 1, nu = nu }, mesh = mesh:transform(bend) }
  end
  local inner, outer = ring("inner", 1, 2), ring("outer", 2, 3)
  for _, body in ipairs{ inner, outer } do
    body:part(in_space and "front" or "bottom"):fix "y"
    body:part(in_space and "back" or "top"):fix "x"
    if in_space then for _, side in ipairs{ "bottom", "top" } do body:part(side):fix "z" end end
  end
  inner:part"left":pressure(1)
  local scene = dotyk.scene{ inner, outer }
  local contact = scene:contact{ inner:part"right", outer:part"left" }
  local s = dotyk.solve(scene)
  local exact, pressure = (1 + nu) * (incompressibility / 8 + 9 / 8), 9 / 32 - 1 / 8
  local worst = 0
  for _, node in ipairs(s:contact(contact).nodes) do worst = math.max(worst, math.abs(node.pressure / pressure - 1)) end
  return s, 1 - (in_space and s:displacement(inner, 1, 0, 0) or s:displacement(inner, 1, 0)) / exact, worst
end

-- 2. The sweep over 1 − 2ν.
local series, refused, wrong, told = {}, 0, 0, math.huge
print "         1 − 2ν   loss of displacement   error of pressure   dotyk's estimate"
local in_plane, bricks_apart = {}, 0
for _, case in ipairs{ { "P1" }, { "Q1" }, { "P1", true }, { "Q1", true } } do
  local element, in_space = table.unpack(case)
  for n = in_space and 16 or 8, in_space and 16 or finest do
    if n & (n - 1) == 0 then
      local curve = common.curve(("%s, %d%s"):format(element, n, in_space and ", space" or ""), { twin = element == "Q1" and not in_space or nil })
      for half = 0, 24 do
        local s, loss, worst = rings(element, n, 0.999 * 10^(-half / 2), in_space)
        if element == "Q1" and n == 16 then
          if in_space then bricks_apart = math.max(bricks_apart, math.abs(loss / in_plane[half] - 1)) else in_plane[half] = loss end
        end
        if s.converged then
          curve:add(0.999 * 10^(-half / 2), math.abs(loss))
          if common.residual(s) > 1e-6 then wrong = wrong + 1 end
        else refused = refused + 1 end
        if element == "Q1" and loss > 0.9 and s.converged then told = math.min(told, (s:error_estimate())) end
        if half % 4 == 0 and (n == finest or n == 8 or in_space) then
          print(("%s%s %3d   %5.0e   %20.4f   %17.4f   %16s  %s"):format(element, in_space and " in space" or "", n, 10^(-half / 2), loss, worst,
            s.converged and ("%.4f"):format((s:error_estimate())) or "-", s.converged and "" or s.reason:match "^[^:]*"))
        end
      end
      if element == "P1" then series[#series + 1] = curve
      elseif not in_space then table.insert(series, 2 * math.tointeger(math.log(n // 8, 2)) + 2, curve) end -- bricks: as quadrilaterals
    end
  end
end

-- 3. The place of one half for Q1, on each mesh, and by the law from the loss at 1 − 2ν = 0.01, where little is lost.
local places, widths, worst = {}, {}, 0
local found, theory = common.curve("half lost", { style = "points" }), common.curve("theory, Q1", { reference = true })
print "\n   n   half is lost at 1 − 2ν =   by the law   off [%]"
for n = 8, finest do
  if n & (n - 1) == 0 then
    local function lost(e)
      local _, loss = rings("Q1", n, e)
      return loss / (1 - loss)
    end
    local at = 1 / common.boundary(1, 1e6, function(inverse) return lost(1 / inverse) < 1 end, 1e-3)
    local law = lost(1e-2) * 1e-2
    places[#places + 1], widths[#widths + 1] = at, 1 / n
    worst = math.max(worst, math.abs(at / law - 1))
    print(("%4d   %24.3e   %10.3e   %7.2f"):format(n, at, law, 100 * (at / law - 1)))
    found:add(at, 0.5)
    if n == finest then for k = 0, 48 do theory:add(10^(-k / 4), law / (10^(-k / 4) + law)) end end
  end
end
local order <const> = fit.order(widths, places)
series[#series + 1], series[#series + 2] = theory, found
dotyk.chart{ file = "images/stability_locking.png", title = "Locking of rings of 8, 16 and 32 cells", log = "xy",
  x = "1 − 2ν, ν Poisson's ratio", y = "displacement lost", x_range = { 5e-9, 3 }, y_range = { 1e-4, 2 }, series = series }
print "images/stability_locking.png"
common.verdict(worst < 0.05 and math.abs(order - 2) < 0.1 and refused > 0 and wrong == 0 and told > 0.5 and bricks_apart < 1e-5, ("Q1 loses half of the displacement at 1 − 2ν = C h² (found within %.1f %% of the "
  .. "law, exponent %.2f), bricks as much as quadrilaterals; "
  .. "triangles and tetrahedra lose two thirds and the pressure with it; dotyk has no element that does not lock: its estimate says %.0f %% for Q1, "
  .. "and where rounding spoils P1 it says so"):format(100 * worst, order, 100 * told))
