-- Elements of second order, P2 and Q2, beside P1 and Q1: accuracy against unknowns and seconds.
--
--   ./dotyk scripts/studies/accuracy/second_order.lua [LEVELS]
--
-- 1. Lamé's thick ring under pressure inside, a smooth solution on a curved boundary: a quarter of it, closed form beside it. The
--    hoop stress at the bore converges with order 2 on P2, Q2 and Q1, with order 1 on P1; the displacement with order 3 (Q2: 4) and 2.
--    The edges of P2 and Q2 follow the arcs.
-- 2. Hertz's line contact of two blocks: the force for an approach (mean error of five). At the contact's edge the solution is less smooth than
--    quadratic elements could use: at equal unknowns they win nothing over Q1 there, only over P1.
-- Draws images/second_order.png and images/second_order_hertz.png; fails where an order falls short.

local levels <const> = tonumber(arg[1]) or 4
local hertz <const> = include "../../lib/hertz_blocks.lua"
local elements <const> = { "P1", "Q1", "P2", "Q2" }
local passed = true

-- Seconds of a solve: the shortest of three.
local function solve(make)
  local s, contact, best = nil, nil, math.huge
  for _ = 1, 3 do
    local scene
    scene, contact = make()
    s = dotyk.solve(scene)
    best = math.min(best, s.time.total)
  end
  return s, best, contact
end

local function chart(lists, xs, ys)
  local out = {}
  for _, element in ipairs(elements) do
    out[#out + 1] = { name = element, x = lists[element][xs], y = lists[element][ys], style = "both" }
  end
  return out
end

-- 1. Lamé. Radii a and b, pressure p inside, plane strain: σ_θ(a) = p (b² + a²)/(b² − a²), u_r by Hooke's law.
local a <const>, b <const>, p <const>, E <const>, nu <const> = 1, 2, 1, 1000, 0.3
local steel <const> = dotyk.material{ E = E, nu = nu }
local hoop <const> = p * (b^2 + a^2) / (b^2 - a^2)
local bore <const> = p * a * (1 + nu) / E * ((1 - 2 * nu) * a^2 + b^2) / (b^2 - a^2)

local function ring(n, element)
  local m <const> = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, 2 * n}, element = element }
  m:transform(function(s, t)
    local r, angle = a + (b - a) * s, math.pi / 2 * t
    return r * math.cos(angle), r * math.sin(angle)
  end)
  local body = dotyk.body{ name = "ring", mesh = m, material = steel }
  body:part"bottom":slide() -- the axes, where the quarter is cut from the ring
  body:part"top":slide()
  body:part"left":pressure(p)
  return dotyk.scene{ body }, body, m
end

local lame = {}
print "Lamé's ring: errors at the bore, relative\n"
print "  element   cells    unknowns    seconds    displacement  order    hoop stress  order"
for _, element in ipairs(elements) do
  local list = { unknowns = {}, seconds = {}, displacement = {}, stress = {} }
  lame[element] = list
  for level = 1, levels do
    local n <const> = 4 << (level - 1)
    local body, m
    local s, seconds = solve(function()
      local scene
      scene, body, m = ring(n, element)
      return scene
    end)
    local angle <const> = math.pi / 4 -- an edge's end on every mesh
    local x, y = a * math.cos(angle), a * math.sin(angle)
    local ux, uy = s:displacement(body, x, y)
    local stress <const> = s:stress(body, x, y)
    list.unknowns[level], list.seconds[level] = 2 * m.node_count, seconds
    list.displacement[level] = math.abs((ux + uy) / math.sqrt(2) / bore - 1)
    list.stress[level] = math.abs(((stress.xx + stress.yy) / 2 - stress.xy) / hoop - 1)
    local function order(of) return level > 1 and ("%5.2f"):format(math.log(of[level - 1] / of[level], 2)) or "     " end
    print(("  %s      %3dx%-4d %8d    %8.4f      %9.2e  %s      %9.2e  %s"):format(element, n, 2 * n, list.unknowns[level], seconds,
      list.displacement[level], order(list.displacement), list.stress[level], order(list.stress)))
  end
  local function last(of) return math.log(of[levels - 1] / of[levels], 2) end
  local second <const> = element == "P2" or element == "Q2"
  -- On P1 the stress that is recovered at a boundary is of order 1 in the end.
  passed = passed and last(list.displacement) > (second and 2.8 or 1.8) and (not second or last(list.stress) > 1.8)
end
dotyk.chart{ file = "images/second_order.png", size = {1000, 1400}, panels = {
  { title = "Lamé's ring: displacement at the bore", x = "unknowns", y = "relative error", log = "xy", slopes = { -1, -1.5 }, series = chart(lame, "unknowns", "displacement") },
  { title = "Hoop stress at the bore", x = "unknowns", y = "relative error", log = "xy", slopes = { -1 }, series = chart(lame, "unknowns", "stress") },
  { title = "Hoop stress: accuracy against time", x = "seconds", y = "relative error", log = "xy", series = chart(lame, "seconds", "stress") } } }

-- 2. Hertz: the force at five approaches, beside that of a mesh twice as fine as the finest. The error jumps with the distance of the
-- contact's edge from the nearest node: root mean squares over the five.
local approaches <const> = { 0.12, 0.132, 0.144, 0.156, 0.168 }
local function force_of(n, element, approach)
  local s, seconds, contact = solve(function() return hertz.scene(n, n, "matching", element, approach) end)
  return 2 * s:contact(contact).force[2], seconds
end
local reference = {}
for k, approach in ipairs(approaches) do reference[k] = force_of(12 << levels, "Q2", approach) end
print(("\nHertz's line contact: force for approaches of 0.12 to 0.168 mm, beside Q2 twice as fine as the finest (%.1f to %.1f N/mm)\n"):format(
  reference[1], reference[#reference]))
print "  element   cells    unknowns    seconds      error     order"
local line = {}
for _, element in ipairs(elements) do
  local list = { unknowns = {}, seconds = {}, force = {} }
  line[element] = list
  for level = 1, levels do
    local n <const> = 12 << (level - 1)
    local sum, total = 0, 0
    for k, approach in ipairs(approaches) do
      local force, seconds = force_of(n, element, approach)
      sum, total = sum + (force / reference[k] - 1)^2, total + seconds
    end
    local per <const> = (element == "P2" or element == "Q2") and 2 or 1
    list.unknowns[level], list.seconds[level] = 4 * (per * n + 1)^2, total / #approaches
    list.force[level] = math.sqrt(sum / #approaches)
    print(("  %s      %3dx%-4d %8d    %8.4f   %9.2e   %s"):format(element, n, n, list.unknowns[level], list.seconds[level], list.force[level],
      level > 1 and ("%5.2f"):format(math.log(list.force[level - 1] / list.force[level], 2)) or ""))
  end
end
dotyk.chart{ file = "images/second_order_hertz.png", size = {1000, 1000}, panels = {
  { title = "Hertz's line contact: force", x = "unknowns", y = "relative error", log = "xy", slopes = { -1 }, series = chart(line, "unknowns", "force") },
  { title = "Accuracy against time", x = "seconds", y = "relative error", log = "xy", series = chart(line, "seconds", "force") } } }
print "\nimages/second_order.png, images/second_order_hertz.png"
print(passed and "orders are those of the elements" or "FAILED")
if not passed then os.exit(1) end
