-- Plates on obstacles: a circular plate pressed onto a flat floor, and a free square one draped over a bump.
--
--   ./dotyk scripts/examples/plate_obstacle.lua [FINEST]
--
-- The circle is clamped at its edge, a floor lies below it; D = 1. Under a load that reaches the floor it lies flat on a disc of
-- radius c, where the floor bears the load q; on the circle r = c it bears a force per length besides, and outside
--   w = w_q + A + B r² + C ln r + E r² ln r,   w_q = -q r⁴/64,   w = -depth, w' = w'' = 0 at r = c,   w = w' = 0 at r = 1:
-- four constants and c. Shown: the radius and the floor's force against these, refined; then a plate held by nothing but its
-- obstacle and its weight, that bends over a bump: where it touches. FINEST: cells along the radius.
-- Draws images/plate_obstacle.png, images/plate_obstacle_plan.png and images/plate_obstacle_bump.png.

local law <const> = dotyk.law
local finest <const> = tonumber(arg[1]) or 32
local load <const>, depth <const> = 1, 0.003 -- without a floor it would bend to 1/64

-- 1. Closed form: A, B, C, E from the three conditions at c and w(1) = 0; c where w'(1) = 0.
local function conditions(c)
  -- Rows: value, slope, second derivative of A, B r², C ln r, E r² ln r.
  local function at(r)
    local l <const> = math.log(r)
    return { { 1, r^2, l, r^2 * l }, { 0, 2 * r, 1 / r, r * (2 * l + 1) }, { 0, 2, -1 / r^2, 2 * l + 3 } },
      { -load * r^4 / 64, -load * r^3 / 16, -3 * load * r^2 / 16 }
  end
  local inner <const>, q <const> = at(c)
  local outer <const>, p <const> = at(1)
  return { inner[1], inner[2], inner[3], outer[1] }, { -depth - q[1], -q[2], -q[3], -p[1] }, outer[2], p[2]
end
local solve_linear <const> = include "../lib/plate.lua".solve_linear
local function slope_at_edge(c)
  local A <const>, b <const>, last <const>, p <const> = conditions(c)
  solve_linear(A, b)
  local slope = p
  for j = 1, 4 do slope = slope + last[j] * b[j] end
  return slope, b
end
local low, high = 0.05, 0.95
assert(slope_at_edge(low) * slope_at_edge(high) < 0)
for _ = 1, 60 do
  local middle <const> = (low + high) / 2
  if slope_at_edge(low) * slope_at_edge(middle) <= 0 then high = middle else low = middle end
end
local c <const> = low
local _, constants <const> = slope_at_edge(c)
local A <const>, B <const>, C <const>, E <const> = table.unpack(constants)
local force <const> = 8 * math.pi * E -- of the floor: what the edge does not bear, 2π (Δw)' = -π load + 8π E at r = 1
local ring <const> = force - math.pi * c^2 * load
local function exact(r)
  if r <= c then return -depth end
  return -load * r^4 / 64 + A + B * r^2 + C * math.log(r) + E * r^2 * math.log(r)
end

-- 2. The circle.
local function circle(n, element)
  return dotyk.solve(dotyk.plate{ mesh = dotyk.mesh.disc{ center = { 0, 0 }, radius = 1, cells = n }, element = element, nu = 0.3, load = -load,
    edge = { deflection = law.prescribed(), rotation = law.prescribed() }, obstacle = -depth })
end
print(("clamped circle on a floor: flat within c = %.6f, the floor bears %.6f, of that %.6f on r = c"):format(c, force, ring))
print "element  cells  iterations   farthest node that bears   force      off       within c - 2h   deflection off"
local last <const> = {}
for _, element in ipairs{ "morley", "hct" } do
  for _, n in ipairs{ finest // 2, 3 * finest // 4, finest } do
    local s <const> = circle(n, element)
    local reach, within, off = 0, 0, 0
    for _, node in ipairs(s.contact.nodes) do
      local r <const> = math.sqrt(node.x^2 + node.y^2)
      reach = math.max(reach, r)
      if r < c - 2 / n then within = within + node.force end
    end
    for k = 0, 40 do off = math.max(off, math.abs(s:deflection(0.98 * k / 40, 0) - exact(0.98 * k / 40)) / depth) end
    print(("%-7s  %5d  %10d   %24.4f   %.6f   %.1e   %13.6f   %.1e"):format(element, n, s.iterations, reach, s.contact.force,
      math.abs(s.contact.force / force - 1), within, off))
    assert(s.converged and math.abs(reach - c) < 1.5 / n)
    last[element] = { off = off, force = math.abs(s.contact.force / force - 1) }
  end
  assert(last[element].off < 40 / finest^2 and last[element].force < 40 / finest^2)
end

-- 3. A free plate on a bump.
local function bump(x, y) return 0.15 - 0.1 * (x^2 + y^2) end
local function draped(n, element)
  return dotyk.solve(dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = { -1, -1 }, to = { 1, 1 }, cells = { n, n } }, element = element, nu = 0.3,
    load = -1, obstacle = bump })
end
for _, element in ipairs{ "morley", "hct" } do
  local s <const> = draped(finest, element)
  print(("\nfree square on a bump, %s: %d of %d nodes bear, force %.9f, middle of an edge %.5f, corner %.5f above the bump"):format(element, #s.contact.nodes,
    s.rows, s.contact.force, s:deflection(1, 0) - bump(1, 0), s:deflection(1, 1) - bump(1, 1)))
  assert(s.converged and math.abs(s.contact.force - 4) < 1e-8)
end
local shown <const> = circle(finest, "morley")
shown:render{ file = "images/plate_obstacle.png", title = "A clamped plate pressed onto a floor" }
circle(finest, "hct"):render{ file = "images/plate_obstacle_plan.png", view = "plan", field = "von_mises", title = "Where it bears on the floor" }
draped(finest, "morley"):render{ file = "images/plate_obstacle_bump.png", title = "A free plate on a bump" }
print "images/plate_obstacle.png, images/plate_obstacle_plan.png, images/plate_obstacle_bump.png"
