-- Numbers of laws that are functions of the place, and what scales with the load: the same by each statement.
local check <const> = require "check"
local l <const> = dotyk.law

local function block(cells)
  return dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { cells, cells }, element = "Q1" } }
end
local floor <const> = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }

-- 1. A block on the ground, said as a support by laws or as a contact with a plane, pressed down and drawn aside.
local function solved(laws, contact, load)
  local b <const> = block(8)
  b:part"top":displace{ x = 0.02, y = -0.01 }
  local scene <const> = dotyk.scene{ b }
  local c
  if contact then c = scene:contact{ b:part"bottom", rigid = floor, normal = laws.normal, tangential = laws.tangential }
  else b:part"bottom":support(laws) end
  local s <const> = dotyk.solve(scene, load and { steps = { { load = load } } } or nil)
  assert(s.converged, s.reason)
  return { energy = s.energy, friction = s.friction_energy, x = s:displacement(b, 1, 0), top = s:reaction(b:part"top") }
end
local function near(a, b, what)
  check.near(a.energy, b.energy, 1e-10 * math.abs(b.energy), what .. ": energy")
  check.near(a.friction, b.friction, 1e-10 * math.abs(b.energy), what .. ": friction energy")
  check.near(a.x, b.x, 1e-10 * 0.02, what .. ": displacement")
end
local function k(x) return 100 + 300 * x end
local function g(x) return 1 + 2 * x end
for name, pair in pairs{
  ["springs"] = { { normal = l.elastic(k), tangential = l.elastic(k) },
                  { normal = function(x) return l.elastic(k(x)) end, tangential = function(x) return l.elastic(k(x)) end } },
  ["friction"] = { { normal = l.signorini(), tangential = dotyk.friction.tresca(g) }, { normal = l.signorini(), tangential = l.friction(g) } },
  ["no slip in places"] = { { normal = l.signorini(), tangential = dotyk.friction.tresca(function(x) return x < 0.5 and math.huge or 1 end) },
                            { normal = l.signorini(), tangential = function(x) return l.friction(x < 0.5 and math.huge or 1) end } },
  ["Coulomb"] = { { normal = l.one_sided_elastic(k), tangential = dotyk.friction.coulomb(function(x) return 0.1 + x / 10 end) },
                  { normal = function(x) return l.one_sided_elastic(k(x)) end, tangential = function(x) return dotyk.friction.coulomb(0.1 + x / 10) end } },
  ["compliance"] = { { normal = l.compliance{ c = function(x) return 1e4 * (1 + x) end, m = 2 }, tangential = l.capped_elastic(k, g) },
                     { normal = function(x) return l.compliance{ c = 1e4 * (1 + x), m = 2 } end, tangential = function(x) return l.capped_elastic(k(x), g(x)) end } } } do
  local one <const> = solved(pair[1])
  near(solved(pair[2]), one, name .. ", by a function that gives laws")
  near(solved(pair[1], true), one, name .. ", as a contact with a plane")
  near(solved(pair[2], true), one, name .. ", both")
end
near(solved{ normal = l.elastic(function() return 50 end) }, solved{ normal = l.elastic(50) }, "a constant function")

-- 2. A rigid block (E great) on springs k(x) = 100 + 300x, kept from turning and pressed down by 10: it goes down by 10 over the sum of the springs.
do
  local b <const> = dotyk.body{ name = "rigid", material = dotyk.material{ E = 1e9, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 1, 1 }, cells = { 16, 1 }, element = "Q1" } }
  b:part"top":load{ 0, -10 }
  b:part"left":fix "x"
  b:part"bottom":support{ normal = l.elastic(k) }
  local s <const> = dotyk.solve(dotyk.scene{ b })
  assert(s.converged, s.reason)
  local K = 0 -- Σ w k: nodes carry their shares, by the trapezoidal rule
  for n = 0, 16 do K = K + ((n == 0 or n == 16) and 1 / 32 or 1 / 16) * k(n / 16) end
  local down <const> = 10 / K
  for _, x in ipairs{ 0, 0.25, 1 } do check.near(select(2, s:displacement(b, x, 0)), -down, 1e-5 * down, "a rigid block on springs that vary") end
  for _, node in ipairs(s:support(b:part"bottom").nodes) do check.near(node.pressure, k(node.x) * down, 1e-4 * k(node.x) * down, "its pressure") end
end

-- 3. Half the load: what a law gives, a pressure or a displacement, is halved, and Coulomb's bound with the pressure.
do
  local b <const> = block(4)
  b:part"bottom":support{ normal = l.load(function(x) return 10 end), tangential = dotyk.friction.coulomb(0.3) }
  b:part"top":fix "y"
  b:part"top":displace{ x = 1 }
  local s <const> = dotyk.solve(dotyk.scene{ b }, { steps = { { load = 0.5 } } })
  assert(s.converged, s.reason)
  local force <const> = s:support(b:part"bottom").force
  check.near(force[2], 5, 1e-9, "half of a given pressure")
  check.near(force[1], -1.5, 1e-9, "Coulomb's bound under it")
  for _, contact in ipairs{ false, true } do
    local lifted <const> = block(4)
    lifted:part"left":fix "x"
    local scene <const> = dotyk.scene{ lifted }
    local law <const> = l.prescribed(function(x) return 0.01 end)
    if contact then scene:contact{ lifted:part"bottom", rigid = floor, normal = law } else lifted:part"bottom":support{ normal = law } end
    local half <const> = dotyk.solve(scene, { steps = { { load = 0.5 } } })
    assert(half.converged, half.reason)
    check.near(select(2, half:displacement(lifted, 0.5, 0)), 0.005, 1e-12, "half of a prescribed displacement")
  end
end

-- 4. Beams and plates take the same laws along them, and none that follows a normal force.
do
  local function foundation(law) return dotyk.solve(dotyk.beam{ load = -1, foundation = law, left = { deflection = l.signorini() } }):deflection(0.3) end
  check.near(foundation(l.elastic(k)), foundation(function(x) return l.elastic(k(x)) end), 1e-15, "a beam's foundation")
  check.error(function() dotyk.beam{ left = { deflection = l.elastic(k) } } end, "a number of this law is a function of the place; at a point give a number")
  check.error(function() dotyk.beam{ left = { deflection = dotyk.friction.coulomb(0.1) } } end, "Coulomb friction follows a normal force, and none is here")
  check.error(function() l.elastic(k):render{ file = "never.png" } end, "a number of this law is a function of the place")
  check.equal(tostring(l.capped_elastic(k, 2)), "law: capped elastic a function, at most 2")
end

-- 5. Coulomb friction has no least energy, however it is stated.
do
  local b <const> = block(4)
  b:part"top":load{ 0.5, -4 }
  b:part"bottom":support{ normal = l.signorini(), tangential = dotyk.friction.coulomb(0.5) }
  local shape <const> = dotyk.shape{ scene = dotyk.scene{ b }, objective = "compliance", differences = 1e-6,
    moves = { { body = b, velocity = function(x, y) return 0, y end, lower = -0.5, upper = 0.5 } } }
  check.error(function() shape:optimise{ method = "slp", max_designs = 2 } end, "Coulomb's friction has none")
end
