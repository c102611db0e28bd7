-- Bodies held only by contact: a stack of five free blocks, and a ball in a socket.
--
--   ./dotyk scripts/examples/stack.lua
--
-- No springs are added. Shows the equilibrium of every body, residuals, and images/stack.png.

local clay <const> = dotyk.material{ E = 2000, nu = 0.25 }
local worst = 0

-- What is missing to the equilibrium of a body, relative to the weight of all: loads, contacts and
-- (along the axes where symmetry holds it) supports.
local function report(name, missing, weight)
  worst = math.max(worst, math.abs(missing) / weight)
  print(("  %-16s missing %.1e of the weight"):format(name, math.abs(missing) / weight))
end

-- 1. Five blocks on the ground; nothing but contact holds them upright. Sideways no load acts and no
-- contact holds: the solution is unique up to that.
local blocks, contacts = {}, {}
local count <const>, weight <const> = 5, 4
for k = 1, count do
  blocks[k] = dotyk.body{ name = "block " .. k, material = clay, force = { 0, -weight },
    mesh = dotyk.mesh.rectangle{ from = {-1, 0.5 * (k - 1)}, to = {1, 0.5 * k}, cells = {40, 10}, element = "Q1" } }
end
local scene = dotyk.scene(blocks)
contacts[1] = scene:contact{ blocks[1]:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
for k = 2, count do contacts[k] = scene:contact{ blocks[k]:part"bottom", blocks[k - 1]:part"top" } end
blocks[count]:part("load", function(x, _, _, ny) return ny > 0.9 and math.abs(x - 0.3) < 0.3 end):pressure(10)
print(scene:plan())
local s = dotyk.solve(scene)
print(s)
local own <const>, top <const> = weight * 2 * 0.5, 10 * 0.6
local function moment(contact) -- about the middle axis x = 0
  local sum = 0
  for _, node in ipairs(s:contact(contact).nodes) do sum = sum + node.x * node.pressure * node.weight end
  return sum
end
for k = 1, count do
  local below, above = s:contact(contacts[k]).force, k < count and s:contact(contacts[k + 1]).force or { 0, top }
  local turned = moment(contacts[k]) - (k < count and moment(contacts[k + 1]) or 0.3 * top)
  report("block " .. k .. ", x", below[1] - above[1], own * count + top)
  report("block " .. k .. ", y", below[2] - above[2] - own, own * count + top)
  report("block " .. k .. ", moment", turned, own * count + top)
end
s:render{ file = "images/stack.png", field = "yy", units = { length = "m", stress = "kPa", load = "kPa" }, loads = true, pressure = "none" }

-- 2. A ball in a rigid bowl.
local function make_ball()
  return dotyk.body{ name = "ball", material = clay, force = { 0, 0, -weight },
  mesh = dotyk.mesh.box{ from = {-1, -1, -1}, to = {1, 1, 1}, cells = {8, 8, 8}, element = "Q1" }
    :transform(function(x, y, z) -- the cube onto the ball
      return x * math.sqrt(1 - y^2 / 2 - z^2 / 2 + y^2 * z^2 / 3),
             y * math.sqrt(1 - z^2 / 2 - x^2 / 2 + z^2 * x^2 / 3),
             z * math.sqrt(1 - x^2 / 2 - y^2 / 2 + x^2 * y^2 / 3)
    end) }
end
local ball = make_ball()
local bowl = dotyk.scene{ ball }
local lower = ball:part("lower", function(_, _, z, _, _, nz) return nz < -0.3 end)
-- The bowl z = 0.35 (x² + y²) - 1, as a gap below the ball's surface.
local socket = bowl:contact{ lower, rigid = dotyk.rigid.gap{ normal = {0, 0, -1},
  gap = function(x, y, z) return math.max(0, z - (0.35 * (x^2 + y^2) - 1)) end } }
print(bowl:plan())
local b = dotyk.solve(bowl)
print(b)
local held = make_ball() -- its weight, from what holds it when it is fixed
local top_part = held:part("top", function(_, _, z) return z > 0.5 end)
top_part:fix()
local _, _, whole = dotyk.solve(dotyk.scene{ held }):reaction(top_part)
local carried, about_x, about_y = b:contact(socket).force, 0, 0
for _, node in ipairs(b:contact(socket).nodes) do
  about_x, about_y = about_x + node.y * node.pressure * node.weight, about_y + node.x * node.pressure * node.weight
end
for _, one in ipairs{ { "x", carried[1] }, { "y", carried[2] }, { "z", carried[3] - whole }, { "about x", about_x }, { "about y", about_y } } do
  report("ball, " .. one[1], one[2], whole)
end
print(("  the bowl carries a volume of %.6f (a ball: %.6f, its polyhedron less)"):format(
  b:contact(socket).force[3] / weight, 4 * math.pi / 3))
print(("greatest residual of equilibrium: blocks %.1e, ball %.1e"):format(s.residual.equilibrium, b.residual.equilibrium))
print "images/stack.png"
if worst > 1e-10 then error "a body is not in equilibrium" end
