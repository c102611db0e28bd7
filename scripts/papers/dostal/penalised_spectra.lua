-- Spectra of the penalised Hessians of Dostál, Gomes and Santos (ODAM 2001, 15–25, section 3), and the steps of CG.
--
--   ./dotyk scripts/papers/dostal/penalised_spectra.lua [CELLS]
--
-- 1. A strip of four unit squares in plane strain (E = 1, ν = 0.3), fixed on the left, loaded on top; each is a subdomain of
--    CELLS × CELLS cells cut into triangles. F = BK†Bᵀ, G̃ = RᵀBᵀ with orthonormal R, G of orthonormal rows, Q = GᵀG, P = I − Q,
--    σ(F) in [a, b], non-zero σ(G̃ᵀG̃) in [γ, δ], σ(PFP) on im P in [a_P, b_P]; dense matrices, eigenvalues by Jacobi's rotations.
-- 2. With rows of B scaled as dotyk.solver.feti scales them, its condition of PFP and its CG steps must come out.
-- 3. PFP does not depend on the choice of K†, F does: a K† that fixes the same nodes on both sides of an interface makes F
--    singular, a = 0, although RᵀBᵀ has full rank, and κ̄(H₂) = 4b/a infinite; Moore–Penrose's K† gives a > 0.
-- 4. σ(H₁), H₁ = F + ρG̃ᵀG̃, in [a, b] ∪ [a + ργ, b + ρδ]; σ(H₂), H₂ = F + ρQ, in [a, b] ∪ [a + ρ, b + ρ]; σ(H₃), H₃ = PFP + ρQ,
--    in [a_P, b_P] ∪ {ρ}. All three are true (Weyl's inequalities).
-- 5. Steps of CG that reduce the error in energy by ε. With a polynomial that has a root at ρ, H₃ takes at most
--    int(½√(b_P/a_P) ln(2C/ε) + 2), C = b_P/ρ − 1 for ρ < a_P and 1 for ρ ≥ a_P. (3.6) has C = 1 for all ρ. For the gradient's
--    norm C is √(max(b_P, ρ)/a_P) times greater. H₁ and H₂ have as many eigenvalues beyond b as G has rows, r: at most
--    int(½√(b/a) ln(2/ε) + 1) + r steps for ργ ≥ b, ρ ≥ b, whatever ρ. By two intervals [a, b], [a + ρ, b + ρ] H₂ takes at most
--    2 int(¼√κ̄ ln(2/ε) + 1), κ̄ = 4b(a + ρ)/(a(b + ρ)) → 4b/a. From λ = 0 with μ = 0 the gradient is −Pd, CG stays in im P,
--    and ρ does not matter at all. All this is for exact arithmetic: the bounds are asserted of CG with gradients kept
--    orthogonal to all before. Counts without that are shown beside; what large ρ costs with H₁ is of rounding.
-- Draws images/papers_penalised_spectra.png and images/papers_penalised_spectra_steps.png.

local n <const>, squares <const>, epsilon <const> = tonumber(arg[1]) or 8, 4, 1e-4
local common <const>, dense <const> = include "../../lib/common.lua", include "../../lib/dense.lua"
local matrix <const>, dot <const>, times <const>, transposed <const>, product <const> = dense.matrix, dense.dot, dense.times, dense.transposed, dense.product
local sum <const>, largest <const>, solver <const>, eigenvalues <const> = dense.sum, dense.largest, dense.solver, dense.eigenvalues
assert(n % 2 == 0, "CELLS must be even")

-- 1. The dual problem: generalised inverses of a square by fixed unknowns, "middle" of bottom and top, or "left" or "right"
-- corners alternately ("interface"); projected from both sides it is Moore–Penrose's.
local lambda <const>, mu <const> = 0.3 / (1.3 * 0.4), 1 / 2.6
local function unknown(i, j, component) return 2 * (j * (n + 1) + i) + component end
local K <const> = matrix(2 * (n + 1)^2 // 1, 2 * (n + 1)^2 // 1)
for i = 0, n - 1 do
  for j = 0, n - 1 do
    for _, nodes in ipairs{ { { 0, 0, -1, 0 }, { 1, 0, 1, -1 }, { 1, 1, 0, 1 } }, { { 0, 0, 0, -1 }, { 1, 1, 1, 0 }, { 0, 1, -1, 1 } } } do
      for _, v in ipairs(nodes) do
        for _, w in ipairs(nodes) do
          for c = 1, 2 do
            for d = 1, 2 do
              local value = lambda * v[2 + c] * w[2 + d] + mu * v[2 + d] * w[2 + c] + (c == d and mu * (v[3] * w[3] + v[4] * w[4]) or 0)
              local row = K[unknown(i + v[1], j + v[2], c)]
              row[unknown(i + w[1], j + w[2], d)] = row[unknown(i + w[1], j + w[2], d)] + value / 2
            end
          end
        end
      end
    end
  end
end
local R <const> = matrix(3, #K) -- orthonormal rigid motions
for i = 0, n do
  for j = 0, n do
    R[1][unknown(i, j, 1)], R[2][unknown(i, j, 2)] = 1, 1
    R[3][unknown(i, j, 1)], R[3][unknown(i, j, 2)] = n / 2 - j, i - n / 2
  end
end
for k = 1, 3 do
  local norm = math.sqrt(dot(R[k], R[k]))
  for i = 1, #K do R[k][i] = R[k][i] / norm end
end
local function inverse(fixed, project) -- K† v, zero at fixed unknowns
  local free, held = {}, {}
  for _, k in ipairs(fixed) do held[k] = true end
  for k = 1, #K do if not held[k] then free[#free + 1] = k end end
  local solve = solver(matrix(#free, #free, function(i, j) return K[free[i]][free[j]] end))
  local function elastic(v) -- without rigid motions
    if not project then return v end
    local w = { table.unpack(v) }
    for k = 1, 3 do local part = dot(R[k], v) for i = 1, #v do w[i] = w[i] - part * R[k][i] end end
    return w
  end
  return function(v)
    local right, x = {}, {}
    v = elastic(v)
    for k = 1, #free do right[k] = v[free[k]] end
    local some = solve(right)
    for k = 1, #K do x[k] = 0 end
    for k = 1, #free do x[free[k]] = some[k] end
    return elastic(x)
  end
end
local function dual(choice, scaled)
  local wall, inverses, sides = {}, {}, { left = 0, right = n, middle = n // 2 }
  for j = 0, n do for c = 1, 2 do wall[#wall + 1] = unknown(0, j, c) end end
  inverses[1] = inverse(wall)
  for p = 2, squares do
    local i = sides[choice] or sides[choice == "interface" and (p % 2 == 0 and "right" or "left") or "middle"]
    inverses[p] = inverse({ unknown(i, 0, 1), unknown(i, 0, 2), unknown(i, n, 1) }, choice == "Moore-Penrose")
  end
  local rows, greatest, load = {}, 0, {}
  for k = 1, #K do greatest, load[k] = math.max(greatest, K[k][k]), 0 end
  for i = 0, n do load[unknown(i, n, 2)] = -(i % n == 0 and 0.5 or 1) / n end
  for p = 1, squares - 1 do -- λ: interface, node, component
    for j = 0, n do
      for c = 1, 2 do
        local plus, minus = unknown(n, j, c), unknown(0, j, c)
        local kp, km = K[plus][plus] / greatest, K[minus][minus] / greatest
        rows[#rows + 1] = { p = p, plus = plus, minus = minus, s = scaled and math.sqrt(kp * km / (kp + km)) or 1 }
      end
    end
  end
  local m = #rows
  local F, G, e, d = matrix(m, m), matrix(3 * (squares - 1), m), {}, {}
  for p = 1, squares do
    local loaded = inverses[p](load)
    local function entry(r) -- of the row in this square
      if r.p == p then return r.plus, r.s elseif r.p + 1 == p then return r.minus, -r.s end
    end
    for j, r in ipairs(rows) do
      local at, value = entry(r)
      if at then
        local unit = {}
        for k = 1, #K do unit[k] = k == at and value or 0 end
        local x = inverses[p](unit)
        for i, other in ipairs(rows) do
          local here, factor = entry(other)
          if here then F[i][j] = F[i][j] + factor * x[here] end
        end
        d[j] = (d[j] or 0) + value * loaded[at]
        if p > 1 then for k = 1, 3 do G[3 * p - 6 + k][j] = value * R[k][at] end end
      end
    end
    if p > 1 then for k = 1, 3 do e[3 * p - 6 + k] = dot(R[k], load) end end
  end
  F = sum(matrix(m, m, function(i, j) return F[i][j] / 2 end), 0.5, transposed(F)) -- symmetric but for rounding
  local coarse, Gt = solver(product(G, transposed(G))), transposed(G)
  local Q = matrix(m, m)
  for j = 1, m do
    local column = times(Gt, coarse(Gt[j]))
    for i = 1, m do Q[i][j] = column[i] end
  end
  local P = sum(matrix(m, m, function(i, j) return i == j and 1 or 0 end), -1, Q)
  local PFP, balanced = product(product(P, F), P), times(F, times(Gt, coarse(e)))
  for i = 1, m do d[i] = d[i] - balanced[i] end
  local values, kinds, of_G = eigenvalues(F), eigenvalues(PFP), eigenvalues(product(Gt, G))
  local r = #G
  return { F = F, GG = product(Gt, G), Q = Q, P = P, PFP = PFP, Pd = times(P, d), r = r, m = m, a = values[1], b = values[m],
    aP = kinds[r + 1], bP = kinds[m], gamma = of_G[m - r + 1], delta = of_G[m], values = values, kernel = kinds[r] }
end

-- Steps of CG on Hx = right from 0, x known, until the gradient and the error in energy have fallen by `tol`. clean(g, earlier)
-- may take from each gradient what it has by rounding alone.
local function cg(H, right, exact, tol, clean)
  local x, g, steps, count, earlier = {}, {}, 0, {}, {}
  for i = 1, #right do x[i], g[i] = 0, -right[i] end
  local p, gg, start = {}, dot(g, g), exact and dot(exact, right)
  for i = 1, #g do p[i] = -g[i] end
  local first = gg
  while not (count.gradient and (count.energy or not exact)) do
    local Hp = times(H, p)
    earlier[steps + 1] = { table.unpack(g) }
    local alpha, before = gg / dot(p, Hp), gg
    for i = 1, #g do x[i], g[i] = x[i] + alpha * p[i], g[i] + alpha * Hp[i] end
    if clean then clean(g, earlier) end
    gg, steps = dot(g, g), steps + 1
    for i = 1, #g do p[i] = gg / before * p[i] - g[i] end
    if exact and not count.energy then
      local error = {}
      for i = 1, #x do error[i] = exact[i] - x[i] end
      if dot(error, times(H, error)) <= tol^2 * start then count.energy = steps end
    end
    if gg <= tol^2 * first then count.gradient = count.gradient or steps end
    assert(steps < 5000, "CG does not end")
  end
  return count
end

local function orthogonal(g, earlier) -- to all before
  for _ = 1, 2 do
    for _, h in ipairs(earlier) do
      local part = dot(h, g) / dot(h, h)
      for i = 1, #g do g[i] = g[i] - part * h[i] end
    end
  end
end

-- 2. Against the program.
local body <const> = dotyk.body{ name = "strip", material = dotyk.material{ E = 1, nu = 0.3 },
  mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { squares, 1 }, cells = { squares * n, n } } }
body:part"left":fix()
body:part"top":load{ 0, -1 }
local s <const> = dotyk.solver.feti{ subdomains = { squares, 1 }, supports = "stiffness", spectrum = true }:solve(dotyk.scene{ body })
local ours <const> = dual("middle", true)
local steps <const> = cg(ours.PFP, ours.Pd, nil, 1e-10).gradient
print(("%d multipliers, %d rigid motions; condition of PFP: %.9f, dotyk.solver.feti: %.9f; CG steps to 1e-10: %d, feti: %d"):format(
  ours.m, ours.r, ours.bP / ours.aP, s.feti.condition, steps, s.history[#s.history].inner))
local ratio <const>, norm <const> = s.feti.condition / (ours.bP / ours.aP), s.feti.norm / ours.bP -- Lanczos: from below, from above
assert(ratio > 0.999 and ratio < 1 + 1e-9 and norm > 1 - 1e-9 and norm < 1.001 and math.abs(steps - s.history[#s.history].inner) <= 1)

-- 3. The choice of K†.
print "\nK†                a (least of F)  b         a_P       b_P       4b/a      PFP off by"
local cases <const> = {}
for _, choice in ipairs{ "middle", "Moore-Penrose", "interface" } do
  local c = dual(choice)
  cases[choice] = c
  local off = largest(sum(c.PFP, -1, cases.middle.PFP)) / c.bP
  local zero = c.a < 1e-12 * c.b
  print(("%-14s    %-12s  %8.4f  %8.5f  %8.4f  %8s  %.0e"):format(choice, zero and "0" or ("%.6f"):format(c.a), c.b, c.aP, c.bP,
    zero and "infinite" or ("%.1f"):format(4 * c.b / c.a), off))
  assert(off < 1e-10 and zero == (choice == "interface") and c.a <= c.aP * (1 + 1e-12) + 1e-12 and c.bP <= c.b * (1 + 1e-12))
  assert(c.kernel < 1e-12 * c.bP and c.gamma > 1e-3 * c.delta) -- G has full rank
end
local c <const> = cases["Moore-Penrose"]

-- 4. The three spectra.
local hessians <const> = { function(rho) return sum(c.F, rho, c.GG) end, function(rho) return sum(c.F, rho, c.Q) end, function(rho) return sum(c.PFP, rho, c.Q) end }
local function intervals(k, rho) -- two of them
  if k == 3 then return c.aP, c.bP, rho, rho end
  return c.a, c.b, c.a + rho * (k == 1 and c.gamma or 1), c.b + rho * (k == 1 and c.delta or 1)
end
local spectra, outside = {}, 0
for k = 1, 3 do
  local found <const> = common.curve("eigenvalues", { style = "points" })
  local names <const> = { k == 3 and "a_P" or "a", k == 3 and "b_P" or "b", ({ "a + ργ", "a + ρ", "ρ" })[k], ({ "b + ρδ", "b + ρ" })[k] }
  local ends <const> = {}
  for i = 1, k == 3 and 3 or 4 do ends[i] = common.curve(names[i], { style = "line", twin = i % 2 == 0 }) end
  for tenths = -40, 50 do
    local rho = 10^(tenths / 10)
    local low = { intervals(k, rho) }
    for i, curve in ipairs(ends) do curve:add(rho, low[i]) end
    for _, value in ipairs(tenths % 10 == 0 and eigenvalues(hessians[k](rho)) or {}) do
      found:add(rho, value)
      local off = math.min(math.max(low[1] - value, value - low[2]), math.max(low[3] - value, value - low[4]))
      outside = math.max(outside, off / math.max(c.b, rho))
    end
  end
  spectra[k] = { title = ("Spectrum of H%s"):format(({ "₁", "₂", "₃" })[k]), x = "penalty ρ", y = "eigenvalue", log = "xy",
    y_range = { k == 3 and 3e-5 or 0.3, k == 3 and 3e6 or 3e5 }, series = { found, table.unpack(ends) } }
end
dotyk.chart{ file = "images/papers_penalised_spectra.png", columns = 3, size = { 2100, 900 }, panels = spectra }
print(("\nσ(H₁), σ(H₂), σ(H₃) for ten ρ: outside their intervals by %.0e of the greatest at most; [γ, δ] = [%.4f, %.4f]"):format(outside, c.gamma, c.delta))

-- 5. Steps of CG: the most of ten starts, five random gradients z and five with g = Lz, H = LLᵀ, random in energy.
local kappa <const> = c.bP / c.aP
local printed <const> = math.floor(math.sqrt(kappa) * math.log(2 / epsilon) + 3) / 2 -- (3.6)
local by_rank <const> = math.floor(math.sqrt(c.b / c.a) / 2 * math.log(2 / epsilon) + 1) + c.r
local function corrected(rho, of_gradient)
  local C = (rho < c.aP and c.bP / rho - 1 or 1) * (of_gradient and math.sqrt(math.max(c.bP, rho) / c.aP) or 1)
  return math.floor(math.sqrt(kappa) / 2 * math.log(2 * C / epsilon) + 2)
end
local function by_intervals(rho) -- apart from each other
  return rho > c.b - c.a and 2 * math.floor(math.sqrt(4 * c.b * (c.a + rho) / c.a / (c.b + rho)) / 4 * math.log(2 / epsilon) + 1) or nil
end
math.randomseed(1)
local starts, kept, failed = {}, true, { energy = 0, gradient = 0 }
for k = 1, 5 do starts[k] = {} for i = 1, c.m do starts[k][i] = math.random() - 0.5 end end
local function most_steps(H, clean)
  local solve, most = solver(H), { energy = 0, gradient = 0 }
  for _, right in ipairs(starts) do
    local x, spread = solve(right)
    for _, load in ipairs{ right, spread } do
      for kind, steps in pairs(cg(H, load, load == right and x or solve(load), epsilon, clean)) do most[kind] = math.max(most[kind], steps) end
    end
  end
  return most
end
local function curves(...) -- counted twice, and bounds
  local list = { common.curve "counted", common.curve "kept orthogonal" }
  for i, name in ipairs{ ... } do list[2 + i] = common.curve(name, { style = "line", reference = name == "(3.6)" }) end
  return list
end
local drawn <const> = { curves "bound by rank", curves("bound by rank", "bound by two intervals"), curves("(3.6)", "corrected bound"), curves("(3.6)", "corrected bound") }
local function add(list, rho, ...) for i, value in ipairs{ ... } do list[i]:add(rho, value) end end
print(("\nCG steps to ε = %g, as counted and with orthogonal gradients; bounds: (3.6) %.1f, by rank %d"):format(epsilon, printed, by_rank))
print "            error in energy              gradient        corrected bounds   two intervals"
print "       ρ     H₁      H₂      H₃          H₃              energy gradient         H₂"
for power = -12, 12 do
  local rho, float, exact = 10.0^(power / 2), {}, {}
  for k = 1, 3 do float[k], exact[k] = most_steps(hessians[k](rho)), most_steps(hessians[k](rho), orthogonal) end
  add(drawn[1], rho, float[1].energy, exact[1].energy, by_rank)
  add(drawn[2], rho, float[2].energy, exact[2].energy, by_rank, by_intervals(rho))
  add(drawn[3], rho, float[3].energy, exact[3].energy, printed, corrected(rho))
  add(drawn[4], rho, float[3].gradient, exact[3].gradient, printed, corrected(rho, true))
  kept = kept and (rho * c.gamma < c.b or exact[1].energy <= by_rank) and (rho < c.b or exact[2].energy <= math.min(by_rank, by_intervals(rho) or by_rank))
    and exact[3].energy <= corrected(rho) and exact[3].gradient <= corrected(rho, true)
  for kind, steps in pairs(exact[3]) do if steps > printed and rho < c.aP then failed[kind] = math.max(failed[kind], rho) end end
  if power % 2 == 0 then
    print(("%8g  %3d %3d  %3d %3d  %3d %3d      %3d %3d             %3d   %3d           %s"):format(rho, float[1].energy, exact[1].energy, float[2].energy,
      exact[2].energy, float[3].energy, exact[3].energy, float[3].gradient, exact[3].gradient, corrected(rho), corrected(rho, true), by_intervals(rho) or "overlap"))
  end
end
local function projected(g) for i, value in ipairs(times(c.P, g)) do g[i] = value end end
local least, most, rounded = math.huge, 0, 0
for power = -6, 6 do
  local H = hessians[3](10.0^power)
  local count = cg(H, c.Pd, nil, epsilon, projected).gradient
  least, most, rounded = math.min(least, count), math.max(most, count), math.max(rounded, cg(H, c.Pd, nil, epsilon).gradient)
end
print(("from λ = 0, gradient −Pd: %d steps for all ρ from 1e-6 to 1e6 with P applied to each gradient, up to %d without"):format(most, rounded))
local function panel(k, title, y, top) return { title = title, x = "penalty ρ", y = y, log = "x", y_range = { 0, top }, series = drawn[k] } end
dotyk.chart{ file = "images/papers_penalised_spectra_steps.png", columns = 2, size = { 2100, 1500 }, panels = {
  panel(1, "H₁ = F + ρG̃ᵀG̃: energy", "CG steps", 120), panel(2, "H₂ = F + ρQ: energy", "CG steps", 120),
  panel(3, "H₃ = PFP + ρQ: energy", "CG steps", 80), panel(4, "H₃ = PFP + ρQ: gradient", "CG steps", 80) } }
print "images/papers_penalised_spectra.png  images/papers_penalised_spectra_steps.png"
common.verdict(outside < 1e-10 and kept and least == most and failed.energy > 0 and failed.gradient > 0, ("the intervals of σ(H₁), σ(H₂) and σ(H₃) are true; CG takes more "
  .. "steps than (3.6) says for ρ ≤ %.1g in energy, ρ ≤ %.1g for the gradient (a_P = %.3f, b_P = %.3f); the corrected bounds hold for all ρ"):format(
  failed.energy, failed.gradient, c.aP, c.bP))
