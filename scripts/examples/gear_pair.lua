-- Two spur gears in space, shafts not quite parallel: two pairs of flanks bear more at one end of the teeth; Coulomb friction.
--
--   ./dotyk scripts/examples/gear_pair.lua [CELLS]
--
-- Sectors of polyamide gears, three teeth each: involute flanks, pressure angle 20°. Two pairs touch, half a base pitch before and
-- after the pitch point. The meshes are boxes, transformed, with the spaces between teeth left out; their nodes do not match. The upper
-- gear is held, the lower one's hub is turned clockwise in steps. Shafts out of parallel make a gap that grows along the teeth: it is
-- told as the contacts' gap. Shows the contacts after each step beside what is known: pressures act along the line of action, so
-- their arms about the axes are the radii of the base circles, and friction turns a force by at most its angle.
-- images/gear_pair.png. Units: N, mm.

local cells <const> = tonumber(arg[1]) or 24 -- along the part of a flank where it may touch
local size <const>, alpha <const>, face <const> = 4, math.rad(20), 20 -- module, pressure angle, width of the teeth
local teeth <const>, shown <const> = { 24, 30 }, 3
local backlash <const>, skew <const>, turn <const>, mu <const> = 0.2, 3e-3, 4e-3, 0.3
local centres <const> = size * (teeth[1] + teeth[2]) / 2 -- the upper axis above the lower one, which is the origin

-- 1. Where flanks touch: on the line of action through the pitch point.
local touches <const> = {}
for k, side in ipairs{ -1, 1 } do
  local way <const> = side * math.pi * size * math.cos(alpha) / 2
  touches[k] = { way * math.cos(alpha), size * teeth[1] / 2 + way * math.sin(alpha) }
end

-- 2. A gear about the origin, teeth upwards, that bears on the right of its first two teeth shown, at these places. Angles are
-- from the y axis, clockwise. Mesh; is a place on tooth k's right flank?; radius of the base circle.
local function gear(count, places)
  local radius <const>, pitch <const> = size * count / 2, 2 * math.pi / count
  local base <const>, root <const>, tip <const> = radius * math.cos(alpha), radius - 1.25 * size, radius + size
  local function involute(r) local a <const> = math.acos(math.min(1, base / r)) return math.tan(a) - a end
  local function half(r) -- of a tooth, as an angle; below the base circle a fillet
    local fillet <const> = 0.4 * size / r * math.max(0, (base - r) / (base - root))^2
    return (math.pi * size / 2 - backlash) / 2 / radius + math.tan(alpha) - alpha - involute(r) + fillet
  end
  local first, low, high = math.huge, math.huge, 0 -- the first tooth's angle, least and greatest radius that touch
  for _, p in ipairs(places) do
    local r <const> = math.sqrt(p[1]^2 + p[2]^2)
    first, low, high = math.min(first, math.atan(p[1], p[2]) - half(r)), math.min(low, r), math.max(high, r)
  end
  -- Cells outwards and radii: rim, foot, where it touches, tip. Around: half a space, a tooth, finer on its right, half a space.
  local outwards <const> = { { 3, root - 1.5 * size, root }, { 4, root, low - 0.8 }, { cells, low - 0.8, high + 0.8 }, { 2, high + 0.8, tip } }
  local rim <const>, tall <const>, space <const>, wide <const> = 3, 9 + cells, 2, 6
  local around <const> = wide + 2 * space
  local function radius_at(v)
    for _, part in ipairs(outwards) do
      if v <= part[1] then return part[2] + v / part[1] * (part[3] - part[2]) end
      v = v - part[1]
    end
  end
  local mesh <const> = dotyk.mesh.box{ from = {0, 0, 0}, to = {shown * around, tall, face}, cells = {shown * around, tall, 8}, element = "Q1" }
    :keep(function(u, v) return v < rim or math.abs(u % around - around / 2) < wide / 2 end, "flanks")
    :transform(function(u, v, z)
      local k <const>, r <const> = math.min(u // around, shown - 1), radius_at(v)
      local at <const>, edge <const> = u - k * around, half(math.max(r, root))
      local angle
      if at < space then angle = -pitch / 2 + at / space * (pitch / 2 - edge)
      elseif at > around - space then angle = pitch / 2 - (around - at) / space * (pitch / 2 - edge)
      else angle = edge * (1 - 2 * (1 - (at - space) / wide)^1.7) end
      angle = first + k * pitch + angle
      return r * math.sin(angle), r * math.cos(angle), z
    end)
  local function on_flank(k, x, y)
    local r <const> = math.sqrt(x^2 + y^2)
    return r > low - 0.8 and r < tip - 1e-3 and math.abs(math.atan(x, y) - first - k * pitch - half(r)) < 0.02 * pitch
  end
  return mesh, on_flank, base
end

-- 3. The lower gear, and the upper one, turned by half a turn.
local function turned(x, y) return -x, centres - y end
local lower_mesh <const>, on_lower <const>, lower_base <const> = gear(teeth[1], touches)
local upper_mesh <const>, on_upper <const>, upper_base <const> = gear(teeth[2], { { turned(table.unpack(touches[1])) }, { turned(table.unpack(touches[2])) } })
upper_mesh:transform(function(x, y, z) x, y = turned(x, y) return x, y, z end)
local polyamide <const> = dotyk.material{ E = 3000, nu = 0.38 }
local lower <const> = dotyk.body{ name = "lower", mesh = lower_mesh, material = polyamide }
local upper <const> = dotyk.body{ name = "upper", mesh = upper_mesh, material = polyamide }
for _, part in ipairs{ "left", "right", "front" } do -- where the sectors are cut off, and the hubs
  lower:part(part):displace{ x = function(_, y) return turn * y end, y = function(x) return -turn * x end, z = 0 }
  upper:part(part):fix()
end
local scene <const>, contacts <const> = dotyk.scene{ lower, upper }, {}
for k = 1, 2 do
  contacts[k] = scene:contact{
    lower:part("flank " .. k, function(x, y, _, _, _, nz) return nz^2 < 0.5 and on_lower(k - 1, x, y) end),
    upper:part("flank " .. k, function(x, y, _, _, _, nz) return nz^2 < 0.5 and on_upper(2 - k, turned(x, y)) end),
    friction = dotyk.friction.coulomb(mu), gap = function(_, _, z) return skew * (face - z) end }
end

-- 4. The lower gear is turned.
local steps <const> = { { load = 0.25 }, { load = 0.5 }, { load = 0.75 }, { load = 1 } }
local s <const> = dotyk.solve(scene, { steps = steps })
print(s)
print "turn     pair   open  stick  slip   greatest pressure   force   off the line of action   arms of the pressures [mm]"
print "[1e-3]                              [MPa]               [N]     [°]                      lower   upper"
local friction_angle <const> = math.deg(math.atan(mu))
for j, step in ipairs(s.steps) do
  for k, contact in ipairs(contacts) do
    local c <const> = step:contact(contact)
    local presses, below, above = 0, 0, 0
    for _, node in ipairs(c.nodes) do
      local nx, ny, p = node.normal[1], node.normal[2], node.pressure * node.weight
      presses, below, above = presses + p, below + p * (node.y * nx - node.x * ny), above + p * ((centres - node.y) * nx + node.x * ny)
    end
    local off <const> = math.deg(math.atan(-c.force[2], -c.force[1]) - alpha)
    print(("%4.1f %8d %6d %6d %5d %19.1f %9.1f %20.2f %16.2f %7.2f"):format(1e3 * turn * steps[j].load, k, c.open, c.stick, c.slip,
      c.max_pressure, math.sqrt(c.force[1]^2 + c.force[2]^2 + c.force[3]^2), off, below / presses, above / presses))
    assert(math.abs(off) < friction_angle + 0.5 and math.abs(below / presses / lower_base - 1) < 0.01 and math.abs(above / presses / upper_base - 1) < 0.01)
  end
end
print(("radii of the base circles %.2f and %.2f mm, angle of friction %.2f°"):format(lower_base, upper_base, friction_angle))

-- 5. Does it balance? What the hubs bear is what the contacts exert.
for i = 1, 3 do
  local contact, lower_hub, upper_hub = s:contact(contacts[1]).force[i] + s:contact(contacts[2]).force[i], 0, 0
  for _, part in ipairs{ "left", "right", "front" } do
    lower_hub, upper_hub = lower_hub + select(i, s:reaction(lower:part(part))), upper_hub + select(i, s:reaction(upper:part(part)))
  end
  print(("along %s: contacts on the lower gear %.6f N, its hub %.6f N, the upper hub %.6f N"):format(("xyz"):sub(i, i), contact, lower_hub, upper_hub))
  assert(math.abs(lower_hub + contact) < 1e-6 and math.abs(upper_hub - contact) < 1e-6)
end
assert(s.converged and #s.warnings == 0)

local x <const>, y <const> = table.unpack(touches[1])
local units = { length = "mm", stress = "MPa" }
dotyk.pictures{ file = "images/gear_pair.png", columns = 2,
                s:picture{ field = "von_mises", units = units, pressure = "none", deform = 1, view = { -0.55, -0.6, 1 }, title = "Two pairs of teeth" },
                s:picture{ field = "von_mises", units = units, pressure = "none", deform = 1, view = { 0, 0, 1 }, window = { x - 4, y - 3, 0, x + 4, y + 3, face }, title = "The first pair, end on" },
                s:picture{ map = contacts[1], units = units, window = { 0, -4, face, 0 }, title = "First flank, unrolled, where it presses" },
                s:picture{ map = contacts[2], units = units, window = { 0, 0, face, 3.1 }, title = "Second flank, likewise" } }
print "images/gear_pair.png"
