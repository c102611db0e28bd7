-- The default method condenses the rows that may close; its answers are those of methods that are named and condense all.
local check <const> = require "check"

local n <const> = 12
local function cube(options)
  local body <const> = dotyk.body{ name = "cube", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = { 0, 0, 0 }, to = { 1, 1, 1 }, cells = { n, n, n } } }
  body:part"bottom":fix()
  if options.load then body:part"left":load(options.load) end
  local scene <const> = dotyk.scene{ body }
  local contact <const> = scene:contact{ body:part"top", rigid = dotyk.rigid.gap{ normal = { 0, 0, 1 }, gap = options.gap }, friction = options.friction }
  return scene, contact, body
end

local function same(s, exact, contact, body)
  check.that(s.converged and exact.converged, s.reason)
  local greatest <const> = exact:contact(contact).max_pressure
  for k, node in ipairs(exact:contact(contact).nodes) do
    local found <const> = s:contact(contact).nodes[k]
    check.equal(found.status, node.status)
    check.near(found.pressure, node.pressure, 1e-8 * greatest)
    check.near(found.gap, node.gap, 1e-11)
    for i = 1, 3 do check.near(found.shear[i], node.shear[i], 1e-8 * greatest) end
  end
  for _, x in ipairs{ 0.1, 0.5, 0.9 } do
    local u <const>, v <const> = { s:displacement(body, x, x, 0.8) }, { exact:displacement(body, x, x, 0.8) }
    for i = 1, 3 do check.near(u[i], v[i], 1e-11) end
  end
end

local function bowl(x, y) return 0.5 * ((x - 0.5)^2 + (y - 0.5)^2) - 0.01 end
for _, friction in ipairs{ false, dotyk.friction.coulomb(0.4), dotyk.friction.tresca(3) } do
  local scene <const>, contact <const>, body <const> = cube{ gap = bowl, friction = friction or nil }
  local s <const>, exact <const> = dotyk.solve(scene), dotyk.solver[friction and "newton" or "pdas"]{}:solve(scene)
  same(s, exact, contact, body)
  check.equal(s.rows, exact.rows)
  if friction == false then check.that(s.factor_bytes < exact.factor_bytes) end
end

-- A load lifts the cube against the second, higher part of the shape, which is open at rest: those rows join.
local function steps(x, y) return x < 0.2 and -0.002 or 0.004 end
local scene <const>, contact <const>, body <const> = cube{ gap = steps, load = { 0, 0, 60 } }
local s <const>, exact <const> = dotyk.solve(scene), dotyk.solver.pdas{}:solve(scene)
local joined = 0
for _, node in ipairs(s:contact(contact).nodes) do
  if node.x > 0.2 and node.status ~= "open" then joined = joined + 1 end
end
check.that(joined > 0, "no row outside the overlap closed")
same(s, exact, contact, body)
