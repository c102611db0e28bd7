-- The constants of Korn's inequality (TR965, (1.18) and (1.19)) and of Poincaré's (Horák and Fibinger, ODAM 2001, P5, (1)–(3)) on the unit square.
--
--   ./dotyk scripts/papers/tr965/constants.lua [DEGREE]
--
-- Each best constant is an eigenvalue of two quadratic forms: Korn's α₀ is the least value of ∫ε(v):ε(v) / ‖v‖²_{H¹}, Poincaré's c₁ the greatest of
-- ‖v‖²_{H²} / (right side). Here by Ritz's method with polynomials of degree n in x and in y, so that α₀ is met from above and c₁ from below, the
-- nearer the higher the degree.
-- 1. Korn. With supports along flat sides, v·n = 0, partial integration gives ∫ε:ε = ½∫|∇v|² + ½∫(div v)², for the sides of a square at which v is
--    held as well. So, where all four sides slide, (sin πx cos πy, −cos πx sin πy) is the worst field: α₀ = π²/(1 + 2π²). It is a lower
--    bound where all four are held, ½ an upper one. (1.19) for the plane strain of a material with E = 1, ν = 0.3: the least value of
--    a(v, v)/‖v‖² beside c₀α₀, c₀ = E/(1 + ν) the least eigenvalue of Hooke's tensor on symmetric tensors.
--    Where left and bottom slide, TR965's example of supports that hold, fields that concentrate at the free corner matter: there the quotient comes as
--    near to ¼ − 1/2π = 0.0908 as one likes (the corner's bound ½ − 1/π for the divergence, Costabel, Crouzeix, Dauge, Lafranche 2015, halved by Horgan and
--    Payne's relation 1983), so α₀ is not greater. Ritz's values fall to it slowly: 1/√(α − 0.0908) grows in proportion to ln n.
-- 2. Poincaré. Of (1)–(3); |v|² of H² has ∂₁₂v once. Beside them the known one, ‖v‖² − (v, 1)² ≤ c |v|²_{H¹} with c = 1/π².
-- No method of the program needs these constants: they bound errors and prove that solutions exist.
-- DEGREE: the highest, at least 4

local highest <const> = math.max(4, math.tointeger(tonumber(arg[1]) or 12))
local dense <const>, common <const> = include "../../lib/dense.lua", include "../../lib/common.lua"

-- Legendre's polynomials on (0, 1), and Gauss's points and weights, their roots.
local function legendre(n, t) -- P_n and its derivative in t, −1 < t < 1
  local p, q = 1, 0 -- P_k, P_{k−1}
  for k = 1, n do p, q = ((2 * k - 1) * t * p - (k - 1) * q) / k, p end
  return p, n == 0 and 0 or n * (q - t * p) / (1 - t * t)
end
local points <const>, weights <const> = {}, {}
do
  local count <const> = highest + 3
  for i = 1, count do
    local t = math.cos(math.pi * (i - 0.25) / (count + 0.5))
    for _ = 1, 50 do
      local p <const>, slope <const> = legendre(count, t)
      t = t - p / slope
    end
    local _, slope <const> = legendre(count, t)
    points[i], weights[i] = (1 + t) / 2, 1 / ((1 - t * t) * slope^2)
  end
end

-- Polynomials of degree n on (0, 1), zero at the ends that are held ("", "0", "1" or "01"): their derivatives of order 0, 1, 2 at Gauss's points. They
-- are Legendre's times x, 1 − x or both; derivatives of Legendre's by their equation.
local function space(n, held)
  local a <const>, b <const> = held:find "0" and 1 or 0, held:find "1" and 1 or 0
  local s <const> = { {}, {}, {} }
  for k = 0, n - a - b do
    local f <const> = { {}, {}, {} }
    for i, x in ipairs(points) do
      local t <const> = 2 * x - 1
      local p <const>, slope <const> = legendre(k, t)
      local curvature <const> = (2 * t * slope - k * (k + 1) * p) / (1 - t * t)
      local P <const> = { p, 2 * slope, 4 * curvature }
      local w, dw, ddw = 1, 0, 0
      if a == 1 and b == 1 then w, dw, ddw = x * (1 - x), 1 - 2 * x, -2 elseif a == 1 then w, dw = x, 1 elseif b == 1 then w, dw = 1 - x, -1 end
      f[1][i], f[2][i], f[3][i] = w * P[1], dw * P[1] + w * P[2], ddw * P[1] + 2 * dw * P[2] + w * P[3]
    end
    for order = 1, 3 do s[order][k + 1] = f[order] end
  end
  return s
end
local function integrals(s, i, t, j) -- of the i-th derivatives of s times the j-th of t
  return dense.matrix(#s[1], #t[1], function(k, l)
    local sum = 0
    for g, w in ipairs(weights) do sum = sum + w * s[i + 1][k][g] * t[j + 1][l][g] end
    return sum
  end)
end

-- Adds factor X ⊗ Y, X of the directions x, Y of y, to a matrix from a row and a column on.
local function add(A, row, column, factor, X, Y)
  for i = 1, #X do
    for k = 1, #X[1] do
      if X[i][k] ~= 0 then
        for j = 1, #Y do
          local to <const>, x <const> = A[row + (i - 1) * #Y + j], factor * X[i][k]
          for l = 1, #Y[1] do to[column + (k - 1) * #Y[1] + l] = to[column + (k - 1) * #Y[1] + l] + x * Y[j][l] end
        end
      end
    end
  end
end

-- The greatest eigenvalue of N v = θ A v by Lanczos's method for A⁻¹N in the scalar product of A, A positive definite.
local function greatest(A, N)
  local solve <const>, V, AV, alpha, beta, last = dense.solver(A), {}, {}, {}, {}, 0
  local v = {}
  for i = 1, #A do v[i] = math.sin(i * i + 1) end
  for step = 1, math.min(#A, 60) do
    for _ = 1, 2 do -- twice is enough
      for k = 1, #V do
        local c <const> = dense.dot(AV[k], v)
        for i = 1, #v do v[i] = v[i] - c * V[k][i] end
      end
    end
    local Av = dense.times(A, v)
    local size <const> = math.sqrt(dense.dot(v, Av))
    if step > 1 and size < 1e-12 * last then break end
    for i = 1, #v do v[i], Av[i] = v[i] / size, Av[i] / size end
    V[step], AV[step], beta[step] = v, Av, size
    local Nv <const> = dense.times(N, v)
    alpha[step] = dense.dot(v, Nv)
    v = solve(Nv)
    if step % 10 == 0 or step == #A then
      local T <const> = dense.matrix(step, step, function(i, j) return i == j and alpha[i] or math.abs(i - j) == 1 and beta[math.max(i, j)] or 0 end)
      local values <const> = dense.eigenvalues(T)
      if math.abs(values[step] - last) < 1e-12 * values[step] then return values[step] end
      last = values[step]
    end
  end
  return last
end

-- 1. Korn: held[c] = { sides at which component c is held along x, along y }. α₀, and the constant of (1.19).
local E <const>, nu <const> = 1, 0.3
local mu2 <const>, lambda <const> = E / (1 + nu), E * nu / ((1 + nu) * (1 - 2 * nu))
local function korn(held, n)
  local s, start, size = {}, {}, 0
  for c = 1, 2 do
    s[c] = { space(n, held[c][1]), space(n, held[c][2]) }
    start[c] = size
    size = size + #s[c][1][1] * #s[c][2][1]
  end
  local function form(of_shear, of_div) -- of_shear ∫ε:ε + of_div ∫(div)²
    local A <const> = dense.matrix(size, size)
    for c = 1, 2 do
      local X <const>, Y <const> = s[c][1], s[c][2]
      local along <const>, across <const> = c == 1 and of_shear + of_div or of_shear / 2, c == 1 and of_shear / 2 or of_shear + of_div
      add(A, start[c], start[c], along, integrals(X, 1, X, 1), integrals(Y, 0, Y, 0))
      add(A, start[c], start[c], across, integrals(X, 0, X, 0), integrals(Y, 1, Y, 1))
    end
    for c = 1, 2 do -- ∂₂v₁ ∂₁v₂ and ∂₁v₁ ∂₂v₂, and the same from the other side
      local o <const> = 3 - c
      local X <const>, Y <const>, U <const>, W <const> = s[c][1], s[c][2], s[o][1], s[o][2]
      local i <const> = c == 1 and 0 or 1
      add(A, start[c], start[o], of_shear / 2, integrals(X, i, U, 1 - i), integrals(Y, 1 - i, W, i))
      add(A, start[c], start[o], of_div, integrals(X, 1 - i, U, i), integrals(Y, i, W, 1 - i))
    end
    return A
  end
  local N <const> = dense.matrix(size, size)
  for c = 1, 2 do
    for _, order in ipairs{ { 0, 0 }, { 1, 0 }, { 0, 1 } } do
      add(N, start[c], start[c], 1, integrals(s[c][1], order[1], s[c][1], order[1]), integrals(s[c][2], order[2], s[c][2], order[2]))
    end
  end
  return 1 / greatest(form(1, 0), N), 1 / greatest(form(mu2, lambda), N)
end
local squares <const> = {
  { "all sides slide", { { "01", "" }, { "", "01" } }, exact = math.pi^2 / (1 + 2 * math.pi^2) },
  { "all sides held", { { "01", "01" }, { "01", "01" } } },
  { "left and bottom slide", { { "0", "" }, { "", "0" } }, limit = 1 / 4 - 1 / (2 * math.pi) },
  { "left side held", { { "0", "" }, { "0", "" } } },
}
local off = 0
print "Korn, unit square        |   n   α₀         best of (1.19)   c₀α₀"
local values <const> = {}
for _, square in ipairs(squares) do
  local before, line = math.huge, {}
  for n = 4, highest, 4 do
    local alpha <const>, best <const> = korn(square[2], n)
    print(("%-24s | %3d   %.6f   %.6f         %.6f"):format(n == 4 and square[1] or "", n, alpha, best, mu2 * alpha))
    assert(alpha < before * (1 + 1e-9) and best > mu2 * alpha * (1 - 1e-9), "Ritz's values fall, and (1.19) has the constant c₀α₀ at least")
    before = alpha
    if square.limit then line[#line + 1] = { math.log(n), 1 / math.sqrt(alpha - square.limit) } end
  end
  local slope = nil -- of 1/√(α − limit) by ln n, from degree to degree
  for k = 2, #line do
    local now <const> = (line[k][2] - line[k - 1][2]) / (line[k][1] - line[k - 1][1])
    print(("%-24s   1/√(α − %.6f) by ln n: slope %.3f"):format("", square.limit, now))
    assert(not slope or math.abs(now / slope - 1) < 0.05, "the values do not fall to the corner's bound like 1/ln²")
    slope = now
  end
  values[square[1]] = before
  if square.exact then
    off = math.max(off, math.abs(before / square.exact - 1))
    print(("%-24s |  closed form %.6f"):format("", square.exact))
  end
end
assert(values["all sides held"] > squares[1].exact and values["all sides held"] <= 0.5)

-- 2. Poincaré.
local function traces(count, order) -- f(0) g(0) + f(1) g(1) of Legendre's polynomials, or of their derivatives
  local function at(n, t) return order == 0 and t^n or t^(n + 1) * n * (n + 1) end -- P_n(±1) = (±1)ⁿ, in x the slope (±1)ⁿ⁺¹ n(n + 1)
  return dense.matrix(count, count, function(k, l) return at(k - 1, -1) * at(l - 1, -1) + at(k - 1, 1) * at(l - 1, 1) end)
end
local function poincare(n)
  local s <const> = space(n, "")
  local count <const>, M <const> = #s[1], {}
  for i = 0, 2 do M[i] = integrals(s, i, s, i) end
  local function form(...) -- sum of X ⊗ Y
    local A <const> = dense.matrix(count^2, count^2)
    for _, pair in ipairs{ ... } do add(A, 0, 0, 1, pair[1], pair[2]) end
    return A
  end
  local bends <const> = { { M[2], M[0] }, { M[1], M[1] }, { M[0], M[2] } }
  local slopes <const>, mass <const> = { { M[1], M[0] }, { M[0], M[1] } }, { { M[0], M[0] } }
  local function join(...)
    local all = {}
    for _, list in ipairs{ ... } do table.move(list, 1, #list, #all + 1, all) end
    return form(table.unpack(all))
  end
  local mean <const>, slope <const>, edge <const> = {}, {}, {} -- ∫f, ∫f′, f(0) + f(1) of each function
  for k = 1, count do
    mean[k], slope[k] = k == 1 and 1 or 0, k % 2 == 0 and 2 or 0
    edge[k] = k % 2 == 1 and 2 or 0
  end
  local function outer(f, g) return dense.matrix(#f, #f, function(i, j) return f[i] * (g or f)[j] end) end
  local N <const> = join(bends, slopes, mass)
  local on_edges <const> = { { traces(count, 0), M[0] }, { M[0], traces(count, 0) } } -- ‖γ₀v‖²
  local across <const> = { { traces(count, 1), M[0] }, { M[0], traces(count, 1) } } -- ‖γ₁v‖²
  local around <const> = { { outer(edge), outer(mean) }, { outer(mean), outer(edge) }, { outer(edge, mean), outer(mean, edge) }, { outer(mean, edge), outer(edge, mean) } } -- (γ₀v, 1)²
  local means <const> = { { outer(mean), outer(mean) }, { outer(slope), outer(mean) }, { outer(mean), outer(slope) } }
  local zero_mean <const> = form(table.unpack(mass)) -- ‖v‖² less (v, 1)²
  add(zero_mean, 0, 0, -1, outer(mean), outer(mean))
  return greatest(join(bends, on_edges), N), greatest(join(bends, around, across), N), greatest(join(bends, means), N),
    greatest(join(slopes, { { outer(mean), outer(mean) } }), zero_mean)
end
print "\nleast c₁ on the unit square\n   n   (1)        (2)        (3)        ‖v‖² ≤ c |v|²_{H¹}, mean zero"
local least
for n = 4, math.min(highest, 10), 2 do
  local now <const> = { poincare(n) }
  print(("%4d   %.6f   %.6f   %.6f   %.8f"):format(n, table.unpack(now)))
  if least then
    for i = 1, 4 do assert(now[i] > least[i] * (1 - 1e-9), "Ritz's values rise") end
  end
  least = now
end
off = math.max(off, math.abs(least[4] * math.pi^2 - 1))
print(("closed form of the last: 1/π² = %.8f"):format(1 / math.pi^2))
common.verdict(off < 1e-3 and (highest < 8 or off < 1e-6), ("on the unit square α₀ = %.4f where its left side is held; c₁ = %.4f, %.4f and %.4f; closed forms are met to %.0e"):format(
  values["left side held"], least[1], least[2], least[3], off))
