-- Every law of a beam's end against its closed form, and the orders of convergence (P4).
--
--   ./dotyk scripts/studies/accuracy/beam_laws.lua [finest cells]
--
-- Between its ends a beam is u = particular + four homogeneous solutions; each end gives two conditions, linear on every
-- branch of its laws. Of a law's branches one is consistent with its own solution: that is the closed form, found here
-- without the program's solution. Shown: the errors of u, u', M and T for each law on the deflection and on the
-- rotation of an end, at most 1e-10; the orders under a load that no polynomial is: with constant EJ order 4 in u, 3 in u',
-- and M and T, which come from equilibrium and reactions that are exact, to rounding; with EJ = e^x, where the reactions
-- are no longer exact, order 4 in M and T as well (images/beam_orders.png).

local law <const> = dotyk.law
local finest <const> = tonumber(arg[1]) or 64
local L <const> = 2

-- 1. Closed forms. A function is told as { u, u', EJ u", (EJ u")' }.
local function solve_linear(A, b)
  local n <const> = #b
  for i = 1, n do
    local pivot = i
    for row = i + 1, n do
      if math.abs(A[row][i]) > math.abs(A[pivot][i]) then pivot = row end
    end
    A[i], A[pivot], b[i], b[pivot] = A[pivot], A[i], b[pivot], b[i]
    for row = i + 1, n do
      local factor <const> = A[row][i] / A[i][i]
      for j = i, n do A[row][j] = A[row][j] - factor * A[i][j] end
      b[row] = b[row] - factor * b[i]
    end
  end
  for i = n, 1, -1 do
    for j = i + 1, n do b[i] = b[i] - A[i][j] * b[j] end
    b[i] = b[i] / A[i][i]
  end
  return b
end

-- Displacement and reaction of the i-th condition: left deflection, left rotation, right deflection, right rotation.
local function at_end(i, f)
  local value <const> = f(i <= 2 and 0 or L)
  if i % 2 == 1 then return value[1], (i == 1 and 1 or -1) * value[4] end
  return value[2], (i == 2 and -1 or 1) * value[3]
end

-- Conditions: { v = } prescribes, { r =, k = } is the reaction r - k v.
local function closed_form(family, conditions)
  local A, b = {}, {}
  for i, c in ipairs(conditions) do
    local function side(f)
      local v <const>, r <const> = at_end(i, f)
      return c.v and v or r + (c.k or 0) * v
    end
    A[i] = {}
    for j = 1, 4 do A[i][j] = side(family[j]) end
    b[i] = (c.v or c.r) - side(family.particular)
  end
  local a <const> = solve_linear(A, b)
  return function(x)
    local sum <const> = family.particular(x)
    for j = 1, 4 do
      local f <const> = family[j](x)
      for i = 1, 4 do sum[i] = sum[i] + a[j] * f[i] end
    end
    return sum
  end
end

local function monomial(n, scale, EJ) -- scale x^n under constant EJ
  return function(x)
    local out <const> = {}
    for d = 0, 3 do
      local value = d > n and 0.0 or scale * (d >= 2 and EJ or 1)
      for k = 0, d - 1 do value = value * (n - k) end
      out[d + 1] = d > n and 0.0 or value * x^(n - d)
    end
    return out
  end
end
local function constant(EJ, particular)
  return { monomial(0, 1, EJ), monomial(1, 1, EJ), monomial(2, 1, EJ), monomial(3, 1, EJ), particular = particular }
end

-- Greatest error over these points, of each quantity relative to its own greatest value.
local names <const> = { "deflection", "rotation", "moment", "shear" }
local function errors(s, exact, points)
  local worst <const>, size <const> = { 0, 0, 0, 0 }, { 0, 0, 0, 0 }
  for i = 0, points do
    local x <const> = L * i / points
    local f <const> = exact(x)
    for k, name in ipairs(names) do
      local value <const> = k > 2 and -f[k] or f[k]
      worst[k] = math.max(worst[k], math.abs(s[name](s, x) - value))
      size[k] = math.max(size[k], math.abs(value))
    end
  end
  for k = 1, 4 do worst[k] = worst[k] / size[k] end
  return worst
end

-- 2. The laws: their branches, each with the condition it is and where it holds, v and r counted as the law counts them.
local function laws(prescribed, load, k, bound, cap)
  local function slips(v) return v < 0 end
  local function off(v) return v > 0 end
  return {
    { "free", law.free(), { "free", { r = 0 } } },
    { "prescribed", law.prescribed(prescribed), { "held", { v = prescribed } } },
    { "load", law.load(load), { "loaded", { r = load } } },
    { "elastic", law.elastic(k), { "elastic", { r = 0, k = k } } },
    { "one-sided elastic", law.one_sided_elastic(k), { "elastic", { r = 0, k = k }, slips }, { "off", { r = 0 }, off }, one_sided = true },
    { "Signorini", law.signorini(), { "pushing", { v = 0 }, function(_, r) return r > 0 end }, { "off", { r = 0 }, off }, one_sided = true },
    { "friction", law.friction(bound), { "sticks", { v = 0 }, function(_, r) return math.abs(r) < bound end },
      { "slips", { r = bound }, slips }, { "slips", { r = -bound }, off } },
    { "one-sided friction", law.one_sided_friction(bound), { "sticks", { v = 0 }, function(_, r) return r > 0 and r < bound end },
      { "slips", { r = bound }, slips }, { "off", { r = 0 }, off }, one_sided = true },
    { "capped elastic", law.capped_elastic(k, cap), { "elastic", { r = 0, k = k }, function(v) return math.abs(k * v) < cap end },
      { "capped", { r = cap }, function(v) return k * v < -cap end }, { "capped", { r = -cap }, function(v) return k * v > cap end } },
    { "unequal elastic", law.unequal_elastic(k, k / 4), { "pushed", { r = 0, k = k }, slips }, { "pulled", { r = 0, k = k / 4 }, off }, one_sided = true } }
end

-- The closed form of the one branch that is consistent, and its name.
local function consistent(entry, place, family, conditions)
  local turn <const> = entry.one_sided and place == 4 and -1 or 1 -- one-sided laws of a rotation are about -u'
  local found, name
  for i = 3, #entry do
    local state <const>, c <const>, holds <const> = table.unpack(entry[i])
    conditions[place] = { v = c.v and turn * c.v, r = c.r and turn * c.r, k = c.k }
    local exact <const> = closed_form(family, conditions)
    local v <const>, r <const> = at_end(place, exact)
    if not holds or holds(turn * v, turn * r) then
      assert(not found, "two branches are consistent")
      found, name = exact, state
    end
  end
  return assert(found, "no branch is consistent"), name
end

local EJ <const>, held <const> = 3, { v = 0 }
local loads <const> = { -1, -0.6, 0.6 }
local places <const> = {
  { name = "deflection", place = 3, laws = laws(0.05, -0.3, 4, 0.7, 0.5), conditions = { held, held, held, { r = 0 } }, -- a cantilever's tip
    ends = function(l) return { deflection = law.prescribed(), rotation = law.prescribed() }, { deflection = l } end },
  { name = "rotation", place = 4, laws = laws(0.05, -0.3, 4, 0.4, 0.2), conditions = { held, { r = 0 }, held, held }, -- on two supports
    ends = function(l) return { deflection = law.prescribed() }, { deflection = law.prescribed(), rotation = l } end } }
print(("law of the right end, branches under the loads %s    errors of u, u', M, T"):format(table.concat(loads, ", ")))
for _, at in ipairs(places) do
  for _, entry in ipairs(at.laws) do
    local worst <const>, states <const> = { 0, 0, 0, 0 }, {}
    for _, q in ipairs(loads) do
      local left <const>, right <const> = at.ends(entry[2])
      local s <const> = dotyk.solve(dotyk.beam{ length = L, EJ = EJ, load = q, cells = 8, left = left, right = right })
      local exact <const>, state <const> = consistent(entry, at.place, constant(EJ, monomial(4, q / (24 * EJ), EJ)), at.conditions)
      for k, e in ipairs(errors(s, exact, 8)) do worst[k] = math.max(worst[k], e) end
      states[#states + 1] = state
    end
    print(("%-10s %-19s %-27s %.1e  %.1e  %.1e  %.1e"):format(at.name, entry[1], table.concat(states, ", "), table.unpack(worst)))
    for k = 1, 4 do assert(worst[k] <= 1e-10) end
  end
end

-- 3. Orders: a clamped end and a one-sided spring, under -e^x with constant EJ, under -1 with EJ = e^x.
local function exponential(p, dp, scale) -- EJ u" = polynomial p of degree up to 2 under EJ = e^x: u = (p + 2p' + 3p") e^-x
  local ddp <const> = dp(1) - dp(0)
  return function(x)
    return { scale * (p(x) + 2 * dp(x) + 3 * ddp) * math.exp(-x), -scale * (p(x) + dp(x) + ddp) * math.exp(-x), scale * p(x), scale * dp(x) }
  end
end
local function zero() return 0 end
local function one() return 1 end
local cases <const> = {
  { name = "constant EJ", EJ = EJ, load = function(x) return -math.exp(x) end, designed = { 4, 3 },
    family = constant(EJ, function(x) local e <const> = -math.exp(x) return { e / EJ, e / EJ, e, e } end) },
  { name = "EJ = exp x", EJ = function(x) return math.exp(x) end, load = -1, designed = { 4, 3, 4, 4 },
    family = { monomial(0, 1, 0), monomial(1, 1, 0), exponential(one, zero, 1), exponential(function(x) return x end, one, 1),
      particular = exponential(function(x) return x^2 end, function(x) return 2 * x end, -0.5) } } }
local curves <const> = {}
for _, case in ipairs(cases) do
  local exact <const> = closed_form(case.family, { held, held, { r = 0, k = 4 }, { r = 0 } })
  assert(exact(L)[1] < 0) -- it presses on the spring
  print(("\n%s: cells, errors of u, u', M, T and their orders"):format(case.name))
  local last, cells = nil, 4
  local first <const> = #curves
  for k = 1, #case.designed do
    local quantity <const> = ({ "u", "u′", "M", "T" })[k]
    curves[first + k] = { name = ("%s, %s"):format(quantity, case.name:gsub("exp x", "eˣ")), x = {}, y = {} }
  end
  while cells <= finest do
    local s <const> = dotyk.solve(dotyk.beam{ length = L, EJ = case.EJ, load = case.load, cells = cells,
      left = { deflection = law.prescribed(), rotation = law.prescribed() }, right = { deflection = law.one_sided_elastic(4) } })
    local e <const>, line = errors(s, exact, 960), ("%3d"):format(cells)
    for k = 1, 4 do
      local order <const> = last and case.designed[k] and math.log(last[k] / e[k], 2)
      line = line .. ("   %.2e %s"):format(e[k], order and ("%.2f"):format(order) or "    ")
      if case.designed[k] then
        table.insert(curves[first + k].x, L / cells)
        table.insert(curves[first + k].y, e[k])
      else
        assert(e[k] <= 1e-10)
      end
      if order and cells == finest then assert(math.abs(order - case.designed[k]) < 0.1, names[k]) end
    end
    print(line)
    last, cells = e, 2 * cells
  end
end
dotyk.chart{ file = "images/beam_orders.png", title = "A beam on a one-sided spring", x = "length of a cell", y = "relative error", log = "xy",
  series = curves, slopes = { 3, 4 } }
print "images/beam_orders.png"
