-- The theorems on semicoercive contact of Netuka (ODAM 2001, 101–125, section 2), each also where its hypothesis ends.
--
--   ./dotyk scripts/papers/netuka/semicoercive_theorems.lua [FINEST]
--
-- 1. Theorems 2.1 to 2.4. A unit block between rigid planes, all stresses uniform; y is its one rigid motion that is in
--    question. J(t) = min J(v) over the v whose side moves by t along y is known in closed form. The t at which J(t) is
--    least are the solutions: one, a range, a half-line, all, or none. What the program says before solving (balance,
--    uniqueness) and after it (reason), and J(t) solved for many t, must agree with that. With R_K = {0} and L = 0 the range
--    of theorem 2.2 consists of y outside R_K: a pulled block shrinks and leaves floor and ceiling room.
-- 2. Theorem 2.2 with gaps (remark 2.1): a block pressed by p between stops at distances g expands by ν'p/E'. It may be
--    anywhere in a range of 2g − ν'p/E' until that is nothing; beyond, its place is unique.
-- 3. Theorem 2.2 without (29): a load with its resultant above the edge of a block does no work when the block tips, and all
--    reaction is at the corner. A force P at the corner of a quarter plane has Michell's radial stress, with the energy
--    ln 2 P²/(4E') (1/(π/4 + 1/2) + 1/(π/4 − 1/2)) in a ring r < |x| < 2r: J falls by that with each halving of h, without
--    end. So there is no solution, though every mesh has one: for existence, programs need (28) only. With (29) J converges.
-- Draws images/papers_semicoercive_theorems.png. FINEST: cells along the block in 3. Section 3 of the paper is in
-- scripts/papers/netuka/semicoercive_working_sets.lua.

local finest <const> = math.max(16, tonumber(arg[1]) or 64)
local common <const> = include "../../lib/common.lua"
local E <const>, nu <const>, inf <const> = 1000, 0.3, math.huge
local E1 <const>, nu1 <const> = E / (1 - nu^2), nu / (1 - nu) -- of plane strain
local floor <const>, ceiling <const>, left <const>, right <const> = { 0, -1, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 1, 0, 0 } -- normal, gap

local function block(o) -- fix, at, load, planes: by part; a plane is left out where the part is moved
  local body = dotyk.body{ name = "block", material = dotyk.material{ E = E, nu = nu },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = { o.cells or 4, o.cells or 4 }, element = "Q1" } }
  for part, components in pairs(o.fix or {}) do body:part(part):fix(components) end
  for part, value in pairs(o.at or {}) do body:part(part):displace(value) end
  for part, traction in pairs(o.load or {}) do body:part(part):load(traction) end
  local scene = dotyk.scene{ body }
  for part, plane in pairs(o.planes or {}) do
    if not (o.at and o.at[part]) then scene:contact{ body:part(part), rigid = dotyk.rigid.gap{ normal = { plane[1], plane[2] }, gap = plane[3] } } end
  end
  return scene, body
end
local function reported(reason) -- the range of the free motion about the solution, in words of s.reason
  if not reason:find("up to 'block'", 1, true) then return 0, 0 end
  if reason:find("no support or contact notices", 1, true) and not reason:find("displacements from", 1, true) then return -inf, inf end
  local low, high = reason:match "by displacements from (%-?[%d.e-]+) to (%g+) at the most"
  if not low then low, high = reason:match "by displacements from (%-?infinity) to (%g+) at the most" end
  local function number(text) return text == "infinity" and inf or text == "-infinity" and -inf or tonumber(text) end
  return number(low), number(high)
end

-- 1. The theorems' scenes. `J` in closed form with the ends of the range of its minimisers; `side` moves by t along `axis`.
local function guided(p) -- R_V: up and down, R_K: up. L(y) = −p. Its right side is pulled by 1.
  return { scene = { fix = { left = "x" }, planes = { bottom = floor }, load = { top = { 0, -p }, right = { 1, 0 } } }, side = "top", axis = 2,
    J = function(t) return -1 / (2 * E1) + math.min(0, E1 * t + nu1)^2 / (2 * E1) + p * t end,
    ends = p >= 0 and { -(nu1 + p) / E1, p > 0 and -(nu1 + p) / E1 or inf } }
end
local function between(f) -- R_V: up and down, R_K = {0}: floor and ceiling. L(y) = −f
  return { scene = { fix = { left = "x" }, planes = { bottom = floor, top = ceiling }, load = { bottom = { 0, -f }, right = { 1, 0 } } }, side = "bottom", axis = 2, from = 0,
    J = function(t) return -1 / (2 * E1) + math.min(0, nu1 - E1 * t)^2 / (2 * E1) + f * t end,
    ends = f > 0 and { 0, 0 } or { (nu1 - f) / E1 * (f < 0 and 1 or 0), (nu1 - f) / E1 } }
end
local function corner(q) -- R_V: all three, R*= {0}: floor and wall. L(to the right) = q
  return { scene = { planes = { bottom = floor, left = left }, load = { top = { 0, -1 }, right = { q, 0 } } }, side = "right", axis = 1,
    J = function(t) return -1 / (2 * E1) + math.min(0, E1 * t - nu1)^2 / (2 * E1) - q * t end,
    ends = q <= 0 and { (nu1 + q) / E1, q < 0 and (nu1 + q) / E1 or inf } }
end
local C2 <const> = (1 - nu1^2) / E1 -- compliance along x where planes hold the height
local function sliding(wall, L) -- R_V: to either side; without a wall R_K = R_V. Pressed together by p
  local p = wall and 1.4 or 1
  return { scene = { fix = { bottom = "y" }, planes = { top = ceiling, right = wall }, load = { left = { p + L, 0 }, right = { -p, 0 } } }, side = "left", axis = 1,
    J = function(t) return -C2 * p^2 / 2 + (wall and math.max(0, t - C2 * p)^2 / (2 * C2) or 0) - L * t end,
    ends = L == 0 and { -inf, wall and C2 * p or inf } }
end
local held <const> = { scene = { fix = { bottom = "y", left = "x" }, planes = { right = right }, load = { top = { 0, -1 } } }, side = "top", axis = 2,
  J = function(t) return t^2 / 2 * (t < 0 and 1 / C2 or E1) + t end, ends = { -C2, -C2 } }
local resting <const> = { scene = { planes = { bottom = floor }, load = { top = { 0, -1 } } }, side = "left", axis = 1,
  J = function() return -1 / (2 * E1) end, ends = { -inf, inf } }
local cases <const> = { -- theorem, hypothesis, scene, curve in panel
  { "2.1", "R_V = {0}", held, 1, "held" },
  { "2.1, 2.4", "L(y) < 0 on R_K", guided(1), 1, "L(y) = −y" },
  { "border", "L(y) = 0 on R_K", guided(0), 1, "L = 0" },
  { "beyond", "L(y) > 0 on R_K", guided(-1), 1, "L(y) = y" },
  { "2.4", "R_K = {0}, L(y) = −y", between(1), 2, "L(y) = −y" },
  { "2.4", "R_K = {0}, L(y) = y", between(-1), 2, "L(y) = y" },
  { "2.2; border of 2.4", "R_K = {0}, L = 0", between(0), 2, "L = 0" },
  { "2.2", "(28), (29), R* = {0}", corner(-1), 4, "L(y) = −y" },
  { "border", "(28) without (29)", corner(0), 4, "L = 0" },
  { "beyond", "without (28)", corner(1), 4, "L(y) = y" },
  { "2.2", "(28), (29), R* ≠ {0}", resting },
  { "2.3", "R_K = R_V, L = 0", sliding(nil, 0), 3, "R_K = R_V, L = 0" },
  { "border", "R_K ≠ R_V, L = 0", sliding(right, 0), 3, "R_K ≠ R_V, L = 0" },
  { "beyond", "R_K = R_V, L ≠ 0", sliding(nil, 0.1), 3, "L ≠ 0" },
}
local panels, single, most, places, left_out = {}, {}, 0, 0, {}
for k = 1, 4 do panels[k], single[k] = {}, common.curve("the solution", { style = "points" }) end
local function close(value, exact, tolerance) -- relative to the displacements and energies here, some 1e-3
  if value == exact then return end
  most = math.max(most, math.abs(value - exact) / 1e-3)
  assert(math.abs(value - exact) < (tolerance or 1e-9) * 1e-3, ("%.12g is not %.12g"):format(value, exact))
end
print "theorem             hypothesis               balance()     solutions y, 1e-3     s.reason, 1e-3"
for _, case in ipairs(cases) do
  local theorem, hypothesis, c, panel, name = table.unpack(case)
  local scene, body = block(c.scene)
  local balance, text = scene:balance(), "–"
  local known, before = pcall(scene.uniqueness, scene)
  local solved, s = pcall(dotyk.solve, scene)
  assert(balance.solvable == (c.ends and true or false) and solved == balance.solvable and known == solved, tostring(s))
  if solved then
    assert(s.converged and before.exists, s.reason)
    local u = { s:displacement(body, c.side == "right" and 1 or 0, c.side == "top" and 1 or 0) }
    local low, high = reported(s.reason)
    close(s.energy, c.J(math.max(c.ends[1], math.min(c.ends[2], 0))))
    close(u[c.axis] + low, c.ends[1], 1e-5) -- the reason has six digits
    close(u[c.axis] + high, c.ends[2], 1e-5)
    if low == -inf and high == inf then close((s:displacement(body, 0, 0.5)) + (s:displacement(body, 1, 0.5)), 0) end -- û is orthogonal to y
    assert(balance.verdict ~= "unique" or low == high and before.unique)
    assert(balance.verdict ~= "up to motion" or low < high)
    text = low == high and "unique" or ("%.3f to %.3f"):format(1e3 * (u[c.axis] + low), 1e3 * (u[c.axis] + high))
    for _, method in ipairs{ "active_set", "interior_point" } do
      local other = dotyk.solver[method]{}:solve(scene)
      if other.converged then close(other.energy, s.energy, 1e-7) end
      if not other.converged or (low < high) ~= (other.reason:find "up to 'block'" ~= nil) then
        left_out[#left_out + 1] = ("%s, %s: %s"):format(hypothesis, method, other.converged and "does not name the motion" or other.reason:match "^[^;]*")
      end
    end
  else
    assert(before:find("not held", 1, true) and tostring(s):find("not held", 1, true))
  end
  print(("%-18s  %s  %-12s  %-20s   %s"):format(theorem, hypothesis .. (" "):rep(23 - utf8.len(hypothesis)), balance.verdict,
    not c.ends and "none" or c.ends[1] == c.ends[2] and ("%.3f"):format(1e3 * c.ends[1]) or ("%.3f to %.3f"):format(1e3 * c.ends[1], 1e3 * c.ends[2]), text))
  local curve = common.curve(name, { style = "line" }) -- J(t) by solving, against the closed form
  for k = -12, 12 do
    local t = k / 12 * 1.5e-3
    if t >= (c.from or -inf) then
      local at = { x = c.axis == 1 and t or nil, y = c.axis == 2 and t or nil }
      c.scene.at = { [c.side] = at }
      local J = dotyk.solve((block(c.scene))).energy
      close(J, c.J(t))
      places = places + 1
      local inside = c.ends and t >= c.ends[1] and t <= c.ends[2]
      if solved then assert((J < s.energy + 1e-12) == inside, J - s.energy) end
      curve:add(1e3 * t, 1e3 * J)
    end
  end
  if panel then
    table.insert(panels[panel], curve)
    if solved then
      local all = c.ends[1] < c.ends[2]
      local set = all and common.curve(not panels[panel].all and "all solutions" or nil, { style = "line", front = true }) or single[panel]
      for _, t in ipairs(c.ends) do t = math.max(-1.5e-3, math.min(1.5e-3, t)) set:add(1e3 * t, 1e3 * c.J(t)) end
      if all then table.insert(panels[panel], 1, set) panels[panel].all = true end
    end
  end
end
print(("J(t) at %d places, and all else, agrees with the closed forms to %.0e; other methods: %s"):format(places, most, #left_out == 0 and "the same" or ""))
for _, line in ipairs(left_out) do print("  " .. line) end
print "floor and wall with (29): unique, yet no case of theorem 2.1, for dim R_V = 3 (misprint 101)"

-- 2. Stops at a distance: the range closes.
local g <const> = 5e-4
local low <const>, high <const> = common.curve("least", { style = "points" }), common.curve("greatest", { style = "points" })
local exact <const> = { common.curve("closed form", { style = "line", reference = true }), common.curve(nil, { style = "line", reference = true }) }
for k = 1, 20 do
  local p = 0.2 * k
  local scene, body = block{ planes = { bottom = floor, left = { -1, 0, g }, right = { 1, 0, g } }, load = { top = { 0, -p } } }
  local s, expands = dotyk.solve(scene), nu1 * p / E1
  local middle, from, to = s:displacement(body, 0, 0.5) / 2 + s:displacement(body, 1, 0.5) / 2, reported(s.reason)
  local half = math.max(0, g - expands / 2)
  close(middle + from, -half, 1e-5)
  close(middle + to, half, 1e-5)
  assert((half == 0) == (from == to), s.reason)
  low:add(p, 1e3 * (middle + from))
  high:add(p, 1e3 * (middle + to))
  for i, sign in ipairs{ -1, 1 } do exact[i]:add(p, 1e3 * sign * half) end
end
print(("stops: the range closes at p = %.4f (closed form)"):format(2 * g * E1 / nu1))

-- 3. The resultant at x, and ever finer meshes.
local ring <const> = math.log(2) / (4 * E1) * (1 / (math.pi / 4 + 1 / 2) + 1 / (math.pi / 4 - 1 / 2))
local tipping, step = {}, 0
print "\n cells       resultant at x = 0.9        0.98         1          a halving takes off        by Michell"
local rows = {}
for _, x in ipairs{ 0.9, 0.98, 1 } do
  local a, curve = 12 * (x - 1 / 2), common.curve(x == 1 and "above the edge" or ("above x = %g"):format(x))
  local n, before = 4, nil
  while n <= finest do
    local scene = block{ cells = n, planes = { bottom = floor }, load = { top = function(y) return 0, -(1 - a / 2 + a * y) end } }
    if n == 4 then
      local balance = scene:balance()
      assert(balance.solvable and balance.limit == (x == 1), balance.verdict)
    end
    local s = dotyk.solve(scene)
    assert(s.converged, s.reason)
    rows[n] = (rows[n] or ("%6d                "):format(n)) .. ("%12.6f"):format(1e3 * s.energy)
    step = before and s.energy - before or 0
    if x == 1 and before then rows[n] = rows[n] .. ("%20.6f  %20.6f"):format(1e3 * step, -1e3 * ring) end
    curve:add(n, 1e3 * s.energy)
    n, before = 2 * n, s.energy
  end
  tipping[#tipping + 1] = curve
  if x == 0.9 then assert(math.abs(step) < (finest < 32 and 0.02 or 0.003) * math.abs(before)) end
end
for n = 4, finest do if rows[n] then print(rows[n]) end end
assert(math.abs(step / -ring - 1) < 1e-3, step)

for k, panel in ipairs(panels) do
  panel.all = nil
  if single[k].x[1] then panel[#panel + 1] = single[k] end
end
local place <const> = "place t of the block · 10³"
dotyk.chart{ file = "images/papers_semicoercive_theorems.png", columns = 2, size = { 2100, 2000 }, panels = {
  { title = "2.1, 2.4: held, or free vertically", x = place, y = "least J · 10³", series = panels[1], y_range = { -1.6, 2.2 } },
  { title = "2.4, R_K = {0}: floor and ceiling", x = place, y = "least J · 10³", series = panels[2] },
  { title = "2.2: floor and wall", x = place, y = "least J · 10³", series = panels[4], y_range = { -2.2, 1.6 } },
  { title = "2.3: free to both sides", x = place, y = "least J · 10³", series = panels[3], y_range = { -0.9, 0 } },
  { title = "2.2: pressed between stops", x = "pressure p", y = "middle of the block · 10³", series = { low, high, table.unpack(exact) } },
  { title = "2.2: tipping load", x = "cells per side", y = "least J · 10³", log = "x", series = tipping },
} }
print "images/papers_semicoercive_theorems.png"
common.verdict(most < 1e-5, ("%d scenes have the solutions that theorems 2.1 to 2.4 and closed forms give, and none, a half-line or a range of them beyond their "
  .. "hypotheses; on the border of (29) J falls by %.4fe-3 with each halving of h (Michell: %.4fe-3): there is no solution"):format(#cases, -1e3 * step, 1e3 * ring))
