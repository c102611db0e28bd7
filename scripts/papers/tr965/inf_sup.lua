-- Are the multipliers of a contact stable against its displacements? The inf-sup constant of TR965 (3.16).
--
--   ./dotyk scripts/papers/tr965/inf_sup.lua [CELLS]
--
-- Two unit blocks on top of each other, the lower one held below. P1-P0 multipliers: pressure continuous and
-- piecewise linear, friction constant on cells of size H. Tables of the constant, as an eigenvalue problem, for
-- friction alone and for friction and pressure together; where it fails; images/inf_sup.png (the constant against
-- h/H) and images/inf_sup_refined.png (against h: what is stable, what is not).

local finest <const> = tonumber(arg[1]) or 16     -- cells along an edge, in space; twice that in the plane
local material <const> = dotyk.material{ E = 1, nu = 0.3 }

-- 1. The contact: P1 triangles and tetrahedra, or Q1.
local function contact(dimension, n, options)
  local function half(name, z)
    local mesh = dimension == 2
      and dotyk.mesh.rectangle{ from = {0, z}, to = {1, z + 1}, cells = {n, n}, element = options.element or "P1" }
      or dotyk.mesh.box{ from = {0, 0, z}, to = {1, 1, z + 1}, cells = {n, n, n}, element = options.element or "P1" }
    return dotyk.body{ name = name, mesh = mesh, material = material }
  end
  local lower, upper = half("lower", 0), half("upper", 1)
  lower:part"bottom":fix()
  if options.clamped then
    for _, body in ipairs{ lower, upper } do
      for _, side in ipairs{ "left", "right" } do body:part(side):fix() end
    end
  end
  return dotyk.scene{ lower, upper }:contact{
    upper:part"bottom", lower:part"top", friction = dotyk.friction.tresca(options.g or 1),
    multipliers = options.multipliers or "P1-P0", friction_size = options.H }
end

-- 2. The constant against h/H.
local curves = {}
local function study(dimension, sizes, widths)
  print(("in %s: constants of friction alone, and with the pressure"):format(dimension == 2 and "the plane" or "space"))
  local head = "    n"
  for _, k in ipairs(widths) do head = head .. ("        H = %dh   "):format(k) end
  print(head)
  for _, n in ipairs(sizes) do
    local line, x, y = ("%5d"):format(n), {}, {}
    for _, k in ipairs(widths) do
      if k <= n // 2 then
        local c = contact(dimension, n, { H = dimension == 3 and k / n or k > 1 and k / n or nil })
        local t, both = c:inf_sup{}, c:inf_sup{ part = "both" }
        line = line .. ("   %.4f  %.4f"):format(t.constant, both.constant)
        x[#x + 1], y[#y + 1] = 1 / k, t.constant
      end
    end
    print(line)
    curves[#curves + 1] = { name = ("%s, h = 1/%d"):format(dimension == 2 and "plane" or "space", n), x = x, y = y }
  end
end
local space <const> = { finest // 4, finest // 2, finest }
local plane <const> = { finest // 2, finest, 2 * finest }
study(2, plane, { 1, 2, 3, 4 })
study(3, space, { 1, 2, 3, 4 })
dotyk.chart{ file = "images/inf_sup.png", x = "mesh size h / cell size H of multipliers", y = "inf-sup constant of friction", series = curves }

-- 3. Refinement: what keeps its constant, and what loses it.
local failing = {}
local function refined(name, dimension, sizes, options, question, shown)
  local x, y, line = {}, {}, ("%-44s"):format(name)
  for _, n in ipairs(sizes) do
    local given = {}
    for key, value in pairs(options) do given[key] = value end
    if options.cells then given.H, given.cells = options.cells / n, nil end
    local r = contact(dimension, n, given):inf_sup(question)
    x[#x + 1], y[#y + 1] = 1 / n, r.constant
    line = line .. ("  %d: %.4f"):format(n, r.constant) .. (r.kernel > 0 and (" (kernel %d)"):format(r.kernel) or "")
  end
  print(line)
  if shown then failing[#failing + 1] = { name = shown, x = x, y = y } end
end
print "under refinement"
local both <const> = { part = "both" }
refined("plane, nodal forces", 2, plane, { multipliers = "nodal" }, both, "plane, nodal")
refined("plane, dual cells", 2, plane, {}, both, "plane, dual")
refined("plane, dual cells, Q1", 2, plane, { element = "Q1" }, both)
refined("space, H = 2h", 3, space, {}, {}, "space, H = 2h")
refined("space, H = 2h, with pressure", 3, space, {}, both, "H = 2h, pressure")
refined("space, H = 2h, Q1", 3, space, { element = "Q1" }, {})
refined("space, H = h: two triangles", 3, space, { cells = 1 }, {}, "space, H = h")
refined("space, H = h, Q1: one quadrilateral", 3, space, { cells = 1, element = "Q1" }, {}, "space, H = h, Q1")
refined("space, single triangles", 3, { space[1], space[2] }, { cells = 0.01 }, {})

-- 4. Ends of the contact held by supports on both sides: multipliers of their own form a kernel.
refined("plane, ends held, cells shared out", 2, plane, { clamped = true }, {})
refined("plane, ends held, cells kept", 2, plane, { clamped = true }, { fixed_nodes = "kept" }, "plane, ends held")
dotyk.chart{ file = "images/inf_sup_refined.png", x = "mesh size h", y = "inf-sup constant", y_range = { -0.06, 1.5 }, log = "x", series = failing }

-- 5. (3.16) as printed asks for the norm of μ_t, not of the shear g μ_t, and of the multipliers of M_hn × M_Ht alone, pressures ≥ 0 (the bound 1 of
--    |μ_t| does not matter: both sides are homogeneous). With g between g₀ and 1 its constant is from g₀ times that of the shear to as great. On
--    the cone the constant is greater, as sums of pressures do not waver; but two solutions, and a solution
--    and its approximation, differ by any μ of the linear space: uniqueness (3.15) and error estimates need that one.
print "friction and pressure: norm of the shear, of the multiplier (g from 0.1 to 1); over pressures alone: all, those not negative"
local function graded(x) return 0.1 + 0.9 * x end
for _, case in ipairs{ { 2, plane[1] }, { 2, plane[2] }, { 3, space[1] } } do
  local c <const> = contact(case[1], case[2], { g = graded })
  local shear <const>, own <const> = c:inf_sup{ part = "both" }.constant, c:inf_sup{ part = "both", norm = "multiplier", cone = true }
  local normal <const> = c:inf_sup{ part = "normal", cone = true }
  print(("%s n = %2d   %.4f  %.4f (on its cone %.4f)     %.4f  %.4f"):format(case[1] == 2 and "plane" or "space", case[2], shear, own.constant, own.cone,
    normal.constant, normal.cone))
  assert(own.constant < 1.001 * shear and own.constant > 0.0999 * shear)
  assert(own.cone > 0.999 * own.constant and normal.cone > normal.constant)
end
print "images/inf_sup.png, images/inf_sup_refined.png"
