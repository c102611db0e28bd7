-- Kirchhoff plates against closed forms, and the orders of both elements.
--
--   ./dotyk scripts/examples/plate.lua [FINEST]
--
-- Shown: clamped and simply supported squares and circles under a uniform load (deflection, moments, the forces that hold
-- down the corners), free plates under loads that balance; errors of Morley's element and of HCT's, and the orders at which they
-- fall. Then known smooth deflections of a clamped and of a free plate: errors over the whole plate, order 1 in energy and
-- 2 in L2 with Morley, 2 and 4 with HCT. FINEST: cells along a side. Draws images/plate_orders.png.
--
-- The circle is a polygon to the mesh. Supported simply, a plate on that polygon does not tend to the circle's plate but to
-- 3/64 qR⁴/D in the middle for every ν (Babuška's paradox): a straight edge holds both derivatives at its ends. Where the
-- edge turns little from one facet to the next, laws therefore act along the curve's own normal, and the circle's value comes out.

local law <const> = dotyk.law
local plate <const>, fit <const> = include "../lib/plate.lua", include "../lib/least_squares.lua"
local finest <const> = tonumber(arg[1]) or 64
local nu <const>, pi <const> = 0.3, math.pi
local held <const>, hinged <const> = { deflection = law.prescribed(), rotation = law.prescribed() }, { deflection = law.prescribed() }
local sizes <const> = { finest // 4, finest // 2, finest }
local elements <const> = { "morley", "hct" }

local function square(n) return dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { n, n } } end
local function disc(n) return dotyk.mesh.disc{ center = { 0, 0 }, radius = 1, cells = n // 2 } end

-- 1. Uniform load q = 1 downwards, D = 1: what is measured, its closed form, and the order of each element.
local clamped <const>, simple <const> = plate.clamped(60), plate.simply_supported(nu)
local cases <const> = {
  { "square, clamped", square, held,
    { "deflection / (q a^4/D)", -clamped.deflection, function(s) return s:deflection(0.5, 0.5) end, { 2, 4 } },
    { "moment, edge / (q a^2)", clamped.moment, function(s) return -s:moment(0.5, 0).yy end, { 1, 2 } } },
  { "square, simply supported", square, hinged,
    { "deflection / (q a^4/D)", -simple.deflection, function(s) return s:deflection(0.5, 0.5) end, { 2, 4 } },
    { "moment, middle / (q a^2)", simple.moment, function(s) return -s:moment(0.5, 0.5).xx end, { 2, 2 } },
    { "corner force / (q a^2)", -simple.corner, function(s) return s:corners()[1].force end, { 1.5, 1.5 } } },
  { "circle, clamped", disc, held,
    { "deflection / (q R^4/D)", -1 / 64, function(s) return s:deflection(0, 0) end, { 2, 2 } } },
  { "circle, simply supported", disc, hinged,
    { "deflection / (q R^4/D)", -(5 + nu) / (1 + nu) / 64, function(s) return s:deflection(0, 0) end, { 2, 2 } } },
}
print(("uniform load, nu = %.1f, and exact values     cells    Morley       off     order    HCT          off     order"):format(nu))
for _, case in ipairs(cases) do
  print(case[1])
  local solved <const> = {}
  for level, n in ipairs(sizes) do
    solved[level] = {}
    for e, element in ipairs(elements) do
      solved[level][e] = dotyk.solve(dotyk.plate{ mesh = case[2](n), element = element, nu = nu, load = -1, edge = case[3] })
    end
  end
  for k = 4, #case do
    local what <const>, exact <const>, measure <const>, designed <const> = table.unpack(case[k])
    local last <const> = {}
    for level, n in ipairs(sizes) do
      local line = ("  %-26s %12s    %3d"):format(level == 1 and what or "", level == 1 and ("%.9f"):format(exact) or "", n)
      for e, s in ipairs(solved[level]) do
        local off <const> = math.abs(measure(s) / exact - 1)
        local order <const> = last[e] and math.log(last[e] / off, 2)
        line = line .. ("    %10.8f  %.1e  %4s"):format(measure(s), off, order and ("%.2f"):format(order) or "")
        assert(level < #sizes or order > designed[e] - 0.2, what)
        last[e] = off
      end
      print(line)
    end
  end
end

-- 2. Free plates. Forces at the corners twist one into u = xy, which both elements have: exact.
for _, element in ipairs(elements) do
  local corner <const>, loads <const> = 2 * (1 - nu), {}
  for k = 0, 3 do
    local x <const>, y <const> = k % 2, k // 2
    loads[k + 1] = { x = x, y = y, force = x == y and corner or -corner }
  end
  local s <const> = dotyk.solve(dotyk.plate{ mesh = square(finest // 8), element = element, nu = nu, loads = loads })
  local off = 0
  for i = 0, 20 do
    for j = 0, 20 do off = math.max(off, math.abs(s:deflection(i / 20, j / 20) - (i / 20 - 0.5) * (j / 20 - 0.5))) end
  end
  print(("free plate twisted by forces at its corners, %s: off u = (x - 1/2)(y - 1/2) by %.0e"):format(element, off))
  assert(off < 1e-9 and s.reason:find "unique up to all rigid motions")
end

-- 3. Known deflections: D = 1, the load Δ²u; u returns u, uxx, uyy, uxy.
local cos <const>, sin <const> = math.cos, math.sin
local function bump(t) return sin(pi * t)^2, pi * sin(2 * pi * t), 2 * pi^2 * cos(2 * pi * t), -8 * pi^4 * cos(2 * pi * t) end -- f, f′, f″, f⁗
local known <const> = {
  { name = "clamped", text = "clamped, u = sin² πx sin² πy", edge = held,
    u = function(x, y)
      local f <const>, fx <const>, fxx <const> = bump(x)
      local g <const>, gy <const>, gyy <const> = bump(y)
      return f * g, fxx * g, f * gyy, fx * gy
    end,
    load = function(x, y)
      local f <const>, _ <const>, fxx <const>, fxxxx <const> = bump(x)
      local g <const>, _ <const>, gyy <const>, gyyyy <const> = bump(y)
      return fxxxx * g + 2 * fxx * gyy + f * gyyyy
    end },
  -- Tₙ and the forces at corners are zero; −Mₙ = (1 + ν) ∂ₙₙu bends the edges.
  { name = "free", text = "free, u = cos πx cos πy, edges loaded by moments",
    edge = { rotation = function(x, y) return law.load(-(1 + nu) * pi^2 * cos(pi * x) * cos(pi * y)) end },
    u = function(x, y)
      local u <const> = cos(pi * x) * cos(pi * y)
      return u, -pi^2 * u, -pi^2 * u, pi^2 * sin(pi * x) * sin(pi * y)
    end,
    load = function(x, y) return 4 * pi^4 * cos(pi * x) * cos(pi * y) end },
}
local designed <const>, series <const> = { morley = { 1, 2 }, hct = { 2, 4 } }, {}
for _, case in ipairs(known) do
  print(("\n%s: relative errors\n element  cells   energy   order   L2       order"):format(case.text))
  for _, element in ipairs(elements) do
    local h <const>, energy <const>, L2 <const>, n = {}, {}, {}, math.max(4, finest // 16)
    while n <= finest do
      local s <const> = dotyk.solve(dotyk.plate{ mesh = square(n), element = element, nu = nu, load = case.load, edge = case.edge })
      h[#h + 1], energy[#energy + 1], L2[#L2 + 1] = 1 / n, plate.distance(s, n, nu, case.u)
      local k <const> = #h
      local function order(of) return k > 1 and ("%.2f"):format(math.log(of[k - 1] / of[k], 2)) or "" end
      print((" %-7s  %5d   %.1e  %5s   %.1e  %5s"):format(element, n, energy[k], order(energy), L2[k], order(L2)))
      n = 2 * n
    end
    for which, errors in ipairs{ energy, L2 } do
      local last <const> = { errors[#h - 1], errors[#h] }
      assert(math.abs(math.log(last[1] / last[2], 2) / designed[element][which] - 1) < 0.08, element)
      if case.name == "clamped" then
        series[#series + 1] = { name = ("%s, %s"):format(element == "hct" and "HCT" or "Morley", which == 1 and "energy" or "L²"), x = h, y = errors }
      end
    end
  end
end
dotyk.chart{ file = "images/plate_orders.png", title = "Clamped, u = sin² πx sin² πy", x = "length of a cell", y = "relative error",
  log = "xy", series = series, slopes = { 1, 2, 4 } }
print "images/plate_orders.png"
