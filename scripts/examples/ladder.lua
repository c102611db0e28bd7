-- A ladder that leans against a wall, held by contact and friction alone; a block between two walls, held
-- up by given friction alone.
--
--   ./dotyk scripts/examples/ladder.lua [CELLS]
--
-- How far up may a person climb, and how flat may the ladder stand, before it slips? The verdict of
-- scene:balance(), which knows all that floor and wall can carry, is bisected over heights and angles and
-- compared with the closed form. Then the elastic ladder is solved, and its equilibrium of forces and
-- moments checked. Draws images/ladder.png.

local cells <const> = tonumber(arg[1]) or 40
local thick <const>, length <const> = 0.06, 4
local own <const>, person <const> = 150, 800 -- weights

-- 1. The ladder: between the lines from (D, 0) to (0, H) and, (1 + thick) times as far from the corner, from
-- the outer end of its foot to the upper end of its head. The foot stands flat on the floor y = 0, the head
-- leans flat against the wall x = 0. The person stands at the height s (0: foot, 1: head) on the upper side,
-- on two neighbouring rungs which share the weight.
local function ladder(angle, mu_floor, mu_wall, s, n)
  local D <const>, H <const> = length * math.cos(angle), length * math.sin(angle)
  local area <const> = D * H / 2 * ((1 + thick)^2 - 1)
  local body = dotyk.body{ name = "ladder", material = dotyk.material{ E = 1e9, nu = 0.3 }, force = { 0, -own / area },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, math.max(1, n // 20)}, element = "Q1" }:transform(
      function(u, v) local wide = 1 + thick * (1 - v); return D * wide * (1 - u), H * wide * u end) }
  if s then
    local rung = math.min(math.max(s * n + 0.5, 1), n) -- rung k is in the middle of facet k, at (k - 1/2)/n
    local k = math.min(math.floor(rung), n - 1)
    for _, share in ipairs{ { k, 1 - (rung - k) }, { k + 1, rung - k } } do
      local x = D * (1 + thick) * (1 - (share[1] - 0.5) / n)
      local long = length * (1 + thick) / n
      if share[2] > 0 then
        body:part("rung " .. share[1], function(a, _, nx, ny)
          return nx > 0.01 and ny > 0.01 and math.abs(a - x) < 0.1 * D / n
        end):load{ 0, -person * share[2] / long }
      end
    end
  end
  local scene = dotyk.scene{ body }
  local floor = scene:contact{ body:part"left", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} },
                               friction = dotyk.friction.coulomb(mu_floor) }
  local wall = scene:contact{ body:part"right", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {1, 0} },
                              friction = dotyk.friction.coulomb(mu_wall) }
  return scene, floor, wall, body
end

-- 2. The closed form. Floor forces act at y = 0, wall forces at x = 0, so about the corner the weights'
-- moment is x W = x_f N_f - y_w N_w. It is least at the inner end of the foot, x_f = D, and the upper end of
-- the head, y_w = (1 + thick) H, with both surfaces at their limit: N_w = mu_f N_f, N_f (1 + mu_f mu_w) = W.
-- The ladder stands while the weights' common line of action x is not nearer to the wall than
--   x_limit = (D - mu_f (1 + thick) H) / (1 + mu_f mu_w).
local middle <const> = ((1 + thick)^3 - 1) / ((1 + thick)^2 - 1) / 3 -- centroid of the ladder over D
local function height_limit(angle, mu_floor, mu_wall)
  local x = length * (math.cos(angle) - mu_floor * (1 + thick) * math.sin(angle)) / (1 + mu_floor * mu_wall)
  local at = ((own + person) * x - own * middle * length * math.cos(angle)) / person
  return 1 - at / (length * math.cos(angle) * (1 + thick))
end
local function angle_limit(mu_floor, mu_wall) -- of the ladder alone
  return math.atan((1 - middle * (1 + mu_floor * mu_wall)) / (mu_floor * (1 + thick)))
end

-- 3. The sweep, by bisection on the verdict.
local function boundary(low, high, stands)
  while math.abs(high - low) > 1e-9 do
    local between = (low + high) / 2
    if stands(between) then low = between else high = between end
  end
  return low
end
local worst, sweep <const> = 0, 20
local curves = {}
print "angle   mu floor  mu wall   height limit   closed form    difference"
for _, mu in ipairs{ { 0.3, 0 }, { 0.3, 0.3 }, { 0.5, 0.2 } } do
  local found, exact = { x = {}, y = {} }, { x = {}, y = {} }
  for degrees = 50, 75, 2.5 do
    local angle = math.rad(degrees)
    local form = height_limit(angle, mu[1], mu[2])
    local first, last = 0.5 / sweep, 1 - 0.5 / sweep -- where a person may stand
    if form > first and form < last then
      local s = boundary(first, last, function(s) return ladder(angle, mu[1], mu[2], s, sweep):balance().solvable end)
      worst = math.max(worst, math.abs(s - form))
      print(("%5.1f°  %8.2f  %7.2f   %.9f    %.9f    %8.1e"):format(degrees, mu[1], mu[2], s, form, s - form))
      table.insert(found.x, degrees); table.insert(found.y, s)
      table.insert(exact.x, degrees); table.insert(exact.y, form)
    end
  end
  if #found.x > 0 then curves[#curves + 1] = { mu = mu, found = found, exact = exact } end
end
print "the ladder alone:          angle limit    closed form    difference"
for _, mu in ipairs{ { 0.3, 0 }, { 0.3, 0.3 }, { 0.5, 0.2 }, { 0.8, 0.8 } } do
  local form = angle_limit(mu[1], mu[2])
  local angle = boundary(math.rad(89), math.rad(5), function(a) return ladder(a, mu[1], mu[2], nil, sweep):balance().solvable end)
  worst = math.max(worst, math.abs(angle - form))
  print(("        %8.2f  %7.2f   %.9f    %.9f    %8.1e"):format(mu[1], mu[2], angle, form, angle - form))
end
print(("greatest difference %.1e"):format(worst))

-- 4. The elastic ladder at 65°, the person two thirds up.
local angle <const> = math.rad(65)
local scene, floor, wall, body = ladder(angle, 0.5, 0.2, 2 / 3, cells)
print(scene:plan())
local s = dotyk.solve(scene)
print(s)
-- Forces on the ladder, and their moment about the corner (of the places at rest, as the linear theory has it).
local fx, fy, moment = 0, 0, 0
for _, contact in ipairs{ floor, wall } do
  local c = s:contact(contact)
  fx, fy = fx + c.force[1], fy + c.force[2]
  for _, node in ipairs(c.nodes) do
    local px, py = -node.force * node.normal[1] + node.shear[1] * node.weight, -node.force * node.normal[2] + node.shear[2] * node.weight
    moment = moment + node.x * py - node.y * px
  end
  print(("%-40s pushes with (%9.4f, %9.4f), %d stick, %d slip, %d open"):format(contact.name, c.force[1], c.force[2], c.stick, c.slip, c.open))
end
local D <const> = length * math.cos(angle)
local loads <const> = own * middle * D + person * D * (1 + thick) * (1 - 2 / 3)
local missing = math.max(math.abs(fx), math.abs(fy - own - person)) / (own + person)
local turning = math.abs(moment - loads) / loads
print(("equilibrium: forces to %.1e, moments to %.1e of the weights'"):format(missing, turning))
s:render{ file = "images/ladder.png", field = "von_mises", deform = 100, loads = true, units = { length = "m", stress = "Pa", load = "Pa" }, zoom = { 1.4, -0.15, 2.1, 0.35 } }

-- 5. A block between two walls, by given friction g alone: 2 g A is all it carries.
local function wedged(weight, g, n)
  local block = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 }, force = { 0, -weight },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {n, n}, element = "Q1" } }
  local scene = dotyk.scene{ block }
  local walls = {}
  for part, normal in pairs{ left = {-1, 0}, right = {1, 0} } do -- each wall 0.001 inside the block
    walls[#walls + 1] = scene:contact{ block:part(part), friction = dotyk.friction.tresca(g),
                                       rigid = dotyk.rigid.gap{ normal = normal, gap = -0.001 } }
  end
  return scene, walls
end
local g <const> = 0.7
local limit = boundary(0, 10, function(weight) return wedged(weight, g, 8):balance().solvable end)
print(("a block between walls with given friction %g: carried up to %.9f, closed form 2 g A = %.9f"):format(g, limit, 2 * g))
worst = math.max(worst, math.abs(limit / (2 * g) - 1))
for _, part in ipairs{ 0.5, 0.9, 0.99 } do
  local scene, walls = wedged(2 * g * part, g, 24)
  local t = dotyk.solve(scene)
  local up, across, stick, slip = 0, 0, 0, 0
  for _, w in ipairs(walls) do
    local c = t:contact(w)
    up, across, stick, slip = up + c.force[2], across + c.force[1], stick + c.stick, slip + c.slip
  end
  local off = math.max(math.abs(up / (2 * g * part) - 1), math.abs(across) / up)
  missing = math.max(missing, off)
  print(("  %2.0f %% of it: %2d nodes stick, %2d slip, equilibrium to %.1e, %s"):format(100 * part, stick, slip, off, t.converged and "converged" or t.reason))
end
print("  1e-6 beyond it: " .. wedged(2 * g * (1 + 1e-6), g, 24):balance().verdict)
print "images/ladder.png"
if worst > 1e-6 then error "a limit is wrong" end
if missing > 1e-10 or turning > 1e-10 then error "a body is not in equilibrium" end
