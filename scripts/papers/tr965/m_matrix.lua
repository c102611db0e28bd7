-- Theorem 1.4 of TR965 on contact matrices: is Q̂ = (B̂ Â⁻¹ B̂ᵀ)⁻¹ an M-matrix up to a small perturbation, and what does PDAS do?
--
--   ./dotyk scripts/papers/tr965/m_matrix.lua [FINEST]
--
-- An elastic body meets a rigid plane along its top, −1 ≤ x ≤ 1, P1 elements, n cells along it, one row per node, m rows. Two
-- equal bodies, one the mirror image of the other, have Q̂/2: all numbers below are theirs too.
-- 1. Q̂ from the program: a load case for each node, its hat function as a normal traction, displaces the nodes by U = Q̂⁻¹M, M
--    the mass matrix of the hat functions; so Q̂ = M U⁻¹. Checks: Q̂ is symmetric, and the complementarity problem of a
--    parabola pressed into the top has the nodal forces of dotyk.solve.
-- 2. The hypothesis: Q̂ = K̂ + P̂, P̂ the positive entries off the diagonal, so K̂ is an M-matrix if K̂⁻¹ ≥ 0, and no other M-matrix
--    leaves a smaller ‖P̂‖₁. ‖K̂⁻¹‖₁‖P̂‖₁ is the size of the perturbation.
-- 3. How small is small? In a step of PDAS let δ = v̂⁽ᵏ⁺¹⁾ − v̂⁽ᵏ⁾. From the second step on (1.69) gives λ⁽ᵏ⁾ ≤ 0 on the new set I,
--    δ = −v̂⁽ᵏ⁾ ≤ 0 on A, and (1.68) Q̂_II δ_I = λ⁽ᵏ⁾_I − Q̂_IA δ_A. So the sum of v̂ falls until the solution is met if
--        1ᵀ(Q̂_II)⁻¹ > 0  and  1ᵀ(Q̂_II)⁻¹Q̂_IA < 1ᵀ  for every set I and its complement A:
--    no set comes twice, and PDAS converges from every start for every load. The margin is the least of all entries of
--    1ᵀ(Q̂_II)⁻¹, times the diagonal's entry, and of 1ᵀ − 1ᵀ(Q̂_II)⁻¹Q̂_IA; it is 1 for M-matrices. Over all 2ᵐ sets for m ≤ 9,
--    in floating point; for 9 < m ≤ 33 the least that exchanges of single rows find from six random sets.
-- 4. PDAS (dotyk.lcp's newton_min) for random loads q̂ and for random gaps, from random first sets: how often does a set come
--    twice? (Between two walls it does: scripts/studies/stability/cycling.lua.)
-- Prints tables and draws images/papers_m_matrix.png. FINEST: the largest n in the plane.

local finest <const> = tonumber(arg[1]) or 64
local common <const> = include "../../lib/common.lua"
local state = 12345
local function random() -- in (−1, 1), the same in every run
  state = (state * 1103515245 + 12345) % 2147483648
  return state / 1073741824 - 1
end

local function inverse(A)
  local n, a, r = #A, {}, {}
  for i = 1, n do
    a[i] = { table.unpack(A[i]) }
    for j = 1, n do a[i][n + j] = i == j and 1 or 0 end
  end
  for k = 1, n do
    local p = k
    for i = k + 1, n do if math.abs(a[i][k]) > math.abs(a[p][k]) then p = i end end
    a[k], a[p] = a[p], a[k]
    local pivot = a[k]
    local scale = 1 / pivot[k]
    for j = k, n + k do pivot[j] = pivot[j] * scale end
    for j = n + k + 1, 2 * n do if pivot[j] ~= 0 then pivot[j] = pivot[j] * scale end end
    for i = 1, n do
      local row = a[i]
      local f = row[k]
      if i ~= k and f ~= 0 then for j = k, 2 * n do row[j] = row[j] - f * pivot[j] end end
    end
  end
  for i = 1, n do r[i] = { table.unpack(a[i], n + 1, 2 * n) } end
  return r
end
local function norm(A) -- ‖A‖₁
  local most = 0
  for j = 1, #A do
    local sum = 0
    for i = 1, #A do sum = sum + math.abs(A[i][j]) end
    most = math.max(most, sum)
  end
  return most
end

-- 1. The matrices.
local cases <const> = {
  { name = "block 2:1", depth = 1 }, { name = "block 2:1, ν = 0", depth = 1, nu = 0 }, { name = "square", depth = 2 },
  { name = "block 2:2:1 in space", depth = 1, space = true }, { name = "strip 8:1, held at one end", depth = 1 / 4, cantilever = true } }
local function body_of(case, n)
  local down = math.max(1, math.floor(n * case.depth / 2))
  local mesh = case.space and dotyk.mesh.box{ from = {-1, -1, -case.depth}, to = {1, 1, 0}, cells = {n, n, down} }
    or dotyk.mesh.rectangle{ from = {-1, -case.depth}, to = {1, 0}, cells = {n, down} }
  local body = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1000, nu = case.nu or 0.3 } }
  body:part(case.cantilever and "left" or "bottom"):fix()
  return body
end
local function matrices(case, n) -- Q̂, its inverse W, and the places of the rows
  local body, h, nodes, row, loads = body_of(case, n), 2 / n, {}, {}, {}
  local d <const> = case.space and 3 or 2
  for j = 0, case.space and n or 0 do
    for i = case.cantilever and 1 or 0, n do -- a node that is held has no row: Γ_c and Γ_u do not meet
      local k <const> = #nodes + 1
      nodes[k], row[i + j * (n + 1)], loads[k] = { i * h - 1, j * h - 1 }, k, "node " .. k
      body:part"top":load(function(x, y)
        local a <const>, b <const> = (x + 1) / h - i, case.space and (y + 1) / h - j or 0
        local hat <const> = math.max(0, 1 - math.max(math.abs(a), math.abs(b), math.abs(a - b)))
        if d == 2 then return 0, hat end
        return 0, 0, hat
      end, loads[k])
    end
  end
  local m, U, M = #nodes, {}, {}
  for k = 1, m do
    U[k], M[k] = {}, {}
    for l = 1, m do M[k][l] = 0 end
  end
  local solved <const> = dotyk.repeated_systems{ scene = dotyk.scene{ body }, loads = loads }
  for k = 1, m do
    for _, node in ipairs(solved:nodes(k)) do
      local i, j = (node[1] + 1) / h + 0.5, case.space and (node[2] + 1) / h + 0.5 or 0
      local here = math.abs(node[d]) < 1e-9 and row[math.floor(i) + math.floor(j) * (n + 1)]
      if here then U[here][k] = node[2 * d] end
    end
  end
  local function face(size, ...) -- on its corners; those that are held have no row
    local corners <const> = { ... }
    for _, a in ipairs(corners) do
      for _, b in ipairs(corners) do
        if row[a] and row[b] then M[row[a]][row[b]] = M[row[a]][row[b]] + size * (a == b and 2 or 1) end
      end
    end
  end
  for j = 0, case.space and n - 1 or 0 do
    for i = 0, n - 1 do
      local o <const> = i + j * (n + 1)
      if case.space then
        face(h^2 / 24, o, o + 1, o + n + 2)
        face(h^2 / 24, o, o + n + 1, o + n + 2)
      else
        face(h / 6, o, o + 1)
      end
    end
  end
  local inverted, Q <const> = inverse(U), {}
  for i = 1, m do
    Q[i] = {}
    for j = 1, m do Q[i][j] = 0 end
    for k = 1, m do
      local f = M[i][k]
      if f ~= 0 then for j = 1, m do Q[i][j] = Q[i][j] + f * inverted[k][j] end end
    end
  end
  return Q, inverse(Q), nodes
end
local function compare(case, n, W, nodes) -- with the program, for a parabola pressed in
  local function gap(x, y) return (x^2 + (case.space and y^2 or 0)) / 4 - 0.02 end
  local body, q, most, size = body_of(case, n), {}, 0, 0
  for k, at in ipairs(nodes) do q[k] = gap(at[1], at[2]) end
  local scene = dotyk.scene{ body }
  local d <const> = case.space and 3 or 2
  local top = body:part("rows", function(x, y, z) return (case.space and z or y) > -1e-9 and (not case.cantilever or x > 2 / n - 1) end)
  local contact = scene:contact{ top, rigid = dotyk.rigid.gap{ normal = d == 2 and {0, 1} or {0, 0, 1}, gap = gap } }
  local s, r = dotyk.solver.pdas{}:solve(scene), dotyk.lcp{ M = W, q = q, unique = false }
  assert(s.converged and r.status == "solved" and #s:contact(contact).nodes == #nodes, s.reason)
  for k, node in ipairs(s:contact(contact).nodes) do
    assert(math.abs(node.x - nodes[k][1]) + (case.space and math.abs(node.y - nodes[k][2]) or 0) < 1e-9, "another order of nodes")
    most, size = math.max(most, math.abs(node.force - r.z[k])), math.max(size, r.z[k])
  end
  return most / size
end

-- 2. The hypothesis.
local function hypothesis(Q)
  local m, K, P, positive, unequal = #Q, {}, {}, 0, 0
  for i = 1, m do
    K[i], P[i] = {}, {}
    for j = 1, m do
      local off <const> = i ~= j and Q[i][j] > 0
      K[i][j], P[i][j], positive = off and 0 or Q[i][j], off and Q[i][j] or 0, positive + (off and 1 or 0)
      unequal = math.max(unequal, math.abs(Q[i][j] - Q[j][i]))
    end
  end
  local I <const>, least = inverse(K), 0
  for i = 1, m do least = math.min(least, table.unpack(I[i])) end
  return least >= 0 and norm(I) * norm(P), K, positive / (m * (m - 1)), unequal / norm(Q)
end

-- 3. The margin of one set, given as member[i] = is i in I?
local function margin(Q, member)
  local I, a, y, least = {}, {}, {}, math.huge
  for i = 1, #Q do if member[i] then I[#I + 1] = i end end
  local k <const> = #I
  for r = 1, k do
    a[r] = {}
    for c = 1, k do a[r][c] = Q[I[c]][I[r]] end
    a[r][k + 1] = 1
  end
  for p = 1, k do -- Q̂_II is positive definite: no pivots needed
    for r = p + 1, k do
      local f = a[r][p] / a[p][p]
      if f ~= 0 then for c = p, k + 1 do a[r][c] = a[r][c] - f * a[p][c] end end
    end
  end
  for r = k, 1, -1 do
    local s = a[r][k + 1]
    for c = r + 1, k do s = s - a[r][c] * y[c] end
    y[r] = s / a[r][r]
    least = math.min(least, y[r] * Q[I[r]][I[r]])
  end
  for j = 1, #Q do
    if not member[j] then
      local s = 1
      for r = 1, k do s = s - y[r] * Q[I[r]][j] end
      least = math.min(least, s)
    end
  end
  return least
end
local function least_margin(Q)
  local m <const>, least, member = #Q, math.huge, {}
  if m <= 9 then
    for bits = 1, (1 << m) - 1 do
      for i = 1, m do member[i] = bits >> (i - 1) & 1 == 1 end
      least = math.min(least, margin(Q, member))
    end
    return least, true
  end
  for _ = 1, 6 do
    for i = 1, m do member[i] = random() > 0 end
    local best, better = margin(Q, member), true
    while better do
      better = false
      for i = 1, m do
        member[i] = not member[i]
        local value = margin(Q, member)
        if value < best - 1e-12 then best, better = value, true else member[i] = not member[i] end
      end
    end
    least = math.min(least, best)
  end
  return least, false
end

-- 4. PDAS.
local function runs(W, trials)
  local m, repeated, steps = #W, 0, 0
  for trial = 1, trials do
    local load, q, start = {}, {}, {}
    for i = 1, m do
      load[i] = random()
      if random() > 0 then start[#start + 1] = i end
    end
    for i = 1, m do
      q[i] = trial % 2 == 0 and 0.1 * random() or 0 -- a gap in every other problem, else −Wq̂
      if trial % 2 == 1 then for j = 1, m do q[i] = q[i] - W[i][j] * load[j] end end
    end
    local r = dotyk.lcp{ M = W, q = q, start = start, unique = false }
    assert(r.status == "solved", r.reason)
    if #r.cycle > 0 then repeated = repeated + 1 else steps = math.max(steps, r.solves) end
  end
  return repeated, steps
end

print "                               n   rows  ‖K̂⁻¹‖₁‖P̂‖₁  positive entries   margin  of         sets repeat  most steps   Q̂ − Q̂ᵀ  forces"
local sizes, margins, block, strip = {}, {}, { least = math.huge, most = 0, grows = true }, { least = math.huge, most = -math.huge, other = true }
local wrong, problems, repeats, most_steps = 0, 0, 0, 0
for _, case in ipairs(cases) do
  local size, left, last = common.curve(case.name), common.curve(case.name), 0
  for _, n in ipairs(case.space and { 2, 4, 8, 12 } or { 4, 8, 16, 32, 64 }) do
    if n <= (case.space and math.max(4, finest // 5) or finest) then
      local Q, W, nodes = matrices(case, n)
      local product, K, positive, unequal = hypothesis(Q)
      local least, all
      if #Q <= 33 then least, all = least_margin(Q) end
      assert(not product or #Q > 9 or math.abs(least_margin(K) - 1) < 1e-9, "an M-matrix has another margin")
      local trials <const> = #Q <= 33 and 1000 or #Q <= 81 and 200 or 40
      local repeated, steps = runs(W, trials)
      local apart = compare(case, n, W, nodes)
      wrong, problems, repeats = math.max(wrong, unequal, apart), problems + trials, repeats + repeated
      if case.cantilever then
        strip.least, strip.most = math.min(strip.least, least or strip.least), math.max(strip.most, least or strip.most)
        strip.other = strip.other and not product
      else
        block.least, block.most = math.min(block.least, least or block.least), math.max(block.most, product)
        block.grows = block.grows and product > last
        most_steps, last = math.max(most_steps, steps), product
        size:add(n, product)
        if least then left:add(n, least) end
      end
      print(("%-28s %3d  %5d  %11s  %15.0f%%  %8s  %-9s %6d of %4d  %9d    %.0e    %.0e"):format(case.name, n, #Q, product and ("%.3f"):format(product) or "no M",
        100 * positive, least and ("%.3f"):format(least) or "–", least and (all and "all sets" or "found") or "", repeated, trials, steps, unequal, apart))
    end
  end
  if not case.cantilever then sizes[#sizes + 1], margins[#margins + 1] = size, left end
end
dotyk.chart{ file = "images/papers_m_matrix.png", size = { 1000, 1200 }, panels = {
  { title = "Distance from an M-matrix", log = "x", x = "cells along the contact", y = "relative perturbation", x_range = { 1.6, 80 }, y_range = { 0, 1.25 },
    series = sizes },
  { title = "Margin of PDAS (M-matrix: 1)", log = "x", x = "cells along the contact", y = "least margin", x_range = { 1.6, 80 },
    y_range = { 0, 1 }, series = margins } } }
print "images/papers_m_matrix.png"
common.verdict(wrong < 1e-9 and block.grows and block.least > 0 and strip.other and strip.most < -1 and repeats == 0, (
  "for blocks the perturbation grows with every refinement, up to ‖K̂⁻¹‖₁‖P̂‖₁ = %.2f, but margins stay positive, %.2f at "
  .. "least (over all sets, in floating point, of matrices of up to 9 rows), and PDAS ends after at most %d steps; for a strip K̂ is no M-matrix and the margins are %.0f to %.0f, yet no set came "
  .. "twice in any of %d random problems"):format(block.most, block.least, most_steps, strip.least, strip.most, problems))
