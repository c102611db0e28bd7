-- Rough surfaces: asperities that are pressed flat make a contact yield, p = c (-gap)^m (dotyk.law.compliance), and the wider and lower its pressure is. As c
-- grows it tends to that of smooth surfaces, Signorini's. images/asperities.png.
local common <const> = include "../lib/common.lua"

local steel <const> = dotyk.material{ E = 210e3, nu = 0.3 }
local punch <const> = dotyk.rigid.gap{ normal = { 0, 1 }, gap = function(x) return x^2 / 4 - 0.02 end }
local m <const> = 2

local function pressed(normal)
  local block <const> = dotyk.body{ name = "block", material = steel, mesh = dotyk.mesh.rectangle{ from = { -1, -1 }, to = { 1, 0 }, cells = { 128, 64 } } }
  block:part"bottom":fix()
  local scene <const> = dotyk.scene{ block }
  local contact <const> = scene:contact{ block:part"top", rigid = punch, normal = normal, tangential = dotyk.friction.coulomb(0.2) }
  local s <const> = dotyk.solve(scene)
  assert(s.converged, s.reason)
  return s:contact(contact)
end

local function drawn(name, result, options)
  local curve <const> = common.curve(name, options)
  for _, node in ipairs(result.nodes) do
    if math.abs(node.x) < 0.6 then curve:add(node.x, node.pressure / 1e3) end
  end
  return curve
end

print "c [N/mm^4]   peak [GPa]   force [kN/mm]   half width [mm]"
local series <const>, last = {}, 0
local raised <const> = { [1e7] = "⁷", [1e8] = "⁸", [1e9] = "⁹", [1e11] = "¹¹" }
for _, c in ipairs{ 1e7, 1e8, 1e9, 1e11, math.huge } do
  local smooth <const> = c == math.huge
  local result <const> = pressed(smooth and dotyk.law.signorini() or dotyk.law.compliance{ c = c, m = m })
  local half, off = 0, 0
  for _, node in ipairs(result.nodes) do
    if node.status ~= "open" then half = math.max(half, math.abs(node.x)) end
    if not smooth then off = math.max(off, math.abs(node.pressure - c * math.max(0, -node.gap)^m)) end
  end
  print(("%10.0e   %10.3f   %13.3f   %15.3f"):format(c, result.max_pressure / 1e3, -result.force[2] / 1e3, half))
  assert(off < 1e-9 * result.max_pressure and -result.force[2] > last) -- on the law; a stiffer contact bears more
  last = -result.force[2]
  series[#series + 1] = drawn(smooth and "smooth (Signorini)" or ("c = 10%s"):format(raised[c]), result, { style = "line", reference = smooth })
end
dotyk.chart{ file = "images/asperities.png", title = "Rough block, stiffness c in N/mm⁴", x = "x [mm]", y = "pressure [GPa]",
             x_range = { -0.35, 0.35 }, y_range = { -0.4, 12 }, series = series }
print "images/asperities.png"
