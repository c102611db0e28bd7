-- Stability atlas: active sets that go round in circles.
--
--   ./dotyk scripts/studies/stability/cycling.lua [TRIALS]
--
-- 1. w = Mz + q ≥ 0, z ≥ 0, zᵀw = 0 with M = I + α (cyclic permutation), q = 1: the plain active-set method cycles
--    from some set for α > 1 and from none for α < 1 (Ben Gharbia and Gilbert 2012). The boundary is found by
--    bisection over all 2^n starts.
-- 2. Symmetric positive definite M: never for the condition 1, and never for two unknowns; how often else? TRIALS
--    random matrices Q diag(1 … κ) Qᵀ for each condition κ and dimension, from the empty set.
-- 3. Contact: a strip between two wavy walls, slender or stout, hardly or heavily loaded; its compliance has entries
--    of both signs. Where does pdas meet an active set again, and what becomes of it? Descent of the dual energy settles
--    it, or is left for methods that are finite or do not look at sets: a barrier method on the rows, the active-set
--    method of programs. active_set, from rest, has the solution.
-- Draws images/stability_cycling.png (1 and 2) and images/stability_cycling_contact.png.

local trials <const> = tonumber(arg[1]) or 400
local common <const> = include "../../lib/common.lua"
local state = 12345
local function random() -- in (−1, 1), the same in every run
  state = (state * 1103515245 + 12345) % 2147483648
  return state / 1073741824 - 1
end

-- 1. The circulants.
local function circulant(n, alpha)
  local M, q = {}, {}
  for i = 1, n do
    M[i], q[i] = {}, 1
    for j = 1, n do M[i][j] = i == j and 1 or 0 end
    M[i][(i - 2) % n + 1] = alpha
  end
  return M, q
end
local unsolved, wrong = 0, 0
local function share(n, alpha) -- of the starts that cycle
  local M, q = circulant(n, alpha)
  local cycling = 0
  for bits = 0, (1 << n) - 1 do
    local start = {}
    for i = 1, n do if bits >> (i - 1) & 1 == 1 then start[#start + 1] = i end end
    local r = dotyk.lcp{ M = M, q = q, start = start, unique = false }
    if #r.cycle > 0 then cycling = cycling + 1 end
    if r.status ~= "solved" then unsolved = unsolved + 1 elseif r.residual > 1e-12 then wrong = wrong + 1 end
  end
  return cycling / (1 << n)
end
local worst, cyclic, series = 0, {}, {}
print "cyclic matrix, n   cycles from alpha (theory 1)   starts that cycle beyond"
for _, n in ipairs{ 3, 5, 7 } do -- P-matrices for every α ≥ 0, as n is odd
  local at = common.boundary(0.1, 10, function(alpha) return share(n, alpha) == 0 end, 1e-6)
  worst = math.max(worst, math.abs(at - 1))
  print(("%16d   %28.7f   %d of %d"):format(n, at, math.floor(share(n, 1.1 * at) * 2^n + 0.5), 1 << n))
  local curve = common.curve("n = " .. n)
  for step = 0, 30 do curve:add(0.5 + 0.05 * step, 100 * share(n, 0.5 + 0.05 * step)) end
  cyclic[#cyclic + 1] = curve
end
cyclic[#cyclic + 1] = common.curve("theory: α > 1", { reference = true })
for _, percent in ipairs{ 0, 100 } do cyclic[#cyclic]:add(1, percent) end

-- 2. Random symmetric matrices of a condition.
local function normal()
  local sum = 0
  for _ = 1, 12 do sum = sum + random() end
  return sum / 2
end
local function definite(n, condition)
  local Q, M = {}, {}
  for k = 1, n do -- orthonormal rows, by Gram and Schmidt
    local v = {}
    for i = 1, n do v[i] = normal() end
    for _ = 1, 2 do
      for j = 1, k - 1 do
        local dot = 0
        for i = 1, n do dot = dot + v[i] * Q[j][i] end
        for i = 1, n do v[i] = v[i] - dot * Q[j][i] end
      end
    end
    local size = 0
    for i = 1, n do size = size + v[i]^2 end
    for i = 1, n do v[i] = v[i] / math.sqrt(size) end
    Q[k] = v
  end
  for i = 1, n do
    M[i] = {}
    for j = 1, i do
      local sum = 0
      for k = 1, n do sum = sum + condition^((k - 1) / (n - 1)) * Q[k][i] * Q[k][j] end
      M[i][j] = sum
    end
  end
  for i = 1, n do for j = i + 1, n do M[i][j] = M[j][i] end end
  return M
end
local conditions <const> = { 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7 }
print("\nrandom symmetric positive definite matrices: share that cycles [%], by condition\n   n" .. ("%8.0e"):rep(#conditions):format(table.unpack(conditions)))
local mild = 0
for _, n in ipairs{ 2, 3, 4, 6, 8, 12 } do
  local curve, line = common.curve("n = " .. n), ("%4d"):format(n)
  for _, condition in ipairs(conditions) do
    local cycling = 0
    for _ = 1, trials do
      local q = {}
      for i = 1, n do q[i] = normal() end
      local r = dotyk.lcp{ M = definite(n, condition), q = q, unique = false }
      if #r.cycle > 0 then cycling = cycling + 1 end
      if r.status ~= "solved" then unsolved = unsolved + 1 elseif r.residual > 1e-8 then wrong = wrong + 1 end
    end
    if condition == 1 or n == 2 then mild = mild + cycling end
    line = line .. ("%8.1f"):format(100 * cycling / trials)
    curve:add(condition, 100 * cycling / trials)
  end
  print(line)
  series[#series + 1] = curve
end
dotyk.chart{ file = "images/stability_cycling.png", size = { 1000, 1200 }, panels = {
  { title = "M = I + αP: starts that cycle", x = "factor α of the permutation P", y = "starts [%]", y_range = { -4, 104 }, series = cyclic },
  { title = "Random M: active sets that repeat", log = "x", x = "condition number of M", y = "problems [%]", y_range = { -0.7, 15 }, series = series } } }

-- 3. The strip, 8 long, held at its left end; the load in units of that which bends it by the space.
local function strip(thick, load, phase)
  local n <const>, space <const> = 64, 0.01
  local unit = space * 1000 * thick^3 / 12 / 8^4
  local body = dotyk.body{ name = "strip", material = dotyk.material{ E = 1000, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {8, thick}, cells = {n, 1}, element = "Q1" } }
  body:part"left":fix()
  body:part"top":load(function(x) return 0, load * unit * math.sin(3 * x + phase) end)
  local scene = dotyk.scene{ body }
  local function wave(x, k) return space * (1 + math.min(1, x) * 0.9 * math.sin(k * x + phase)) end -- even where it is held
  scene:contact{ body:part"top", rigid = dotyk.rigid.gap{ normal = {0, 1}, gap = function(x) return wave(x, 5) end } }
  scene:contact{ body:part"bottom", rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = function(x) return wave(x, 4) end } }
  return scene
end
local settles <const>, settled <const>, left <const>, lost <const> = "settles", "settled by descent", "settled by another method", "not converged"
local map <const>, repeats, given_up, helped, solves, apart = common.map{ settles, settled, left, lost }, 0, 0, 0, 0, 0
local loads <const>, slenderest = math.max(5, trials // 20), math.huge
for _, slender in ipairs{ 5, 7, 10, 14, 20, 28, 40, 57, 80, 113, 160 } do
  for k = 1, loads do
    local load = 100 * 1000^((k - 1) / (loads - 1))
    local scene = strip(8 / slender, load, 3 * random())
    local s, t = dotyk.solver.pdas{}:solve(scene), dotyk.solver.active_set{}:solve(scene)
    local again, by_steps = s.reason:find("active sets repeat", 1, true) ~= nil, s.reason:find("left by %d+ steps of ") ~= nil
    solves, repeats, given_up, helped = solves + 1, repeats + (again and 1 or 0), given_up + (s.converged and 0 or 1), helped + (again and by_steps and 1 or 0)
    if again then slenderest = math.min(slenderest, slender) end
    if not t.converged or s.converged and math.abs(s.energy - t.energy) > 1e-8 * math.abs(t.energy) then wrong = wrong + 1 end
    if not (s.converged or again) then wrong = wrong + 1 end
    if by_steps then
      local energy = dotyk.solver.interior_point{}:solve(scene).energy
      apart = math.max(apart, math.abs(s.energy / energy - 1))
    end
    map:add(not s.converged and lost or not again and settles or by_steps and left or settled, slender, load)
  end
end
print(("\nstrips: of %d, %d meet a set again, the stoutest of a length of %g thicknesses; descent settles %d of them, another method %d; not converged: %d"):format(
  solves, repeats, slenderest, repeats - helped - given_up, helped, given_up))
dotyk.chart{ file = "images/stability_cycling_contact.png", log = "xy", x = "length / thickness of the strip", y = "load / load that closes the gap", map = map:cells() }
print "images/stability_cycling.png, images/stability_cycling_contact.png"
common.verdict(worst < 0.05 and mild == 0 and unsolved == 0 and wrong == 0 and given_up == 0 and apart < 1e-6, ("the cyclic matrices cycle from α = 1 on (found within %.0e), symmetric ones "
  .. "only with three unknowns or more and the oftener the worse the condition; every repeat was noticed, every complementarity problem "
  .. "solved; of %d strips whose sets repeat, descent settles %d and a barrier or active-set method that pdas then turns to the other %d, to interior_point's energy within %.0e"):format(worst, repeats, repeats - helped, helped, apart))
