-- Two gears' teeth in contact: meshes of an engineer's making, whose nodes do not match, on curved flanks.
--
--   ./dotyk scripts/examples/gears.lua
--
-- Reads gear1_2D.msh and gear2_2D.msh (two teeth each, quadrilaterals), gear1.msh and gear2.msh (helical, a tooth each,
-- hexahedra; all from the GetFEM project) in ../shared/reference/meshes/getfem_gears, and does nothing where that folder is
-- not. The hub of the lower gear is turned, the upper one's held; two pairs of flanks may touch. There is no result to compare
-- with, but the torque of the contact's forces about the lower axis must be what turns the hub, the energy's derivative dE/dθ
-- (by a central difference). Node to segment stands beside mortar: little apart in the plane, up to a fifth on the helical
-- gears' coarse flanks. Units: N, mm. images/gears.png.

local folder <const> = (arg[0]:match "^(.*)/[^/]*$" or ".") .. "/../../../shared/reference/meshes/getfem_gears/"
local there <const> = io.open(folder .. "gear1_2D.msh")
if not there then
  print("no gears at " .. folder)
  return
end
there:close()

-- 1. Steel by its Lamé constants; the gears' axes; hubs, and what else of the sectors is cut off from the wheel.
local lambda <const>, mu <const> = 1.18e5, 0.83e5
local steel <const> = dotyk.material{ E = mu * (3 * lambda + 2 * mu) / (lambda + mu), nu = lambda / (2 * (lambda + mu)) }
local lower <const>, upper <const> = dotyk.mesh.load(folder .. "gear1_2D.msh"), dotyk.mesh.load(folder .. "gear2_2D.msh")
local axis <const> = 445 -- height of the upper gear's above the lower one's, which is the origin
local held <const> = { "133", "142", "143", "183", "243", "273", "282", "283" }

-- The lower hub turned clockwise by an angle, linearised: two contacts, one for each pair of flanks.
local function turned(angle, pairing)
  local one <const> = dotyk.body{ name = "gear 1", mesh = lower, material = steel }
  local two <const> = dotyk.body{ name = "gear 2", mesh = upper, material = steel }
  for _, name in ipairs(held) do
    one:part("100" .. name):displace{ x = function(_, y) return angle * y end, y = function(x) return -angle * x end }
    two:part("200" .. name):fix()
  end
  local scene <const> = dotyk.scene{ one, two }
  local contacts <const> = { scene:contact{ one:part "100113", two:part "200213", pairing = pairing },
                             scene:contact{ one:part "100213", two:part "200113", pairing = pairing } }
  return dotyk.solve(scene), contacts
end

-- 2. Torque about an axis on the first gear, of pressures along the nodes' normals.
local function torque(s, contacts, height)
  local sum = 0
  for _, contact in ipairs(contacts) do
    for _, node in ipairs(s:contact(contact).nodes) do
      local nx, ny = node.normal[1], node.normal[2]
      sum = sum - node.pressure * node.weight * (node.x * ny - (node.y - height) * nx)
    end
  end
  return sum
end

print "angle    force on the pairs [N/mm]   peak pressure   torque about the lower axis [N]                upper / lower"
print "[1e-3]   right       left            [MPa]           mortar       dE/dtheta    node to segment"
local last
for _, angle in ipairs{ 0.25e-3, 0.5e-3, 1e-3, 2e-3 } do
  local s <const>, contacts <const> = turned(angle)
  local step <const> = 1e-4 * angle
  local work <const> = (turned(angle + step).energy - turned(angle - step).energy) / (2 * step)
  local feet <const>, feet_contacts <const> = turned(angle, "node_to_segment")
  local T <const>, other <const> = torque(s, contacts, 0), torque(s, contacts, axis)
  local force, peak = {}, 0
  for k, contact in ipairs(contacts) do
    local c <const> = s:contact(contact)
    force[k], peak = math.sqrt(c.force[1]^2 + c.force[2]^2), math.max(peak, c.max_pressure)
  end
  print(("%5g %9.0f %10.0f %14.0f %18.5g %14.5g %14.5g %17.4f"):format(
    1e3 * angle, force[1], force[2], peak, T, work, torque(feet, feet_contacts, 0), -other / T))
  assert(s.converged and math.abs(T / work - 1) < 1e-5, "the torque of contact is what turns the hub")
  last = s
end

-- 3. Helical gears. As they lie in the files teeth overlap by 0.05 mm: the lower one is turned back before it is loaded.
local back <const> = 5e-4
local helical <const> = dotyk.mesh.load(folder .. "gear1.msh"):transform(function(x, y, z)
  return math.cos(back) * x - math.sin(back) * y, math.sin(back) * x + math.cos(back) * y, z
end)
local opposite <const> = dotyk.mesh.load(folder .. "gear2.msh")
local function turned_helical(angle, pairing)
  local one <const> = dotyk.body{ name = "gear 1", mesh = helical, material = steel }
  local two <const> = dotyk.body{ name = "gear 2", mesh = opposite, material = steel }
  for _, name in ipairs{ "133", "142", "143", "173", "182", "183" } do
    one:part(name):displace{ x = function(_, y) return angle * y end, y = function(x) return -angle * x end, z = 0 }
    two:part(name):fix()
  end
  local scene <const> = dotyk.scene{ one, two }
  local contact <const> = scene:contact{ one:part "113", two:part "113", pairing = pairing }
  return dotyk.solve(scene), { contact }
end

print "\nhelical gears\nangle    force [N]: radial      across       along   peak pressure   torque [N mm]: mortar   dE/dtheta   node to segment"
for _, angle in ipairs{ 1e-3, 2e-3 } do
  local s <const>, contacts <const> = turned_helical(angle)
  local step <const> = 1e-4 * angle
  local work <const> = (turned_helical(angle + step).energy - turned_helical(angle - step).energy) / (2 * step)
  local feet <const>, feet_contacts <const> = turned_helical(angle, "node_to_segment")
  local T <const>, c <const> = torque(s, contacts, 0), s:contact(contacts[1])
  print(("%5g %21.4g %11.4g %11.4g %15.0f %23.5g %11.5g %17.5g"):format(
    1e3 * angle, c.force[2], c.force[1], c.force[3], c.max_pressure, T, work, torque(feet, feet_contacts, 0)))
  assert(s.converged and math.abs(T / work - 1) < 1e-5, "the torque of contact is what turns the hub")
end

-- 4. The figure.
last:render{ file = "images/gears.png", field = "von_mises", units = { length = "mm", stress = "MPa" }, deform = 4, window = { -30, 125, 60, 195 }, range = { 0, 700 }, pressure = "arrows" }
print "images/gears.png"
