-- Multigrid on an active set: coarse functions truncated at contact, or a filter around a hierarchy?
--
--   ./dotyk scripts/studies/methods/truncation.lua [FINEST]
--
-- A square in plane strain, N² cells (Q1), its bottom fixed, a load per volume. Nodes of its top in contact may not move along the normal n. Conjugate
-- gradients to 1e-8 for A, which is K without the held unknowns (where n is oblique, in normal and tangential unknowns), or K + κ d nnᵀ, d from K's
-- diagonal. A cycle: meshes down to 4² cells, coarse matrices PᵀAP, one sweep of Gauss and Seidel down, one up. All of it is in Lua, below.
--
--   truncation            P's rows of held unknowns are empty: coarse functions vanish there. Only coarse rows near contact are computed anew
--   K's cycle             K's hierarchy, made once for all active sets
--   filter, K's, filter   F = A⁻¹ on the unknowns that contact couples. x = Fb, then x += K's cycle for b − Ax, then x += F(b − Ax)
--   4 layers              the same, F on three more layers of nodes
--   own cycle             the hierarchy of the penalised A, P as it is; where unknowns are held, own means truncation in the next two
--   filter, own, filter
--   own, filter, own      the order of Petrides and others, AMG with filtering (arXiv 2505.18576), and of MFEM's AMGFSolver: AMG is made for A there, not K
--
-- Printed: iterations; the condition of the preconditioned matrix where unknowns are held, by Lanczos; the work at the largest N in products with K, of
-- an iteration, for a new active set, and of both together (where unknowns are held; of the own cycle for κ = 1e6). The work is entries of matrices
-- and factors that are read, and multiplications for new coarse matrices and factors.
--
-- What the numbers say. Truncation takes 10 to 13 iterations on every mesh (up to 128²), and nothing does less work. Filters hardly notice κ. About
-- K's cycle their condition doubles with N, or nearly: a smooth load at depth h below contact moves a held body by some h, a free one by much more,
-- and K's hierarchy knows only the free one. With more layers the condition is smaller, and grows all the same. The own cycle is slow where rows are
-- oblique and κ is large (else about as good as truncation); a filter mends it. About truncation a filter changes nothing. A filter between two
-- truncated cycles takes the fewest iterations, but has two cycles in each: a third more work. For a new set truncation computes a part of a product,
-- a filter about K's cycle only a factor: in the plane even less. In space that factor has N² unknowns and takes N³ operations (nested dissection),
-- like a product up to a constant, and is hard to share among processes.

local dense <const> = include "../../lib/dense.lua"
local finest <const> = math.max(16, tonumber(arg[1]) or 64)
local work = 0

local function zeros(n) local x = {} for i = 1, n do x[i] = 0.0 end return x end
local function add(row, j, value) row[j] = (row[j] or 0) + value end

-- Sparse: columns at[i], ascending, and values by[i] of row i; the diagonal.
local function matrix(rows, columns)
  local A = { n = #rows, columns = columns or #rows, at = {}, by = {}, diagonal = {} }
  for i, row in ipairs(rows) do
    local at, by = {}, {}
    for j in pairs(row) do at[#at + 1] = j end
    table.sort(at)
    for k, j in ipairs(at) do by[k] = row[j] end
    A.at[i], A.by[i], A.diagonal[i] = at, by, row[i]
  end
  return A
end
local function residuals(A, b, x, list) -- b − Ax; where a list is given, of these rows only
  local r, AT <const>, BY <const> = table.move(b, 1, A.n, 1, {}), A.at, A.by
  for k = 1, list and #list or A.n do
    local i <const> = list and list[k] or k
    local at <const>, by <const>, sum = AT[i], BY[i], b[i]
    for l = 1, #at do sum = sum - by[l] * x[at[l]] end
    r[i], work = sum, work + #at
  end
  return r
end
local function sweep_down(A, b) -- of Gauss and Seidel, from 0: x, and b − Ax, which is what lies behind the diagonal
  local x, r = {}, {}
  for i = 1, A.n do
    local at <const>, by <const>, sum, l = A.at[i], A.by[i], b[i], 1
    while at[l] < i do sum, l = sum - by[l] * x[at[l]], l + 1 end
    x[i], work = sum / by[l], work + l
  end
  for i = 1, A.n do
    local at <const>, by <const>, sum, l = A.at[i], A.by[i], 0.0, #A.at[i]
    while at[l] > i do sum, l = sum - by[l] * x[at[l]], l - 1 end
    r[i], work = sum, work + #at - l
  end
  return x, r
end
local function sweep_up(A, b, x)
  for i = A.n, 1, -1 do
    local at <const>, by <const>, sum = A.at[i], A.by[i], b[i]
    for l = 1, #at do sum = sum - by[l] * x[at[l]] end
    x[i], work = x[i] + sum / A.diagonal[i], work + #at
  end
end
local function interpolate(P, e, x) -- x += Pe
  for i = 1, P.n do local at, by = P.at[i], P.by[i] for k = 1, #at do x[i] = x[i] + by[k] * e[at[k]] end end
  return x
end
local function restrict(P, r) -- Pᵀr
  local c = zeros(P.columns)
  for i = 1, P.n do local at, by = P.at[i], P.by[i] for k = 1, #at do c[at[k]] = c[at[k]] + by[k] * r[i] end end
  return c
end

-- 1. K and interpolation. Nodes (i, j), 0 ≤ i ≤ N, 1 ≤ j ≤ N, each with components c = 1, 2.
local function unknown(N, i, j, c) return 2 * ((j - 1) * (N + 1) + i) + c end
local function integral(i, j, a, b) -- over (0, 1) of φ_i φ_j for φ_0 = 1 − x, φ_1 = x; with a, b of the derivatives
  local s, t <const> = 2 * i - 1, 2 * j - 1
  return a and b and s * t or a and s / 2 or b and t / 2 or (2 + s * t) / 6 - (i == j and 1 / 6 or 0)
end
local function stiffness(N)
  local lambda, mu <const>, rows = 0.3 / (1.3 * 0.4), 0.5 / 1.3, {} -- E = 1, ν = 0.3
  for i = 1, 2 * N * (N + 1) do rows[i] = {} end
  for a = 0, 3 do for b = 0, 3 do for c = 1, 2 do for d = 1, 2 do -- node a's component c, b's d
    local function both(c, d) return integral(a % 2, b % 2, c == 1, d == 1) * integral(a // 2, b // 2, c == 2, d == 2) end
    local value <const> = lambda * both(c, d) + mu * both(d, c) + (c == d and mu * (both(1, 1) + both(2, 2)) or 0)
    for y = 0, N - 1 do for x = 0, N - 1 do
      if y + a // 2 > 0 and y + b // 2 > 0 then add(rows[unknown(N, x + a % 2, y + a // 2, c)], unknown(N, x + b % 2, y + b // 2, d), value) end
    end end
  end end end end
  return matrix(rows)
end
local function interpolation(N) -- from N/2, linear
  local rows = {}
  for j = 1, N do for i = 0, N do for c = 1, 2 do
    local row = {}
    for q = math.max(1, j // 2), (j + 1) // 2 do
      for p = i // 2, (i + 1) // 2 do row[unknown(N // 2, p, q, c)] = 1 / ((1 + i % 2) * (1 + j % 2)) end
    end
    rows[#rows + 1] = row
  end end end
  return matrix(rows, N // 2 * (N + 2))
end

-- 2. PᵀAP. Given the old one, only rows that depend on changed rows of A; also says which.
local function galerkin(A, P, changed, old)
  local support, anew, rows = {}, {}, {}
  for I = 1, P.columns do support[I], rows[I] = {}, {} end
  for i = 1, A.n do
    for k, I in ipairs(P.at[i]) do
      table.insert(support[I], { i, P.by[i][k] })
      anew[I] = anew[I] or not old or changed[i]
    end
  end
  for I = 1, P.columns do
    for _, pair in ipairs(anew[I] and support[I] or {}) do
      for k, j in ipairs(A.at[pair[1]]) do
        local value, by <const> = pair[2] * A.by[pair[1]][k], P.by[j]
        for l, J in ipairs(P.at[j]) do add(rows[I], J, value * by[l]) end
        work = work + #by
      end
    end
    if not next(rows[I]) then rows[I][I] = 1 end -- the function vanishes
  end
  local C = matrix(rows)
  for I = 1, old and C.n or 0 do if not anew[I] then C.at[I], C.by[I], C.diagonal[I] = old.at[I], old.by[I], old.diagonal[I] end end
  return C, anew
end

-- By Cholesky's factor, each row from its first entry on: b ↦ A⁻¹b on the unknowns of a list, 0 elsewhere.
local function factor(A, list)
  local place, L, first = {}, {}, {}
  for k, i in ipairs(list) do place[i] = k end
  for k, i in ipairs(list) do
    local row, from = {}, k
    for l, j in ipairs(A.at[i]) do if (place[j] or k + 1) <= k then row[place[j]], from = A.by[i][l], math.min(from, place[j]) end end
    L[k], first[k] = row, from
    for j = from, k do
      local sum, other, begin = row[j] or 0, L[j], math.max(from, first[j])
      for m = begin, j - 1 do sum = sum - row[m] * other[m] end
      row[j], work = j < k and sum / other[j] or math.sqrt(sum), work + j - begin + 1
    end
  end
  return function(b)
    local x, y = zeros(#b), {}
    for k, row in ipairs(L) do
      local sum = b[list[k]]
      for m = first[k], k - 1 do sum = sum - row[m] * y[m] end
      y[k], work = sum / row[k], work + 2 * (k - first[k] + 1)
    end
    for k = #list, 1, -1 do
      local row, value = L[k], y[k] / L[k][k]
      for m = first[k], k - 1 do y[m] = y[m] - row[m] * value end
      x[list[k]] = value
    end
    return x
  end
end

-- A V-cycle; of an `old` hierarchy all is kept that does not depend on changed rows of A.
local function hierarchy(A, P, changed, old)
  local H, all = { A }, {}
  for l = 1, #P do H[l + 1], changed = galerkin(H[l], P[l], changed, old and old[l + 1]) end
  for i = 1, H[#H].n do all[i] = i end
  local coarsest <const> = factor(H[#H], all)
  function H.cycle(b, level)
    local l <const> = level or 1
    if l == #H then return coarsest(b) end
    local x <const>, r <const> = sweep_down(H[l], b)
    interpolate(P[l], H.cycle(restrict(P[l], r), l + 1), x)
    sweep_up(H[l], b, x)
    return x
  end
  return H
end

-- First, second, first, each on what the one before leaves; of this residual only the rows in two lists are new, without a list all.
local function symmetric(A, first, second, for_second, for_first)
  local function go_on(b, x, step, list)
    for i, e in ipairs(step(residuals(A, b, x, list))) do x[i] = x[i] + e end
    return x
  end
  return function(b) return go_on(b, go_on(b, first(b), second, for_second), first, for_first) end
end

local function dot(u, v) local sum = 0 for i = 1, #u do sum = sum + u[i] * v[i] end return sum end
local function solve(A, b, precondition) -- x, iterations, and Lanczos' matrix
  local x, r, p, rz, zero <const> = zeros(A.n), table.move(b, 1, A.n, 1, {}), zeros(A.n), nil, zeros(A.n)
  local steps, ratios = {}, {}
  for iteration = 1, 1000 do
    local z = precondition(r)
    local new <const> = dot(r, z)
    local ratio <const> = rz and new / rz or 0
    for i = 1, A.n do p[i] = z[i] + ratio * p[i] end
    local minus <const> = residuals(A, zero, p) -- −Ap
    local step <const> = -new / dot(p, minus)
    for i = 1, A.n do x[i], r[i] = x[i] + step * p[i], r[i] + step * minus[i] end
    rz, steps[iteration], ratios[iteration] = new, step, ratio
    if dot(r, r) <= 1e-16 * dot(b, b) then
      return x, iteration, function(i, j)
        local k <const> = math.max(i, j)
        return i == j and 1 / steps[k] + (k > 1 and ratios[k] / steps[k - 1] or 0) or math.abs(i - j) == 1 and math.sqrt(ratios[k]) / steps[k - 1] or 0
      end
    end
  end
  error "no convergence"
end

-- 3. The comparison. found[part][method][κ][k]: iterations and work on mesh k; κ = 0 where unknowns are held.
local parts <const> = { "middle third", "every other node of it", "middle third, oblique", "whole top" }
local names <const> = { "truncation", "K's cycle", "filter, K's, filter", "4 layers", "own cycle", "filter, own, filter", "own, filter, own" }
local meshes <const>, found <const>, apart = {}, {}, 0
for N = 16, finest do if N & N - 1 == 0 then meshes[#meshes + 1] = N end end
for _, part in ipairs(parts) do
  found[part] = {}
  for _, name in ipairs(names) do found[part][name] = { [0] = {}, [1e2] = {}, [1e6] = {} } end
end

for mesh, N in ipairs(meshes) do
  local K <const>, P <const>, f <const>, entries, M = stiffness(N), {}, {}, 0, N
  while M > 4 do P[#P + 1], M = interpolation(M), M // 2 end
  for i = 1, K.n do
    local node <const> = (i - 1) // 2
    f[i] = (i % 2 == 1 and 0.3 or -1) * (node % (N + 1) % N == 0 and 0.5 or 1) * (node >= (N - 1) * (N + 1) and 0.5 or 1)
    entries = entries + #K.at[i]
  end
  local of_K <const> = hierarchy(K, P)
  local function ring(set) -- what these unknowns couple to
    local wider = {}
    for i in pairs(set) do for _, j in ipairs(K.at[i]) do wider[j] = true end end
    return wider
  end
  local function list_of(set, without) -- column of nodes by column, so that factors have few entries
    local list = {}
    for i in pairs(set) do if not without[i] then list[#list + 1] = i end end
    local function order(i) return (i - 1) // 2 % (N + 1) * K.n + i end
    table.sort(list, function(a, b) return order(a) < order(b) end)
    return list
  end

  for _, part in ipairs(parts) do
    local angle <const> = part:find "oblique" and 0.5 or 0 -- of n from the vertical
    local S, PS, contact, normal = {}, {}, {}, {} -- S: columns are tangential unknowns at contact; normal: the second of each node there
    for i = 1, K.n do S[i], PS[i] = { [i] = 1 }, {} end
    for i = 0, N do
      if part == "whole top" or 3 * i >= N and 3 * i <= 2 * N and (i % 2 == 1 or not part:find "every") then
        local u <const>, v <const> = unknown(N, i, N, 1), unknown(N, i, N, 2)
        S[u], S[v], contact[u], contact[v], normal[v] = { [u] = math.cos(angle) }, { [u] = -math.sin(angle) }, true, true, true
      end
    end
    S = matrix(S)
    for i = 1, K.n do for k, j in ipairs(S.at[i]) do for l, J in ipairs(P[1].at[i]) do add(PS[j], J, S.by[i][k] * P[1].by[i][l]) end end end
    local near <const> = ring(contact)
    local deep <const> = ring(ring(ring(near)))

    for _, kappa in ipairs{ 0, 1e2, 1e6 } do
      local A, b, without, cycle, own = nil, f, {}, of_K.cycle, nil
      if kappa == 0 then
        A, b, without = galerkin(K, S), restrict(S, f), normal
        function cycle(r) return restrict(S, of_K.cycle(interpolate(S, r, zeros(K.n)))) end
        function own() return hierarchy(A, { matrix(PS, P[1].columns), table.unpack(P, 2) }, near, of_K).cycle end
      else
        local rows = {}
        for i = 1, K.n do rows[i] = {} for k, j in ipairs(K.at[i]) do rows[i][j] = K.by[i][k] end end
        for v in pairs(normal) do
          local n <const> = { [v - 1] = math.sin(angle), [v] = math.cos(angle) }
          for i, p in pairs(n) do for j, q in pairs(n) do add(rows[i], j, kappa * K.diagonal[v] * p * q) end end
        end
        A = matrix(rows)
        function own() return hierarchy(A, P, contact, of_K).cycle end
      end
      local list <const>, reach <const> = list_of(near, without), list_of(ring(near), without)
      local thick <const>, beyond <const> = list_of(deep, without), list_of(ring(deep), without)
      local ways <const>, first = {
        [kappa == 0 and "truncation" or "own cycle"] = own,
        ["K's cycle"] = function() return cycle end,
        ["filter, K's, filter"] = function() return symmetric(A, factor(A, list), cycle, reach, list) end,
        ["4 layers"] = function() return symmetric(A, factor(A, thick), cycle, beyond, thick) end,
        ["filter, own, filter"] = function() return symmetric(A, factor(A, list), own(), reach, list) end,
        ["own, filter, own"] = function() return symmetric(A, own(), factor(A, list), list) end }, nil
      for _, name in ipairs(names) do
        if ways[name] then
          work = 0
          local precondition <const> = ways[name]()
          local new <const> = work / entries
          local x <const>, iterations <const>, lanczos <const> = solve(A, b, precondition)
          local one <const> = { iterations = iterations, new = new, all = work / entries }
          found[part][name][kappa][mesh] = one
          if kappa == 0 then
            local values <const> = dense.eigenvalues(dense.matrix(iterations, iterations, lanczos))
            one.condition = values[iterations] / values[1]
          end
          local largest, off = 0, 0
          first = first or x
          for i = 1, A.n do largest, off = math.max(largest, math.abs(first[i])), math.max(off, math.abs(x[i] - first[i])) end
          apart = math.max(apart, off / largest)
        end
      end
    end
  end
end

-- 4. The table, and what is asserted.
local function padded(text, width) return text .. (" "):rep(width - utf8.len(text)) end
local function columns(value) -- of each mesh
  local texts = {}
  for mesh in ipairs(meshes) do texts[mesh] = ("%5s"):format(value(mesh) or "") end
  return table.concat(texts) .. "  "
end
local function field(of, name, format) return function(mesh) return of[mesh] and of[mesh][name] and format:format(of[mesh][name]) end end
local line = padded("", 20)
for _, title in ipairs{ "held", "κ = 1e2", "κ = 1e6", "condition" } do line = line .. padded(" " .. title, 5 * #meshes + 2) end
print(line .. " products with K")
print(padded("N =", 20) .. columns(function(mesh) return meshes[mesh] end):rep(4) .. " iteration  new set  together")
for _, part in ipairs(parts) do
  print("\n" .. part)
  for _, name in ipairs(names) do
    local of <const> = found[part][name]
    line = padded(name, 20)
    for _, kappa in ipairs{ 0, 1e2, 1e6 } do line = line .. columns(field(of[kappa], "iterations", "%d")) end
    local last <const> = of[0][#meshes] or of[1e6][#meshes]
    print(line .. columns(field(of[0], "condition", "%.3g")) .. ("%10.1f  %7.2f  %8.0f"):format((last.all - last.new) / last.iterations, last.new, last.all))
  end
end
print(("\nsolutions of one system differ by %.0e"):format(apart))
assert(apart < 1e-6)
for mesh in ipairs(meshes) do
  for _, part in ipairs(parts) do
    local truncation <const>, filter <const> = found[part].truncation[0], found[part]["filter, K's, filter"]
    assert(truncation[mesh].iterations <= truncation[1].iterations + 2 and truncation[mesh].condition < 2.5)
    for _, name in ipairs{ "K's cycle", "filter, K's, filter", "4 layers" } do
      local other <const> = found[part][name][0]
      assert(truncation[mesh].iterations <= other[mesh].iterations and truncation[mesh].all < other[mesh].all)
      if mesh > 1 and part == "whole top" then assert(math.abs(other[mesh].condition / other[mesh - 1].condition - 2) < 0.3) end
    end
    assert(truncation[mesh].all < found[part]["own, filter, own"][0][mesh].all)
    assert(filter[1e6][mesh].iterations <= 1.25 * filter[0][mesh].iterations + 2)
  end
  local own <const> = "own cycle"
  assert(found[parts[3]][own][1e6][mesh].iterations > 2 * found[parts[1]][own][1e6][mesh].iterations) -- oblique
end
