-- The rate C h^α of (1.25) in TR965, α = 1 or 3/4 "depending on assumptions": fits of α without and with given friction.
--
--   ./dotyk scripts/papers/tr965/rates.lua [FINEST]
--
-- P1 elements in the plane, cells of side h = 2/n; errors in the energy norm, which is that of H¹ up to a factor (1.18), by
-- integration against closed forms on y > 0, −1 < x < 1, whose lower side meets an obstacle. They are sums of two fields.
-- A smooth one, φ = A(x⁺)³, p = P((−x)⁺)², ψ = s((x − a)⁺)⁴ + U, τ = g for x > a:
--     u_x = ψ − yφ′ + yτ/μ,  u_y = φ − y(p + λψ′)/(λ + 2μ);  so at y = 0  u_y = φ, −σ_yy = p, u_x = ψ, σ_xy = τ.
-- It is closed for x < 0 and open beyond; with friction, g the bound, it sticks for x < a and slips beyond. Without τ = 0.
-- And one under a stamp of the shape |x − b|^γ, γ < 1: with Ψ = Re w^(γ+1)/(γ+1), w = y − i(x − b), which is harmonic,
--     2μu_x = (1 − 2ν)Ψ_x + yΨ_xy,  2μu_y = −2(1 − ν)Ψ_y + yΨ_yy;  at y = 0  σ_xy = 0, −σ_yy = γ cos((1−γ)π/2)|x − b|^(γ−1) > 0.
-- Beyond x = 0, where the body is open, a load takes the place of this pressure. As u ~ r^γ at b, elements cannot have a
-- rate above min(1, γ), and (1.25) needs γ ≥ 3/4 at least: α = 1 for the smooth field, γ for the stamps is expected.
-- Given friction with nodal multipliers, and with the report's P1-P0 pairs (2.15) on cells of extent h and 2h. With the stamps
-- U moves the whole side, which slips. Body forces, tractions at the sides and displacements of the top are the closed form's.
-- Prints tables and draws images/papers_rates.png. FINEST: cells along x of the finest of four meshes.

local finest <const> = tonumber(arg[1]) or 128
local common <const>, fit <const> = include "../../lib/common.lua", include "../../lib/least_squares.lua"
local E <const>, nu <const> = 1000, 0.3
local mu <const>, lambda <const> = E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))
local material <const> = dotyk.material{ E = E, nu = nu }
local cells <const> = {}
for k = 3, 0, -1 do cells[#cells + 1] = finest >> k end
local variants <const> = { { name = "no friction" }, { name = "nodal", friction = true }, { name = "P1-P0, H = h", friction = true, size = 1 },
  { name = "P1-P0, H = 2h", friction = true, size = 2 } }
local A <const>, P <const>, g <const>, b <const> = 0.05, 40, 5, -0.5
local fields <const> = { { name = "smooth", rate = 1, s = 0.02, a = -0.3, U = 0, stamp = 0, gamma = 1 },
  { name = "stamp, γ = 3/4", rate = 3 / 4, s = 0, a = -2, U = 2, stamp = 1000, gamma = 3 / 4 },
  { name = "stamp, γ = 1/2", rate = 1 / 2, s = 0, a = -2, U = 2, stamp = 1000, gamma = 1 / 2 } }

-- The closed forms.
local function plus(c, k, t, d) -- the d-th derivative of c (t⁺)^k
  if t <= 0 then return 0 end
  for i = 0, d - 1 do c = c * (k - i) end
  return c * t^(k - d)
end
local function power(x, y, e) -- w^e, real and imaginary part
  local r, angle = math.sqrt((x - b)^2 + y^2), math.atan(b - x, y)
  return r^e * math.cos(e * angle), r^e * math.sin(e * angle)
end
local function closed_form(field, rubs)
  local C <const>, k <const>, form = field.stamp / (2 * mu), field.gamma, {}
  local function phi(x, d) return plus(A, 3, x, d) end
  local function psi(x, d) return plus(field.s, 4, x - field.a, d) + (d == 0 and field.U or 0) end
  local function q(x, d) return ((-1)^d * plus(P, 2, -x, d) + lambda * psi(x, d + 1)) / (lambda + 2 * mu) end
  local function tau(x, d) -- with stick from −g/2 at x = −1 to g at x = a
    return rubs and (d == 0 and g or 0) - (-1)^d * plus(1.5 * g / math.abs(field.a + 1)^3, 3, field.a - x, d) or 0
  end
  function form.displacement(x, y)
    local u, v = psi(x, 0) - y * phi(x, 1) + y * tau(x, 0) / mu, phi(x, 0) - y * q(x, 0)
    if C == 0 or (x == b and y == 0) then return u, v end
    local f, fi = power(x, y, k)
    local df, dfi = power(x, y, k - 1)
    return u + C * ((1 - 2 * nu) * fi + y * k * dfi), v + C * (-2 * (1 - nu) * f + y * k * df)
  end
  function form.strain(x, y) -- xx, yy, 2xy
    local xx, yy, xy = psi(x, 1) - y * phi(x, 2) + y * tau(x, 1) / mu, -q(x, 0), tau(x, 0) / mu - y * q(x, 1)
    if C == 0 then return xx, yy, xy end
    local d2 = k * power(x, y, k - 1)
    local d3, d3i = power(x, y, k - 2)
    local third = k * (k - 1) * y
    return xx + C * (-(1 - 2 * nu) * d2 - third * d3), yy + C * (-(1 - 2 * nu) * d2 + third * d3), xy + 2 * C * third * d3i
  end
  function form.force(x, y) -- −div σ; none of the stamp
    return -((lambda + 2 * mu) * (psi(x, 2) - y * phi(x, 3) + y * tau(x, 2) / mu) - (lambda + mu) * q(x, 1)),
      -(tau(x, 1) - mu * y * q(x, 2) + lambda * (tau(x, 1) / mu - phi(x, 2)))
  end
  function form.gap(x) return x == b and 0 or C * 2 * (1 - nu) * (power(x, 0, k)) end
  function form.pressure(x) return 2 * mu * C * k * (power(x, 0, k - 1)) end -- of the stamp
  return form
end

-- Error and norm on a mesh.
local function solve(field, n, variant)
  local form <const>, h <const> = closed_form(field, variant.friction), 2 / n
  local body = dotyk.body{ material = material, force = form.force,
    mesh = dotyk.mesh.rectangle{ from = {-1, 0}, to = {1, 1}, cells = {n, n // 2} } }
  for side, name in pairs{ [-1] = "left", [1] = "right" } do
    body:part(name):load(function(x, y)
      local xx, yy, xy = form.strain(x, y)
      return side * ((lambda + 2 * mu) * xx + lambda * yy), side * mu * xy
    end)
  end
  body:part"top":displace{ x = function(x, y) return (form.displacement(x, y)) end, y = function(x, y) return (select(2, form.displacement(x, y))) end }
  if field.stamp > 0 then
    body:part("open", function(x, y) return y < 1e-9 and x > 0 end):load(function(x) return 0, form.pressure(x) end)
  end
  local scene = dotyk.scene{ body }
  local contact = scene:contact{ body:part"bottom", rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = form.gap },
    friction = variant.friction and dotyk.friction.tresca(g) or nil, multipliers = variant.size and "P1-P0" or nil,
    friction_size = variant.size and variant.size > 1 and variant.size * h or nil }
  local solution = dotyk.solve(scene)
  assert(solution.converged, solution.reason)
  local function at(i, j) return { solution:displacement(body, i * h - 1, j * h) } end
  local function density(xx, yy, xy) return lambda * (xx + yy)^2 + 2 * mu * (xx^2 + yy^2) + mu * xy^2 end
  local square, size, lower = 0, 0, {}
  for i = 0, n do lower[i] = at(i, 0) end
  for j = 0, n // 2 - 1 do
    local upper = {}
    for i = 0, n do upper[i] = at(i, j + 1) end
    for i = 0, n - 1 do
      for up = 0, 1 do -- the triangles below and above the diagonal
        local along <const>, side <const> = up == 1 and upper or lower, i + 1 - up
        local xx, yy = (along[i + 1][1] - along[i][1]) / h, (upper[side][2] - lower[side][2]) / h
        local xy = (along[i + 1][2] - along[i][2]) / h + (upper[side][1] - lower[side][1]) / h
        for _, point in ipairs{ { 0.5, up }, { 1 - up, 0.5 }, { 0.5, 0.5 } } do -- middles of its sides
          local exx, eyy, exy = form.strain((i + point[1]) * h - 1, (j + point[2]) * h)
          square, size = square + h^2 / 6 * density(xx - exx, yy - eyy, xy - exy), size + h^2 / 6 * density(exx, eyy, exy)
        end
      end
    end
    lower = upper
  end
  return math.sqrt(square / size), solution:contact(contact)
end

print "errors on four meshes, relative (rates between them)                                                             α fitted  closed  stick  slip  open"
local off, apart, curves, rates = 0, 0, { {}, {} }, {}
for k, field in ipairs(fields) do
  local first
  for which, variant in ipairs(variants) do
    local line, h, e, c = ("%-16s %-14s"):format(field.name, variant.name), {}, {}, nil
    for i, n in ipairs(cells) do
      h[i] = 2 / n
      e[i], c = solve(field, n, variant)
      line = line .. ("  %.5f%s"):format(e[i], i > 1 and (" (%.3f)"):format(math.log(e[i - 1] / e[i], 2)) or "")
    end
    local alpha <const> = fit.order(h, e)
    print(("%s  %8.3f  %6d  %5d  %4d  %4d"):format(line, alpha, c.closed, c.stick, c.slip, c.open))
    assert(math.abs(c.open / finest - 0.5) < 0.05 and (variant.friction and c.slip or c.closed) > 0, "not the states of the closed form")
    assert((c.stick > 0) == (variant.friction and field.stamp == 0 or false), "stick where there is none, or the reverse")
    off = math.max(off, math.abs(math.log(e[#e - 1] / e[#e], 2) - field.rate))
    if which == 2 then first = e end
    for i = 1, which > 2 and #e or 0 do apart = math.max(apart, math.abs(e[i] / first[i] - 1)) end
    if which == 1 then rates[k] = ("%.2f"):format(alpha) end
    local panel <const> = curves[which == 1 and 1 or 2]
    if which == 1 or which == 3 then panel[k] = { name = ("%s: α = %.2f"):format(field.name, alpha), x = h, y = e } end
  end
end
local range <const>, label <const> = { 1.6 / finest, 20 / finest }, "relative energy error"
dotyk.chart{ file = "images/papers_rates.png", size = { 1000, 1200 }, panels = {
  { title = "No friction", log = "xy", x = "mesh size h", y = label, x_range = range, series = curves[1], slopes = { 1, 0.75, 0.5 } },
  { title = "Given friction", log = "xy", x = "mesh size h", y = label, x_range = range, series = curves[2], slopes = { 1, 0.75, 0.5 } } } }
print "images/papers_rates.png"
common.verdict(off < 0.04 and apart < 1e-3, (
  "without friction α = %s, expected 1, 3/4 and 1/2 (between the finest meshes to %.3f); the same with given friction, where nodal and P1-P0 multipliers, "
  .. "H = h or 2h, differ by %.0e of the error at most. The regularity of the solution sets α, 3/4 is no lower bound of it"):format(
  table.concat(rates, ", "), off, apart))
