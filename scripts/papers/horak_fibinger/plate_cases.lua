-- Plates that their supports hold only where the load lets them: the four cases of P5, within and beyond what has a solution.
--
--   ./dotyk scripts/papers/horak_fibinger/plate_cases.lua [CELLS]
--
-- Plates of D = 1, ν = 0.3 on the unit square. Free (P5 (33)); then with edges that do not rotate, so that only the motion of the
-- whole plate is free: on a rigid one-sided support (Signorini; (44) to (46)), with friction along the edge ((62) to (64)), on a
-- one-sided elastic one ((73), (74)). Shown: loads with one solution, with many (all of them are told: s.family, s:motion)
-- and without any (why: the error's text); limit cases against closed forms; loads swept up to the limit, where the
-- solution tends to that of the family with the least motion and does not grow; stiff springs that tend to Signorini's edge by
-- 1/k. Draws images/plate_cases.png, images/plate_limit.png and images/plate_limit_friction.png.

local law <const> = dotyk.law
local cells <const> = tonumber(arg[1]) or 32
local nu <const>, pi <const>, bound <const>, stiffness <const> = 0.3, math.pi, 1, 500
local height <const> = 0.001 -- of the waves
local amplitude <const> = 64 * pi^4 * height

-- Waves balance each other; p presses down. On a plate that does not rotate along its edge the waves alone are
-- w = height cos 2πx cos 2πy, without reactions.
local function waves(p, tilt) return function(x, y) return amplitude * math.cos(2 * pi * x) * math.cos(2 * pi * y) - p + (tilt or 0) * (x - 0.5) end end
local function wave(x, y) return height * math.cos(2 * pi * x) * math.cos(2 * pi * y) end
local edges <const> = { signorini = law.signorini(), friction = law.friction(bound), springs = law.one_sided_elastic(stiffness) }
local function plate(n, element, load, deflection)
  return dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } }, element = element, nu = nu, load = load,
    edge = deflection and { rotation = law.prescribed(), deflection = deflection } }
end
local function solve(...) return dotyk.solve(plate(...)) end

-- 1. Which loads have a solution.
local function told(s)
  if s.reason:find "all rigid motions" then return ("many, energy %.4e: u + a + bx + cy"):format(s.energy) end
  if not s.family then return ("one solution, energy %.4e, middle at %.4e"):format(s.energy, s:deflection(0.5, 0.5)) end
  return ("many, energy %.4e: u + t motion, %g <= t <= %g, motion %+.0f at a corner"):format(s.energy, s.family.from, s.family.to, s:motion(0, 0))
end
local function verdict(case, name, load, expected, deflection)
  local solved <const>, s = pcall(solve, cells, "morley", load, deflection)
  local found <const> = not solved and "none" or s.reason:find "unique up to" and "many" or "one"
  print(("%-24s %-28s %s"):format(case, name, solved and told(s) or s:gsub("^.-solve: ", "")))
  assert(found == expected, case)
  if solved then
    assert(s.converged)
    return s
  end
  local condition <const> = { ["free"] = "(33)", ["Signorini"] = "(45)", ["friction"] = "(63)", ["one-sided elastic"] = "(74)" }
  assert(s:find(condition[case], 1, true))
end
local free <const> = verdict("free", "waves", waves(0), "many")
verdict("free", "waves, pressed by 0.01", waves(0.01), "none")
verdict("free", "waves, tilted by 0.01", waves(0, 0.01), "none")
local mean, tilt = 0, 0
for i = 0, cells - 1 do
  for j = 0, cells - 1 do
    local x <const>, y <const> = (i + 0.5) / cells, (j + 0.5) / cells
    mean, tilt = mean + free:deflection(x, y) / cells^2, tilt + x * free:deflection(x, y) / cells^2
  end
end
print(("%53s of these the one with (u, 1) = (u, x) = (u, y) = 0: %.0e, %.0e by sampling"):format("", mean, tilt))
assert(math.abs(mean) < height / cells and math.abs(tilt) < height / cells)
for _, p in ipairs{ 1, 0, -0.01 } do
  local name <const> = p == 1 and "waves, pressed by 1" or p == 0 and "waves" or "waves, pulled by 0.01"
  local expected <const> = p == 1 and "one" or p == 0 and "many" or "none"
  verdict("Signorini", name, waves(p), expected, edges.signorini)
  verdict("one-sided elastic", name, waves(p), expected, edges.springs)
end
for _, p in ipairs{ 3, 4, 4.01, -4, -4.01 } do
  verdict("friction", ("resultant %+.2f of 4"):format(-p), -p, math.abs(p) < 4 and "one" or math.abs(p) == 4 and "many" or "none", edges.friction)
end

-- 2. Limit cases in closed form. Waves: all w + c that are >= 0 along the edge, c >= height (lemma 10). Friction that slips all along the
-- edge: Δ²w = -4 bound, Tn = bound, whence w = bound (g(x) + g(y)), g(t) = -t²(1 - t)²/12, and all w + c <= 0 along the edge.
local function slipping(x, y) return -bound * ((x * (1 - x))^2 + (y * (1 - y))^2) / 12 end
local limits <const> = { { "Signorini", waves(0), edges.signorini, wave, 1 }, { "one-sided elastic", waves(0), edges.springs, wave, 1 },
  { "friction", -4 * bound, edges.friction, slipping, -1 } }
print "\nlimit cases           element  cells   off w + c    order   c of the solution nearest to the support, and exact"
for _, case in ipairs(limits) do
  for _, element in ipairs{ "morley", "hct" } do
    local last
    for n = cells // 2, cells, cells // 2 do
      local s <const> = solve(n, element, case[2], case[3])
      local touching <const> = case[5] * s:motion(0, 0) > 0 and s.family.from or s.family.to -- t there
      local off, size, c = 0, 0, 0
      local function u(x, y) return s:deflection(x, y) + touching * s:motion(x, y) end
      for i = 0, n do
        for j = 0, n do c = c + (u(i / n, j / n) - case[4](i / n, j / n)) / (n + 1)^2 end
      end
      for i = 0, n do
        for j = 0, n do
          local x <const>, y <const> = i / n, j / n
          off, size = math.max(off, math.abs(u(x, y) - c - case[4](x, y))), math.max(size, math.abs(case[4](x, y)))
        end
      end
      off = off / size
      local exact <const> = case[4] == wave and height or 0
      local order <const> = last and math.log(last / off, 2)
      print(("%-22s %-6s   %4d   %.1e      %4s   %.3e, %g"):format(case[1], element, n, off, order and ("%.2f"):format(order) or "", c, exact))
      assert(not order or order > (element == "morley" and 1.8 or 3))
      assert(math.abs(c - exact) < 40 / n^2 * size)
      last = off
    end
  end
end

-- 3. Loads swept up to the limit.
local function sweep(title, loads, deflection, load_of, x, y)
  print(("\n%s\n     p    energy       middle       middle of an edge   corner      open"):format(title))
  local curves <const> = { { name = "middle", x = {}, y = {}, style = "line" }, { name = "middle of an edge", x = {}, y = {} },
    { name = "corner", x = {}, y = {} } }
  local s
  for k, p in ipairs(loads) do
    s = solve(cells, "hct", load_of(p), deflection)
    local r <const> = s:reaction "edge"
    assert(s.converged and math.abs(r.force - p) < 1e-8) -- balance
    local at <const> = { s:deflection(0.5, 0.5), s:deflection(0.5, 0), s:deflection(0, 0) }
    for i, curve in ipairs(curves) do curve.x[k], curve.y[k] = p, 1000 * at[i] end
    if k % 4 == 1 or k >= #loads - 2 then
      print(("%8.5f  %11.4e  %11.4e  %11.4e        %11.4e  %.3f"):format(p, s.energy, at[1], at[2], at[3], r.open))
    end
  end
  local limit <const> = {}
  for i, at in ipairs{ { 0.5, 0.5 }, { 0.5, 0 }, { 0, 0 } } do
    limit[i] = 1000 * y(at[1], at[2])
    assert(math.abs(curves[i].y[#loads] - limit[i]) < 0.1 * 1000 * height) -- the last one is near the limit
  end
  curves[4] = { name = "limit, closed form", x = { x, x, x }, y = limit, style = "points" }
  return { title = title, x = "resultant of the load, downwards", y = "deflection u · 10³", series = curves }
end
local near <const> = { 0.05, 0.02, 0.01, 0.005 } -- below the limit
local pressing <const>, sliding <const> = {}, {}
for k = 0, 18 do pressing[#pressing + 1], sliding[#sliding + 1] = 2 - k / 10, 0.1 + 3.8 * k / 18 end
for _, off in ipairs(near) do pressing[#pressing + 1], sliding[#sliding + 1] = off, 4 - off end
local function nearest(x, y) return wave(x, y) + height end
local panels <const> = { sweep("Rigid one-sided edge: no solution below 0", pressing, edges.signorini, waves, 0, nearest),
  sweep("One-sided springs: no solution below 0", pressing, edges.springs, waves, 0, nearest),
  sweep("Friction at the edge: no solution above 4", sliding, edges.friction, function(p) return -p end, 4, slipping) }

-- 4. Stiff springs, relative to Signorini's edge. Of the order 1 once the part that touches no longer changes with k.
local apart <const> = {}
print "\nsprings off Signorini's edge, relative\n element     k   energy   order   middle   order"
for _, element in ipairs{ "morley", "hct" } do
  local rigid <const>, label <const> = solve(cells, element, waves(1), edges.signorini), element == "hct" and "HCT" or "Morley"
  local first <const> = #apart
  apart[first + 1], apart[first + 2] = { name = label .. ", energy", x = {}, y = {} }, { name = label .. ", deflection", x = {}, y = {}, twin = true }
  for power = 3, 9 do
    local s <const>, line = solve(cells, element, waves(1), law.one_sided_elastic(10.0^power)), (" %-7s   1e%d"):format(element, power)
    for i, off in ipairs{ math.abs(s.energy / rigid.energy - 1), math.abs(s:deflection(0.5, 0.5) / rigid:deflection(0.5, 0.5) - 1) } do
      local curve <const> = apart[first + i]
      local order <const> = power > 3 and math.log(curve.y[#curve.y] / off, 10)
      line = line .. ("  %.1e  %5s "):format(off, order and ("%.3f"):format(order) or "")
      curve.x[#curve.x + 1], curve.y[#curve.y + 1] = 10.0^-power, off
      if power == 9 then assert(math.abs(order - 1) < 0.03) end
    end
    print(line)
  end
end
panels[4] = { title = "Springs against a rigid edge", x = "compliance 1/k of the springs", y = "relative error", log = "xy", series = apart, slopes = { 1 } }
dotyk.chart{ file = "images/plate_cases.png", panels = panels, columns = 2, size = { 2100, 1400 } }
solve(cells, "hct", waves(0.005), edges.signorini):render{ file = "images/plate_limit.png",
  title = "Waves that hardly press on a one-sided edge" }
solve(cells, "hct", -4, edges.friction):render{ file = "images/plate_limit_friction.png", view = "plan",
  title = "Friction at its limit all along the edge" }
print "images/plate_cases.png, images/plate_limit.png, images/plate_limit_friction.png"
