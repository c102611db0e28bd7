-- Where active sets go round in circles: linear complementarity problems w = Mz + q ≥ 0, z ≥ 0, zᵀw = 0.
--
--   ./dotyk scripts/studies/matrices/cycles.lua [TRIALS]
--
-- 1. The matrices of ../shared/reference/failure_cases.json on which the plain active-set method (Newton's method
--    on min(z, w) = 0) cycles, from every start: the cycle is noticed, and Lemke's method solves the problem.
-- 2. Every file of ../shared/reference/lcp: solved, or said to have no solution, or more than one.
-- 3. How often does it happen? Random P-matrices of sizes 3 to 8, TRIALS of each kind and size; for each the
--    share of problems that cycle from the empty set, and from some start. Draws images/cycles.png.

local trials <const> = tonumber(arg[1]) or 2000
local folder <const> = (arg[0]:match "^(.*)/[^/]*$" or ".") .. "/../../../../shared/reference/"

local function subsets(n) -- all 2^n lists of unknowns
  local list = {}
  for bits = 0, (1 << n) - 1 do
    local set = {}
    for i = 1, n do if bits >> (i - 1) & 1 == 1 then set[#set + 1] = i end end
    list[#list + 1] = set
  end
  return list
end

local function names(sets)
  local texts = {}
  for k, set in ipairs(sets) do texts[k] = "{" .. table.concat(set, ",") .. "}" end
  return table.concat(texts, " -> ")
end

-- 1. Known matrices. α > 1 cycles, α < 1 does not (Ben Gharbia and Gilbert 2012); the M-matrix, Murty's and
-- Fathi's never do. Symmetric and positive definite does not help (Curtis, Han and Robinson 2015).
local function circulant(a) return { {1, 0, a}, {a, 1, 0}, {0, a, 1} } end
local murty, fathi, minus = {}, {}, {}
for i = 1, 6 do
  murty[i], fathi[i], minus[i] = {}, {}, -1
  for j = 1, 6 do
    murty[i][j] = i == j and 1 or i > j and 2 or 0
    local least = math.min(i, j)
    fathi[i][j] = i == j and 4 * i - 3 or 4 * least - 2
  end
end
local known <const> = {
  { "circulant, alpha = 2", circulant(2), {1, 1, 1} }, { "circulant, alpha = 1.1", circulant(1.1), {1, 1, 1} },
  { "circulant, alpha = 0.9", circulant(0.9), {1, 1, 1} },
  { "Curtis-Han-Robinson, SPD", { {4, 5, -5}, {5, 9, -5}, {-5, -5, 7} }, {2, 1, -3} },
  { "M-matrix", { {2, -1, 0}, {-1, 2, -1}, {0, -1, 2} }, {-1, 3, -1} }, { "Murty, n = 6", murty, minus }, { "Fathi, n = 6", fathi, minus } }

-- The data of failure_cases.json, where it is: a list of lists under a key, numbers or fractions in quotes.
local function from_file(case, field)
  local file = io.open(folder .. "failure_cases.json")
  if not file then return nil end
  local at = file:read "a"
  file:close()
  at = at:sub((assert(at:find(case, 1, true), case)))
  local list = at:match('"' .. field .. '":%s*(%b[])')
  return load("return " .. list:gsub("[%[%]\"]", { ["["] = "{", ["]"] = "}", ['"'] = "" }))()
end
local in_file <const> = { { "N1 Ben", "M" }, { "N1b", "M" }, { "N1c", "M" }, false, { "N3 M-matrix", "M" }, { "N4 Murty", "Murty" }, { "N4 Murty", "Fathi" } }
for k, place in ipairs(in_file) do
  local M = place and from_file(table.unpack(place))
  if place and not M then print "(no ../shared/reference: the matrices are not compared with its failure_cases.json)" break end
  for i, row in ipairs(M or {}) do
    for j, value in ipairs(row) do assert(math.abs(value - known[k][2][i][j]) < 1e-15, known[k][1] .. " is not the file's") end
  end
end

print "matrix                    starts  cycling  most solves  solved  a cycle"
for _, one in ipairs(known) do
  local label, M, q = table.unpack(one)
  local cycling, solved, most, example = 0, 0, 0, ""
  local starts = subsets(#q)
  for _, start in ipairs(starts) do
    local r = dotyk.lcp{ M = M, q = q, start = start, unique = false }
    if #r.cycle > 0 then cycling, example = cycling + 1, names(r.cycle) else most = math.max(most, r.solves) end
    if r.status == "solved" and r.residual < 1e-12 then solved = solved + 1 end
  end
  print(("%-24s  %6d  %7d  %11d  %6d  %s"):format(label, #starts, cycling, most, solved, example))
  assert(solved == #starts)
end

-- 2. The files.
local files <const> = { "CPS_1", "CPS_2", "CPS_3", "CPS_4", "CPS_4bis", "CPS_5", "Pang_isolated_sol", "Pang_isolated_sol_perturbed",
  "deudeu", "deudeu_block", "enum_fails", "exp_murty", "exp_murty2", "inf_sol_perturbed", "mmc", "ortiz", "ortiz_block", "tobenna",
  "trivial", "trivial_block" }
local there = io.open(folder .. "lcp/lcp_CPS_1.dat")
if there then
  there:close()
  print "\nfile                         n  status    by           residual  in words"
  for _, file in ipairs(files) do
    local r = dotyk.lcp(folder .. "lcp/lcp_" .. file .. ".dat")
    print(("%-26s  %2d  %-8s  %-11s  %8.0e  %s"):format(file, #r.z, r.status, r.method, r.residual, r.reason))
    assert(r.status ~= "stopped")
  end
else
  print("\nno files in " .. folder .. "lcp: part 2 is left out")
end

-- 3. Random P-matrices, with numbers of our own so that every run is the same.
local state = 12345
local function random() -- in (−1, 1)
  state = (state * 1103515245 + 12345) % 2147483648
  return state / 1073741824 - 1
end
local function normal() -- about that
  local sum = 0
  for _ = 1, 12 do sum = sum + random() end
  return sum / 2
end

local kinds <const> = {
  { "symmetric positive definite", function(n) -- GGᵀ
    local G, M = {}, {}
    for i = 1, n do G[i] = {} for j = 1, n do G[i][j] = normal() end end
    for i = 1, n do
      M[i] = {}
      for j = 1, n do
        M[i][j] = 0
        for k = 1, n do M[i][j] = M[i][j] + G[i][k] * G[j][k] end
      end
    end
    return M
  end },
  { "positive definite, skew part", function(n) -- GGᵀ/n + K, K skew of five times the size
    local G, M = {}, {}
    for i = 1, n do G[i], M[i] = {}, {} for j = 1, n do G[i][j] = normal() end end
    for i = 1, n do
      for j = 1, i do
        local s, k = 0, i == j and 0 or 5 * normal()
        for l = 1, n do s = s + G[i][l] * G[j][l] end
        M[i][j], M[j][i] = s / n + k, s / n - k
      end
    end
    return M
  end },
  { "triangular, large entries", function(n) -- unit triangular: a P-matrix whatever is below
    local M = {}
    for i = 1, n do
      M[i] = {}
      for j = 1, n do M[i][j] = i == j and 1 or i > j and 3 * normal() or 0 end
    end
    return M
  end },
  { "cyclic, q > 0", function(n) -- I + cyclic permutation times a_i > 0: det = 1 ± Πa_i, so even n need Πa_i < 1
    local M, a, product = {}, {}, 1
    for i = 1, n do
      a[i] = 2 + 1.8 * random()
      product = product * a[i]
    end
    for i = 1, n do
      M[i] = {}
      for j = 1, n do M[i][j] = i == j and 1 or 0 end
      M[i][(i - 2) % n + 1] = n % 2 == 1 and a[i] or a[i] * (0.9 / product)^(1 / n)
    end
    return M
  end, positive = true },
  { "random, P by rejection", function(n) -- I + R/√n with all principal minors positive
    local sets = subsets(n)
    local function minor(M, set)
      local a, det = {}, 1
      for i, row in ipairs(set) do a[i] = {} for j, column in ipairs(set) do a[i][j] = M[row][column] end end
      for k = 1, #set do
        if a[k][k] <= 1e-12 then return 0 end -- all leading minors are principal, too
        det = det * a[k][k]
        for i = k + 1, #set do
          local f = a[i][k] / a[k][k]
          for j = k, #set do a[i][j] = a[i][j] - f * a[k][j] end
        end
      end
      return det
    end
    for _ = 1, 10000 do
      local M, good = {}, true
      for i = 1, n do M[i] = {} for j = 1, n do M[i][j] = (i == j and 1 or 0) + 1.5 * normal() / math.sqrt(n) end end
      for _, set in ipairs(sets) do
        if minor(M, set) <= 0 then good = false break end
      end
      if good then return M end
    end
    error "no P-matrix in 10000 draws"
  end },
}

-- Where a share lies with 95 % confidence that was found as k of n [%] (Wilson 1927).
local function interval(k, n)
  local z2 <const> = 1.96^2
  local middle <const>, half <const> = (k + z2 / 2) / (n + z2), math.sqrt(z2 * (k * (n - k) / n + z2 / 4)) / (n + z2)
  return 100 * math.max(0, middle - half), 100 * (middle + half)
end

print "\nshare of problems that cycle, from the empty set / from the empty, the full or one of six random sets"
print "random P-matrices                n = 3           4           5           6           7           8"
local series, unsolved = { often = {}, rarely = {} }, 0 -- percentages above and below 1
for _, kind in ipairs(kinds) do
  local label, make = table.unpack(kind)
  local line, x, y, low, high = {}, {}, {}, {}, {}
  for n = 3, 8 do
    local empty, any = 0, 0
    for _ = 1, trials do
      local M, q, full = make(n), {}, {}
      for i = 1, n do q[i], full[i] = kind.positive and math.abs(normal()) or normal(), i end
      local starts = { {}, full }
      for k = 3, 8 do
        starts[k] = {}
        for i = 1, n do if random() > 0 then table.insert(starts[k], i) end end
      end
      local cycles = false
      for k, start in ipairs(starts) do
        local r = dotyk.lcp{ M = M, q = q, start = start, unique = false }
        if #r.cycle > 0 then
          cycles = true
          if k == 1 then empty = empty + 1 end
        end
        if r.status ~= "solved" then unsolved = unsolved + 1 end
      end
      if cycles then any = any + 1 end
    end
    line[#line + 1] = ("%5.2f/%5.2f%%"):format(100 * empty / trials, 100 * any / trials)
    x[#x + 1], y[#y + 1] = n, 100 * any / trials
    low[#x], high[#x] = interval(any, trials)
  end
  print(("%-28s  %s"):format(label, table.concat(line, " ")))
  local most <const> = math.max(table.unpack(y))
  local group <const> = series[most > 1 and "often" or "rarely"]
  table.insert(group, { name = most > 0 and label or label .. ": never", x = x, y = y, low = low, high = high, bars = true })
end
print(("%d of %d problems were left unsolved: every cycle was noticed, and Lemke's method went on from there"):format(
  unsolved, #kinds * 6 * trials * 8))
assert(unsolved == 0)

dotyk.chart{ file = "images/cycles.png", x = "unknowns n", size = { 1000, 1000 }, panels = {
  { title = "Problems that cycle, 95 % confidence", y = "problems [%]", y_range = { -2, 41 }, series = series.often },
  { y = "problems [%]", y_range = { -0.03, 0.63 }, series = series.rarely } } }
print "images/cycles.png"
