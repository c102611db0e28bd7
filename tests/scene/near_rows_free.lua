-- Bodies that contact alone holds: the default method condenses the rows on which they settle as if rigid, on soft springs, and those that join; its answers
-- are those of methods that are named and condense all.
local check <const> = require "check"

local n <const> = 12
local function bowl(x, y) return 0.5 * ((x - 0.5)^2 + (y - 0.5)^2) - 0.01 end

-- A cube under a rigid shape, pressed against it by loads.
local function cube(options)
  local body <const> = dotyk.body{ name = "cube", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { n, n, n } } }
  if options.guided then
    body:part"left":fix "x"
    body:part"front":fix "y"
  end
  for part, load in pairs(options.loads) do body:part(part):load(load) end
  local scene <const> = dotyk.scene{ body }
  local contacts <const> = { scene:contact{ body:part"top", rigid = dotyk.rigid.gap{ normal = { 0, 0, 1 }, gap = options.gap or bowl }, friction = options.friction } }
  if options.wall then contacts[2] = scene:contact{ body:part"right", rigid = dotyk.rigid.gap{ normal = { 1, 0, 0 }, gap = options.wall } } end
  return scene, contacts, body
end

local function same(s, exact, contacts, body)
  check.that(s.converged and exact.converged, s.reason)
  check.equal(s.rows, exact.rows)
  check.near(s.energy, exact.energy, 1e-9 * math.abs(exact.energy))
  for _, contact in ipairs(contacts) do
    local greatest <const> = exact:contact(contact).max_pressure
    for k, node in ipairs(exact:contact(contact).nodes) do
      local found <const> = s:contact(contact).nodes[k]
      check.equal(found.status, node.status)
      check.near(found.pressure, node.pressure, 1e-8 * greatest)
      check.near(found.gap, node.gap, 1e-10)
    end
  end
  for _, x in ipairs{ 0.1, 0.5, 0.9 } do check.near({ s:displacement(body, x, x, 0.8) }, { exact:displacement(body, x, x, 0.8) }, 1e-10) end
end

local function compared(name, options, fewer)
  local scene <const>, contacts <const>, body <const> = cube(options)
  local s <const>, exact <const> = dotyk.solve(scene), dotyk.solver[options.friction and "newton" or "pdas"]{}:solve(scene)
  same(s, exact, contacts, body)
  if fewer then check.that(s.factor_bytes < exact.factor_bytes, name) end
  return s, contacts
end

compared("pressed into a bowl", { guided = true, loads = { bottom = { 0, 0, 4 } } }, true)
compared("with friction", { guided = true, loads = { bottom = { 0, 0, 4 } }, friction = dotyk.friction.coulomb(0.3) }, true)
compared("not guided", { loads = { bottom = { 0, 0, 4 } } }, true)
compared("off the middle", { loads = { bottom = function(x, y) return 0, 0, 8 * x end } })
compared("against a wall, too", { loads = { bottom = { 0, 0, 4 }, left = { 1, 0, 0 } }, wall = function(y, z) return 0.01 + 0.1 * (z - 0.5)^2 end })
compared("flat", { guided = true, loads = { bottom = { 0, 0, 4 } }, gap = function() return 0.01 end })

-- Bent by its sides the cube comes to a second, farther part of the shape: those rows join.
local s <const>, contacts <const> = compared("bent", { guided = true, loads = { bottom = { 0, 0, 0.1 }, right = function(_, _, z) return 60 * (1 - 2 * z), 0, 0 end },
  gap = function(x) return x < 0.3 and 0.1 * x^2 or 0.01 end })
local joined = 0
for _, node in ipairs(s:contact(contacts[1]).nodes) do
  if node.x > 0.3 and node.status ~= "open" then joined = joined + 1 end
end
check.that(joined > 0, "no row on the farther part closed")

-- A bar on a ridge of three nodes: the part that touches is a three-hundredth of what turns about it. Condensed on this part alone equilibrium was off by 2e-6 of the load.
do
  local body <const> = dotyk.body{ name = "bar", material = dotyk.material{ E = 2000, nu = 0.25 },
    mesh = dotyk.mesh.rectangle{ from = { -1, 0 }, to = { 1, 0.1 }, cells = { 800, 50 } } }
  body:part("ends", function(x, _, _, ny) return ny > 0.9 and math.abs(x) > 0.5 end):load{ 0, -0.01 }
  local scene <const> = dotyk.scene{ body }
  scene:contact{ body:part"bottom", rigid = dotyk.rigid.gap{ normal = { 0, -1 }, gap = function(x) return math.abs(x) < 0.003 and 0 or 0.01 end } }
  local s <const> = dotyk.solve(scene)
  check.that(s.converged and s.residual.equilibrium < 1e-7, s.residual.equilibrium)
end
