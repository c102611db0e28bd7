-- Working sets of semidefinite programs: lemma 3.1, remark 3.4, theorem 3.3 and remark 3.6 of Netuka (ODAM 2001, 101–125).
--
--   ./dotyk scripts/papers/netuka/semicoercive_working_sets.lua [PROGRAMS]
--
-- min ½xᵀCx − dᵀx, Ax ≤ b, for chains of springs (one free motion each) and independent rows that keep places of them above
-- a floor, or apart; by algorithm 3.1 as printed, with dᵀp = +1 in (76) (misprint 104), in plain dense algebra.
-- 1. Lemma 3.1: where λ_l < 0, p = −A⁺e_l has pᵀg = λ_l and Ap = −e_l, and f falls along it as (58) says.
-- 2. Remark 3.4 offers p instead of (76) where (75) has no solution. It does not replace (76): λ_l is there only if a row has
--    just been dropped; as Ap = −e_l no row becomes active on the way; so A_k stays, and with it (71), in which x does not
--    occur: (75) has no solution again, and at the least f along p there is no descent left along p. In integers: two masses
--    and a spring, x₁ ≥ 0, x₂ ≤ 10, d = (1, 1): from (0, 1) p leads to (2, 1) and f = −5/2, and no further; (76) to f* = −41/2.
-- 3. Theorem 3.3 by ranks, exact (modulo a prime above all minors). (i) holds. (ii) holds where dim N(C) ∩ N(A) = 1; with
--    more, aᵀs ≠ 0 takes one dimension off and K₊ stays singular: C = 0 of order 2, A empty, a = e₁ (misprint 105). That K₊ is
--    regular where K is needs rows that stay independent, as (42) has it.
-- 4. Remark 3.6: so k free bodies above a floor meet k singular systems in a row, at the least; counted in algorithm 3.1,
--    dotyk.qp and dotyk.solver.active_set (on blocks).
-- Draws images/papers_semicoercive_working_sets.png. PROGRAMS: random programs in 1 and 2; ten times as many matrices in 3.

local programs <const> = tonumber(arg[1]) or 2000
local common <const> = include "../../lib/common.lua"
local function cold(C, d, A, b) return dotyk.qp{ B = C, c = d, A = A, high = b, method = "active_set", start = "cold" } end

-- Dense algebra: a solution of Mx = rhs, nil where there is none, and a basis of the kernel.
local function zeros(n) local list = {} for k = 1, n do list[k] = 0 end return list end
local function dot(u, v) local sum = 0 for k, value in ipairs(u) do sum = sum + value * v[k] end return sum end
local function times(M, x) local y = {} for k, row in ipairs(M) do y[k] = dot(row, x) end return y end
local function add(x, factor, p) local y = {} for k, value in ipairs(x) do y[k] = value + factor * p[k] end return y end
local function stacked(C, A) return table.move(A, 1, #A, #C + 1, table.move(C, 1, #C, 1, {})) end
local function bordered(C, A) -- K
  local K, n = {}, #C
  for k, row in ipairs(C) do K[k] = table.move(row, 1, n, 1, {}) for i, a in ipairs(A) do K[k][n + i] = a[k] end end
  for i, a in ipairs(A) do K[n + i] = table.move(zeros(#A), 1, #A, n + 1, table.move(a, 1, n, 1, {})) end
  return K
end
local function solve(M, rhs, n)
  local m, pivot, done = {}, {}, 0
  for k, row in ipairs(M) do m[k] = table.move(row, 1, n, 1, {}) m[k][n + 1] = rhs[k] end
  for j = 1, n do
    local best = done + 1
    for k = done + 2, #m do if math.abs(m[k][j]) > math.abs(m[best][j]) then best = k end end
    if m[best] and math.abs(m[best][j]) > 1e-9 then
      done = done + 1
      m[best], m[done], pivot[j] = m[done], m[best], done
      for i = n + 1, j, -1 do m[done][i] = m[done][i] / m[done][j] end
      for k, row in ipairs(m) do if k ~= done and row[j] ~= 0 then m[k] = add(row, -row[j], m[done]) end end
    end
  end
  local x, kernel = {}, {}
  for j = 1, n do
    x[j] = pivot[j] and m[pivot[j]][n + 1] or 0
    if not pivot[j] then
      kernel[#kernel + 1] = {}
      for i = 1, n do kernel[#kernel][i] = i == j and 1 or pivot[i] and -m[pivot[i]][j] or 0 end
    end
  end
  for k = done + 1, #m do if math.abs(m[k][n + 1]) > 1e-7 then return nil, kernel end end
  return x, kernel
end
local function onto(vectors, rhs, n) -- Vᵀ(VVᵀ)⁻¹ rhs: the pseudo-inverse
  local gram, p = {}, zeros(n)
  for i, v in ipairs(vectors) do gram[i] = times(vectors, v) end
  for i, weight in ipairs((solve(gram, rhs, #rhs))) do p = add(p, weight, vectors[i]) end
  return p
end
local function unit(m, l, value) local e = zeros(m) e[l] = value return e end
local function rank(M, n) -- exact: every minor is less than the prime, by Hadamard's bound
  local m, done, prime, bound = {}, 0, 2147483647, 1.0
  for k, row in ipairs(M) do
    bound, m[k] = bound * math.max(1, math.sqrt(dot(row, row))), {}
    for j = 1, n do m[k][j] = row[j] % prime end
  end
  assert(bound < prime)
  for j = 1, n do
    local k = done + 1
    while m[k] and m[k][j] == 0 do k = k + 1 end
    if m[k] then
      done = done + 1
      m[k], m[done] = m[done], m[k]
      for i = done + 1, #m do
        local f, h = m[done][j], m[i][j]
        for c = j, n do m[i][c] = (m[i][c] * f - m[done][c] * h) % prime end
      end
    end
  end
  return done
end

-- Algorithm 3.1 from x, where the rows of `I` are active: f, and dim N(C) ∩ N(A_k), at each step. Calls on_drop(x, l, λ_l),
-- and on_none(x, event, rows) where (75) has no solution; event: "start", or a row was "added" or "dropped" before.
local function objective(q, x) return dot(x, times(q.C, x)) / 2 - dot(q.d, x) end
local function gradient(q, x) return add(times(q.C, x), -1, q.d) end
local function kkt(q, x, rows) -- (75)
  return (solve(bordered(q.C, rows), stacked(add(zeros(#x), -1, gradient(q, x)), zeros(#rows)), #x + #rows))
end
local function algorithm(q, x, I, on_drop, on_none)
  local A, b, n, event, f, dimensions = q.A, q.b, #x, "start", {}, {}
  for _ = 1, 200 do
    local rows, index = {}, {}
    for i = 1, #A do if I[i] then rows[#rows + 1], index[#index + 1] = A[i], i end end
    local _, kernel = solve(stacked(q.C, rows), zeros(n + #rows), n)
    local solution = kkt(q, x, rows)
    f[#f + 1], dimensions[#dimensions + 1] = objective(q, x), #kernel
    local p, alpha, r = solution and table.move(solution, 1, n, 1, {}), math.huge, nil
    if not solution then
      if on_none then on_none(x, event, rows) end
      local weights = times(kernel, q.d)
      p = zeros(n)
      for k, z in ipairs(kernel) do p = add(p, weights[k] / dot(weights, weights), z) end -- dᵀp = 1
    end
    for i = 1, #A do
      local rate = dot(A[i], p)
      if not I[i] and rate > 1e-9 and (b[i] - dot(A[i], x)) / rate < alpha then alpha, r = (b[i] - dot(A[i], x)) / rate, i end
    end
    assert(solution or r, "unbounded")
    local length = solution and math.min(1, alpha) or alpha
    x = add(x, length, p)
    if length == alpha then I[r], event = true, "added"
    else
      local least, l = -1e-9, nil
      for k, i in ipairs(index) do if solution[n + k] < least then least, l = solution[n + k], i end end
      if not l then
        f[#f + 1] = objective(q, x)
        return f, dimensions
      end
      if on_drop then on_drop(x, l, least) end
      I[l], event = nil, "dropped"
    end
  end
  error "algorithm 3.1 does not end"
end

-- Random chains of springs and independent rows.
local seed = 1
local function random(n) seed = (seed * 48271) % 2147483647 return seed % n + 1 end -- Lehmer
local function chains(lengths)
  local C, n = {}, 0
  for _, length in ipairs(lengths) do n = n + length end
  for k = 1, n do C[k] = zeros(n) end
  local k = 0
  for _, length in ipairs(lengths) do
    for _ = 2, length do
      k = k + 1
      C[k][k], C[k + 1][k + 1], C[k][k + 1], C[k + 1][k] = C[k][k] + 1, 1, -1, -1
    end
    k = k + 1
  end
  return C, n
end
local function random_case(most) -- C, A, and one more row; with n
  local lengths, A, a = {}, {}, nil
  for k = 1, random(4) do lengths[k] = random(3) end
  local C, n = chains(lengths)
  for _ = 0, random(most) do
    if a then A[#A + 1], a = a, nil end
    local row, i, j = zeros(n), random(n), random(n)
    row[i], row[j] = -1, i == j and -1 or random(2) - 1
    if rank(stacked(A, { row }), n) == #A + 1 then a = row end
  end
  return C, A, a, n
end

-- 1 and 2. Random programs that have a solution: d = Cz + Aᵀλ with λ ≥ 0.
local count <const> = { dropped = 0, none = 0, start = 0, added = 0, after = 0, stopped = 0 }
for _ = 1, programs do
  local C, A, _, n = random_case(8)
  local z, b, I = {}, {}, {}
  for k = 1, n do z[k] = random(9) - 5 end
  local d = times(C, z)
  for i, row in ipairs(A) do
    d = add(d, random(5) - 1, row)
    b[i] = random(2) == 1 and 0 or random(6)
    I[i] = b[i] == 0 or nil
  end
  local q, p = { C = C, d = d, A = A, b = b }, nil
  local f = algorithm(q, zeros(n), I, function(x, l, multiplier)
    p = onto(A, unit(#A, l, -1), n)
    local curvature, slope, Ap = dot(p, times(C, p)), dot(p, gradient(q, x)), times(A, p)
    assert(math.abs(slope - multiplier) < 1e-8 and curvature > 1e-9)
    for i, rate in ipairs(Ap) do assert(math.abs(rate + (i == l and 1 or 0)) < 1e-9) end
    local fall = objective(q, add(x, -slope / curvature, p)) - objective(q, x) -- (58) at its least
    assert(fall < 0 and math.abs(fall + slope^2 / curvature / 2) < 1e-8 * (1 - fall))
    count.dropped = count.dropped + 1
  end, function(x, event, rows)
    count.none = count.none + 1
    if event ~= "dropped" then count[event] = count[event] + 1 return end
    local there = add(x, -dot(p, gradient(q, x)) / dot(p, times(C, p)), p)
    assert(not kkt(q, there, rows) and math.abs(dot(p, gradient(q, there))) < 1e-8)
    count.after = count.after + 1
  end)
  if #A > 0 then
    local r = cold(C, d, A, b)
    if not r.converged then
      count.stopped = count.stopped + 1
      r = dotyk.qp{ B = C, c = d, A = A, high = b, method = "active_set", start = "interior_point" }
    end
    assert(r.converged and math.abs(r.objective - f[#f]) < 1e-7 * (1 + math.abs(f[#f])), r.reason)
  end
end
print(("%d programs: algorithm 3.1 ends at the f of dotyk.qp, which stops short of it in %d from a cold start"):format(programs, count.stopped))
print(("lemma 3.1 and (58) hold at %d points with λ_l < 0"):format(count.dropped))
print(("remark 3.4: (75) has no solution %d times: %d at the start, %d after a row was added, with no λ_l, and %d after one was dropped:\n"
  .. "  a step along p, and (75) has no solution again, each time"):format(count.none, count.start, count.added, count.after))
assert(count.none == count.start + count.added + count.after and math.min(count.start, count.added, count.after) > 0)
local two <const> = { C = { {1, -1}, {-1, 1} }, d = {1, 1}, A = { {-1, 0}, {0, 1} }, b = {0, 10} } -- the example in integers
local by76 <const>, by34 = algorithm(two, {0, 0}, { true }), { 0, -1 / 2 }
local x = { 0, 1 }
for k = 3, 6 do
  local p = onto(two.A, { -1, 0 }, 2)
  x = add(x, -dot(p, gradient(two, x)) / dot(p, times(two.C, p)), p)
  assert(not kkt(two, x, {}))
  by34[k] = objective(two, x)
end
print(("two masses: f by (76) %s; by remark 3.4 %s"):format(table.concat(by76, ", "), table.concat(by34, ", ")))
assert(by76[#by76] == -41 / 2 and by34[6] == -5 / 2 and math.abs(cold(two.C, two.d, two.A, two.b).objective + 41 / 2) < 1e-9)

-- 3. Theorem 3.3: A without and with one row more.
local tried, by_dimension = 0, {}
for _ = 1, 10 * programs do
  local C, A, a, n = random_case(4)
  if a then
    local more = stacked(A, { a })
    local free, freed = n - rank(stacked(C, A), n), n - rank(stacked(C, more), n) -- dimensions of N(C) ∩ N(A), N(C) ∩ N(A₊)
    local works = freed < free -- aᵀs ≠ 0 for some s in N(C) ∩ N(A)
    local regular, regular_more = rank(bordered(C, A), n + #A) == n + #A, rank(bordered(C, more), n + #more) == n + #more
    assert(regular == (free == 0) and freed >= free - 1)
    if regular_more then -- (i), with A₊ for its A
      assert(not regular == works)
      tried = tried + 1
    end
    if regular then assert(regular_more)
    else
      by_dimension[free] = by_dimension[free] or { all = 0, works = 0, regular = 0 }
      local row = by_dimension[free]
      row.all, row.works, row.regular = row.all + 1, row.works + (works and 1 or 0), row.regular + (regular_more and 1 or 0)
      assert(regular_more == (works and free == 1)) -- (ii) corrected
    end
  end
end
print(("\ntheorem 3.3 (i) holds in %d cases; (ii):\ndim N(C) ∩ N(A)   K singular   aᵀs ≠ 0   K₊ regular"):format(tried))
for free, row in ipairs(by_dimension) do print(("%15d  %11d  %8d  %11d"):format(free, row.all, row.works, row.regular)) end
assert(#by_dimension > 2 and by_dimension[1].regular == by_dimension[1].works and by_dimension[2].works > 0 and by_dimension[2].regular == 0)
local nothing <const> = { {0, 0}, {0, 0} }
local order_of_105 <const> = rank(bordered(nothing, { {1, 0} }), 3)
print(("misprint 105: C = 0 of order 2, a = e₁: aᵀe₁ = 1, and the rank of K₊ is %d of 3"):format(order_of_105))
assert(order_of_105 == 2)

-- 4. Bodies above a floor, at distances 1, 2, …, and what falls on it.
local stairs, least = {}, true
print "\nfree bodies   singular systems: algorithm 3.1   dotyk.qp   dotyk.solver.active_set"
for free = 1, 5 do
  local lengths, A, b, bodies = {}, {}, {}, {}
  for k = 1, free do lengths[k] = 2 end
  local C, n = chains(lengths)
  for k = 1, free do
    A[k], b[k] = unit(n, 2 * k - 1, -1), k
    bodies[k] = dotyk.body{ name = "block " .. k, material = dotyk.material{ E = 1000, nu = 0.3 },
      mesh = dotyk.mesh.rectangle{ from = {2 * k, 0}, to = {2 * k + 1, 1}, cells = {2, 2}, element = "Q1" } }
    bodies[k]:part"left":fix "x"
    bodies[k]:part"top":load{ 0, -1 }
  end
  local scene = dotyk.scene(bodies)
  for k, body in ipairs(bodies) do scene:contact{ body:part"bottom", rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = 0.01 * k } } end
  local d = {}
  for k = 1, n do d[k] = -1 end
  local _, dimensions = algorithm({ C = C, d = d, A = A, b = b }, zeros(n), {})
  local r, s, singular = cold(C, d, A, b), dotyk.solver.active_set{}:solve(scene), 0
  stairs[free] = common.curve(("%d free"):format(free))
  for k, dimension in ipairs(dimensions) do
    singular = singular + (dimension > 0 and 1 or 0)
    stairs[free]:add(k, dimension)
  end
  print(("%11d  %32d  %9d  %24d"):format(free, singular, r.singular, s.working_set.singular))
  assert(r.converged and s.converged)
  least = least and singular == free and math.min(r.singular, s.working_set.singular) >= free
end

local function curve(name, f)
  local line = common.curve(name)
  for k, value in ipairs(f) do line:add(k - 1, value) end
  return line
end
local works, regular = common.curve "aᵀs ≠ 0", common.curve "K₊ regular"
for free, row in ipairs(by_dimension) do
  works:add(free, row.works / row.all)
  regular:add(free, row.regular / row.all)
end
dotyk.chart{ file = "images/papers_semicoercive_working_sets.png", columns = 3, size = { 2100, 800 }, panels = {
  { title = "Remark 3.4: two masses", x = "step", y = "objective f", x_range = { -0.2, 5.2 }, y_range = { -22, 1 },
    series = { curve("by (76)", by76), curve("by lemma 3.1", by34) } },
  { title = "Theorem 3.3 (ii)", x = "dim N(C) ∩ N(A)", y = "share of the cases", series = { works, regular }, y_range = { -0.05, 1.05 } },
  { title = "Remark 3.6: free bodies", y_range = { -0.3, 5.3 }, x = "step of algorithm 3.1", y = "dim N(C) ∩ N(A)", series = stairs },
} }
print "images/papers_semicoercive_working_sets.png"
common.verdict(least, ("lemma 3.1 and theorem 3.3 (i) hold throughout; (ii) holds for one free motion only, and k free bodies meet at least k singular systems; "
  .. "of %d times that (75) has no solution, remark 3.4 offers a direction %d times, and (75) has none after it"):format(count.none, count.after))
