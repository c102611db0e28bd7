-- Stability atlas: friction multipliers too fine for the displacements.
--
--   ./dotyk scripts/studies/stability/inf_sup.lua [FINEST]
--
-- P1 tetrahedra in space, friction constant on cells of extent H (scripts/papers/tr965/inf_sup.lua has the plane, Q1 and the
-- pressure as well). On single triangles the mean values of a P1 function on n × n squares cut in two: its nodes can
-- be coloured with three colours, each triangle having all of them, so there are two independent functions, constant
-- on each colour, of no mean on any triangle. The means have the rank (n + 1)² − 2, of 2n² triangles (n − 1)²
-- combinations go unnoticed, 2(n − 1)² in two tangents: the kernel in theory. On squares (H = h) there is none, but
-- the checkerboard comes near it, and the inf-sup constant falls like h. From H = 2h on it settles. Map of the
-- constant over n and H/h. Draws images/stability_inf_sup.png.

local finest <const> = tonumber(arg[1]) or 12
local common <const>, fit <const> = include "../../lib/common.lua", include "../../lib/least_squares.lua"

local function constant(n, width)
  local function half(name, z)
    return dotyk.body{ name = name, material = dotyk.material{ E = 1, nu = 0.3 },
      mesh = dotyk.mesh.box{ from = {0, 0, z}, to = {1, 1, z + 0.5}, cells = {n, n, math.max(1, n // 2)} } }
  end
  local lower, upper = half("lower", 0), half("upper", 0.5)
  lower:part"bottom":fix()
  return dotyk.scene{ lower, upper }:contact{ upper:part"bottom", lower:part"top", friction = dotyk.friction.tresca(1),
    multipliers = "P1-P0", friction_size = width / n }:inf_sup{}
end

local sizes, series, wrong, orders, limits = {}, {}, 0, {}, {}
for n = 4, finest, 2 do sizes[#sizes + 1] = n end
print "H/h    constant (kernel) for n = …"
for _, width in ipairs{ 0.5, 1, 1.5, 2, 3 } do
  local curve, line, h, values = common.curve(width == 1 and "H = h" or ("H = %gh"):format(width)), ("%-5g"):format(width), {}, {}
  for _, n in ipairs(sizes) do
    local r = constant(n, width)
    line = line .. ("  %d: %.4f (%d)"):format(n, r.constant, r.kernel)
    if r.kernel ~= (width < 1 and 2 * (n - 1)^2 or 0) then wrong = wrong + 1 end
    if r.kernel == 0 then
      curve:add(1 / n, r.constant)
      h[#h + 1], values[#values + 1] = 1 / n, r.constant
    end
  end
  if #h > 0 then
    orders[width] = fit.order(h, values)
    local _, at_zero = fit.line({ table.unpack(h, #h - 2) }, { table.unpack(values, #h - 2) })
    limits[width] = at_zero
    series[#series + 1] = curve
    line = line .. ("   ~ h^%.2f, at h = 0 by a line %.2f"):format(orders[width], at_zero)
  end
  print(line)
end
local law <const> = common.curve("theory: ~ h", { reference = true })
for _, n in ipairs(sizes) do law:add(1 / n, series[1].y[1] * sizes[1] / n) end
series[#series + 1] = law
dotyk.chart{ file = "images/stability_inf_sup.png", log = "xy", x = "mesh size h (H: size of friction cells)", y = "inf-sup constant of friction", series = series }
print "images/stability_inf_sup.png"
common.verdict(wrong == 0 and math.abs(orders[1] - 1) < 0.1 and math.abs(limits[1]) < 0.05 and limits[2] > 0.5, ("on single triangles 2(n − 1)² multipliers go unnoticed, exactly as the theory counts; on squares "
  .. "(H = h) the constant falls like h^%.2f; from H = 2h, dotyk's default in space, it stays, at %.2f by extrapolation"):format(orders[1], limits[2]))
