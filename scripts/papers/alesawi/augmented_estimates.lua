-- The estimates of Alesawi (ODAM 2001, 5–14), theorems 3.1, 4.1, 5.2 and lemma 3.2, on random programs.
--
--   ./dotyk scripts/papers/alesawi/augmented_estimates.lua [PROGRAMS]
--
-- Minimise ½xᵀBx − cᵀx subject to Dx = d, with two unknowns and m = 1 or 2 equalities. A vector x leaves the gradient
-- r = Bx − c + Dᵀ(μ + ρ(Dx − d)) of the augmented Lagrangian; x̂, μ̂ is the solution, S = DB⁻¹Dᵀ with eigenvalues β₁
-- to β_m, σ the least singular value of D, K = M‖D‖‖B⁻¹‖. Each estimate bounds one error by the others; (3.8), which is
-- (5.8) as well, is written for ‖Dx − d‖. Five of the six are false as printed: counterexamples in part 3. True are
--   (5.6) as printed: μ̌ − μ̂ = (I + ρS)⁻¹(μ − μ̂ + ρDB⁻¹r) for μ̌ = μ + ρ(Dx − d), and ‖(I + ρS)⁻¹‖ = 1/(1 + ρβ₁);
--   (3.2) ‖μ̃ − μ̂‖ ≤ (‖μ − μ̂‖ + ρ‖D‖‖B⁻¹‖‖r‖)/(1 + ρβ₁) + ‖r‖/σ: by (5.6), as Bx − c = r − Dᵀμ̌ gives
--         μ̃ = −(DDᵀ)⁻¹D(Bx − c) = μ̌ − (DDᵀ)⁻¹Dr, and ‖(DDᵀ)⁻¹D‖ = 1/σ;
--   (3.8) ‖Dx − d‖ ≤ (‖μ − μ̂‖ + ‖D‖‖B⁻¹‖‖r‖/β₁)/(ρ + 1/β_m): (S⁻¹ + ρ)(Dx − d) = S⁻¹DB⁻¹r − (μ − μ̂), and ρ + 1/β_m
--         is the least eigenvalue of S⁻¹ + ρ; the printed ρ + 1/β₁ is its greatest, the same for m = 1 only;
--   (4.5) ‖Dx − d‖ ≤ q‖μ − μ̂‖ with q = 1/(ρ + 1/β_m − K/β₁) > 0, by (3.8) with ‖r‖ ≤ M‖Dx − d‖; (4.3) ‖r‖ ≤ Mq‖μ − μ̂‖;
--   (4.4) ‖μ̃ − μ̂‖ ≤ [1/(1 + ρβ₁) + (ρ‖D‖‖B⁻¹‖/(1 + ρβ₁) + 1/σ)Mq]‖μ − μ̂‖: by (3.2) and (4.3).
-- With c(ρ) = 1/(β₁ + ρ⁻¹ − ρ⁻¹K), perhaps meant, (4.3) to (4.5) follow from (3.2) and (3.8) as printed. And (3.2) is
-- the estimate of another update, (3.2)* below, least squares weighted by B⁻¹: μ* = −S⁻¹DB⁻¹(Bx − c), for which μ* − μ̂ =
-- (I + ρS)⁻¹(μ − μ̂ − S⁻¹DB⁻¹r); for square D the two are one. Draws images/papers_augmented_estimates.png.

local programs <const> = tonumber(arg[1]) or 20000 -- for each m
local names <const> = { "(3.2)", "(3.2)*", "(3.8)", "(4.3)", "(4.4)", "(4.5)", "(5.6)" }

-- 1. Symmetric matrices are {a, b, d} for (a b; b d); with one equality, vectors of its multiplier end in 0.
local function eigenvalues(A) -- least, greatest
  local most = (A[1] + A[3]) / 2 + math.sqrt(((A[1] - A[3]) / 2)^2 + A[2]^2)
  return (A[1] * A[3] - A[2]^2) / most, most
end
local function solve(A, v)
  local det = A[1] * A[3] - A[2]^2
  return { (A[3] * v[1] - A[2] * v[2]) / det, (A[1] * v[2] - A[2] * v[1]) / det }
end
local function dot(u, v) return u[1] * v[1] + u[2] * v[2] end
local function times(A, v) return { dot(A, v), A[2] * v[1] + A[3] * v[2] } end
local function norm(v) return math.sqrt(dot(v, v)) end
local function rows(D, v) return { dot(D[1], v), D[2] and dot(D[2], v) or 0 } end -- Dv
local function gram(D, E) return { dot(D[1], E[1]), D[2] and dot(D[1], E[2]) or 0, dot(D[#D], E[#D]) } end -- DEᵀ; for one row a multiple of I

-- 2. The errors of one program, from the definitions, and their bounds; g = μ − μ̂. nil where D or S is nearly singular.
local function measure(B, D, rho, M, g, r)
  local S, DD = gram(D, { solve(B, D[1]), D[2] and solve(B, D[2]) }), gram(D, D)
  local b1, bm = eigenvalues(S)
  local d1, d2 = eigenvalues(DD)
  if b1 < 1e-3 or d1 < 1e-2 then return nil end
  local A, load = B, r
  for k, row in ipairs(D) do
    A = { A[1] + rho * row[1]^2, A[2] + rho * row[1] * row[2], A[3] + rho * row[2]^2 }
    load = { load[1] - row[1] * g[k], load[2] - row[2] * g[k] }
  end
  local e = solve(A, load) -- x − x̂
  local y = rows(D, e) -- Dx − d
  local N, R, Y, DB, sigma = norm(g), norm(r), norm(y), math.sqrt(d2) / eigenvalues(B), math.sqrt(d1)
  local tilde, check = norm(solve(DD, rows(D, times(B, e)))), norm{ g[1] + rho * y[1], g[2] + rho * y[2] }
  local K, s = M * DB, 1 / (1 + rho * b1)
  local c, meant, q = K / (rho * b1 + (1 - K) / rho), 1 / (b1 + (1 - K) / rho), 1 / (rho + 1 / bm - K / b1)
  local function estimate(error, printed, corrected, meant) -- the last for theorem 4.1, which has hypotheses
    return { error = error, printed = printed, corrected = corrected, meant = meant,
             granted = not meant or R <= M * Y and 1 + rho * b1 > K, corrected_granted = not meant or R <= M * Y and q > 0 }
  end
  return { ["(3.2)"] = estimate(tilde, s * (N + DB * R / b1), s * (N + rho * DB * R) + R / sigma),
    ["(3.2)*"] = estimate(norm(solve(S, y)), s * (N + DB * R / b1), s * (N + DB * R / b1)),
    ["(3.8)"] = estimate(Y, s * (b1 * N + DB * R), (N + DB * R / b1) / (rho + 1 / bm)),
    ["(4.3)"] = estimate(R, c * M * b1 / rho * N, M * q * N, meant * M * b1 / rho * N),
    ["(4.4)"] = estimate(tilde, c / rho * N, (s + (rho * DB * s + 1 / sigma) * M * q) * N, meant / rho * N),
    ["(4.5)"] = estimate(Y, c * b1 / rho * N, q * N, meant * b1 / rho * N),
    ["(5.6)"] = estimate(check, s * (N + rho * DB * R), s * (N + rho * DB * R)) }
end
local function violated(one, bound) return one.error > one[bound] + 1e-7 * math.abs(one[bound]) end

-- 3. Counterexamples in small integers.
local function counterexample(text, violates, ...)
  local all = measure(...)
  for _, name in ipairs(violates) do
    local one = all[name]
    print(("%s %s: %.4g against %.4g as printed, %.4g corrected"):format(name, text, one.error, one.printed, one.corrected))
    assert(one.granted and violated(one, "printed") and not violated(one, "corrected"), name)
  end
end
counterexample("B = (2 1; 1 2), D = (1 0), ρ = 6, μ − μ̂ = 0, r = (0, 1)", { "(3.2)" }, { 2, 1, 2 }, { { 1, 0 } }, 6, 1, { 0, 0 }, { 0, 1 })
counterexample("B = diag(1, 4), D = I, ρ = 1, μ − μ̂ = (2, 0), r = 0", { "(3.8)" }, { 1, 0, 4 }, { { 1, 0 }, { 0, 1 } }, 1, 1, { 2, 0 }, { 0, 0 })
counterexample("B = I, D = (1 0), ρ = 2, M = 1, μ − μ̂ = 2, r = (−1, 0)", { "(4.3)", "(4.4)", "(4.5)" }, { 1, 0, 1 }, { { 1, 0 } }, 2, 1, { 2, 0 }, { -1, 0 })

-- 4. Random programs: B = RᵀR + I/20 and D with normal entries, ρ from 0.01 to 1000, M from 0.01 to 10, r over four decades.
math.randomseed(1)
local function normal() return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random()) end
local found = { {}, {} } -- by m and name: all for which the printed hypothesis holds; all for which the corrected one does
for m = 1, 2 do
  for _, name in ipairs(names) do found[m][name] = { printed = {}, corrected = {} } end
  for _ = 1, programs do
    local a, b, c, d, D, g, size = normal(), normal(), normal(), normal(), {}, { 0, 0 }, 10^(4 * math.random() - 3)
    for k = 1, m do D[k], g[k] = { normal(), normal() }, normal() end
    local rho, M, r = 10^(5 * math.random() - 2), 10^(3 * math.random() - 2), { size * normal(), size * normal() }
    local all = measure({ a^2 + c^2 + 0.05, a * b + c * d, b^2 + d^2 + 0.05 }, D, rho, M, g, r)
    for name, one in pairs(all or {}) do
      if one.granted then table.insert(found[m][name].printed, one) end
      if one.corrected_granted then table.insert(found[m][name].corrected, one) end
    end
  end
end
local function share(m, name, bound) -- in percent, of those that violate it
  local list, n = found[m][name][bound == "corrected" and bound or "printed"], 0
  for _, one in ipairs(list) do n = n + (violated(one, bound) and 1 or 0) end
  return 100 * n / #list
end
print "estimate  m   cases  violate it  with c as meant   cases  violate the corrected  closest to it"
for _, name in ipairs(names) do
  for m = 1, 2 do
    local closest, of = 0, found[m][name]
    for _, one in ipairs(of.corrected) do closest = math.max(closest, one.error / one.corrected) end
    print(("%-6s    %d  %6d    %5.1f %%   %14s  %6d  %19.1f %%  %13.4f"):format(name, m, #of.printed, share(m, name, "printed"),
      of.printed[1].meant and ("%.1f %%"):format(share(m, name, "meant")) or "–", #of.corrected, share(m, name, "corrected"), closest))
    assert(share(m, name, "corrected") == 0, "a corrected estimate is violated")
  end
end
assert(share(1, "(5.6)", "printed") + share(2, "(5.6)", "printed") + share(2, "(3.2)", "printed") + share(1, "(3.8)", "printed") == 0)

-- 5. Errors against bounds, 150 of each; what lies above the dashed line violates the estimate.
local panels = {}
for k, name in ipairs{ "(3.2)", "(3.8)", "(4.4)", "(3.2)", "(3.8)", "(4.4)" } do
  local bound, range, series = k <= 3 and "printed" or "corrected", { 1e-7, 1e4 }, {}
  for m = 1, 2 do
    series[m] = { name = "m = " .. m, style = "points", x = {}, y = {} }
    for _, one in ipairs(found[m][name][bound]) do
      local n = #series[m].x + 1
      if n <= 150 and one[bound] > 0 then series[m].x[n], series[m].y[n] = one[bound], one.error end
    end
  end
  series[3] = { name = "error = bound", x = range, y = range, reference = true }
  panels[k] = { title = name .. (k <= 3 and " as printed" or " corrected"), series = series, log = "xy", x = "bound",
                y = name == "(3.8)" and "‖Dx − d‖" or "‖μ̃ − μ̂‖", x_range = range, y_range = range }
end
dotyk.chart{ file = "images/papers_augmented_estimates.png", panels = panels, columns = 3, size = { 1500, 1000 } }
print "images/papers_augmented_estimates.png"
print(("verdict: only (5.6) is true as printed for every D, (3.2) for square D, (3.8) for one equality; (4.3) to (4.5) are false for one and for two; the"
  .. " corrected ones are violated by none of %d programs"):format(#found[1]["(5.6)"].printed + #found[2]["(5.6)"].printed))
