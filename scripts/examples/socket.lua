-- A ball in a socket, pressed in and then pushed sideways, in space: Coulomb friction, stick inside, slip at the edge.
--
--   ./dotyk scripts/examples/socket.lua [CELLS]
--
-- The lower half of a steel ball lies in a hollow of a bronze block; one half of both is modelled, beside the plane of symmetry y = 0. The
-- hollow is wider than the ball by the clearance c: at the angle θ from the axis the gap is c (1 − cos θ). Both meshes are boxes
-- whose faces are mapped onto the same sphere, so that their nodes match; the clearance is told as the contact's gap, which is
-- right to first order in c/R. Nothing but contact and friction holds the ball. It is pressed down in four steps, then pushed along x in four.
-- Shows the contact after each step, the balance of forces and moments, and images/socket.png. Units: N, mm.

local n <const> = tonumber(arg[1]) or 24 -- cells across the hollow, a multiple of 4
local R <const>, clearance <const>, mu <const> = 10, 0.05, 0.3
local rim <const> = math.rad(70)            -- angle of the hollow's rim from the axis
local side <const>, depth <const> = 14, 18  -- half of the block's side; its bottom below the ball's centre
local press <const>, push <const> = 60, 15  -- MPa on the ball's flat side

-- 1. The square |u|, |v| <= 1 onto a disc of radius 1, and onto the sphere up to the rim, finer near the axis.
local function disc(u, v) return u * math.sqrt(1 - v^2 / 2), v * math.sqrt(1 - u^2 / 2) end
local function sphere(u, v)
  local x, y = disc(u, v)
  local r = math.sqrt(x^2 + y^2)
  local angle = rim * r * (0.75 + 0.25 * r^2)
  local out = r > 0 and R * math.sin(angle) / r or 0
  return out * x, out * y, -R * math.cos(angle)
end

-- 2. The ball: the box's bottom onto the sphere, its top onto the flat side, straight in between.
local ball_mesh <const> = dotyk.mesh.box{ from = {-1, 0, 0}, to = {1, 1, 1}, cells = {n, n // 2, n // 2}, element = "Q1" }:transform(
  function(u, v, t)
    local x, y, z = sphere(u, v)
    local dx, dy = disc(u, v)
    return x + t * (R * dx - x), y + t * (R * dy - y), (1 - t) * z
  end)

-- 3. The block: the middle of the box's top onto the sphere, around it from the rim's circle to the block's sides.
local whole <const> = 1.5 -- the block's side in u and v
local block_mesh <const> = dotyk.mesh.box{ from = {-whole, 0, 0}, to = {whole, whole, 1}, cells = {3 * n // 2, 3 * n // 4, n // 2}, element = "Q1" }:transform(
  function(u, v, t)
    local p = math.max(math.abs(u), math.abs(v), 1) -- 1 within the hollow
    local x, y, z = sphere(u / p, v / p)
    local out = (p - 1) / (whole - 1)
    return x + out * (side * u / p - x), y + out * (side * v / p - y), -depth + t * (z + depth)
  end)

-- 4. The bodies, the loads by name, and what touches.
local ball <const> = dotyk.body{ name = "ball", mesh = ball_mesh, material = dotyk.material{ E = 210e3, nu = 0.3 } }
local socket <const> = dotyk.body{ name = "socket", mesh = block_mesh, material = dotyk.material{ E = 100e3, nu = 0.34 } }
socket:part "bottom":fix()
for _, body in ipairs{ ball, socket } do body:part "front":slide() end
ball:part "top":load({ 0, 0, -press }, "press")
ball:part "top":load({ push, 0, 0 }, "push")
local hollow <const> = socket:part("hollow", function(_, _, z, _, _, nz) return nz > 0.1 and z < -R * math.cos(rim) - 1e-6 end)
local scene <const> = dotyk.scene{ ball, socket }
local contact <const> = scene:contact{ ball:part "bottom", hollow, friction = dotyk.friction.coulomb(mu),
  gap = function(_, _, z) return clearance * (1 + z / R) end }

-- 5. The history of loads.
local steps <const> = {}
for k = 1, 8 do steps[k] = { load = { press = math.min(k / 4, 1), push = math.max(0, k / 4 - 1) } } end
local s <const> = dotyk.solve(scene, { steps = steps })
print(s)
print "press  push   open  stick  slip   greatest pressure [MPa]   contact reaches from the axis, back and ahead [°]"
for k, step in ipairs(s.steps) do
  local c <const> = step:contact(contact)
  local back, ahead = 0, 0
  for _, node in ipairs(c.nodes) do
    local angle <const> = math.deg(math.acos(-node.z / R))
    if node.status ~= "open" and node.x < 0 then back = math.max(back, angle) end
    if node.status ~= "open" and node.x > 0 then ahead = math.max(ahead, angle) end
  end
  print(("%5.2f %5.2f %6d %6d %5d %25.1f %36.1f %5.1f"):format(steps[k].load.press, steps[k].load.push, c.open, c.stick, c.slip, c.max_pressure, back, ahead))
end

-- 6. Does it balance? Loads have no moment about the ball's centre, so contact has none.
local c <const> = s:contact(contact)
local fx, _, fz = s:reaction(socket:part "bottom")
print(("contact on the ball %.4f, 0, %.4f N; support of the block %.4f, 0, %.4f N"):format(c.force[1], c.force[3], fx, fz))
local moment, size = 0, 0
for _, node in ipairs(c.nodes) do
  local px, pz = node.shear[1] - node.pressure * node.normal[1], node.shear[3] - node.pressure * node.normal[3]
  moment, size = moment + node.weight * (node.z * px - node.x * pz), size + node.weight * R * node.pressure
end
print(("its moment about y: %.1e of the radius times all pressure"):format(math.abs(moment / size)))
assert(s.converged and #s.warnings == 0 and math.abs(moment / size) < 1e-10)
assert(math.abs(fx / c.force[1] - 1) < 1e-8 and math.abs(fz / c.force[3] - 1) < 1e-8, "what presses on the block is what its support bears")

local units = { length = "mm", stress = "MPa" }
dotyk.pictures{ file = "images/socket.png", columns = 2,
                s:picture{ field = "von_mises", units = units, deform = 1, view = { -0.35, -1, 0.55 }, title = "Cut through the middle" },
                s:picture{ map = contact, units = units, title = "Pressure, seen from above" },
                s:picture{ map = contact, field = "slip", units = units, title = "Slip since the start" },
                s:picture{ map = contact, field = "gap", units = units, title = "Gap" } }
print "images/socket.png"
