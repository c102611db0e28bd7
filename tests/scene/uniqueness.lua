-- What is said of uniqueness before and after the solve: no more than is proved, and what is left free with its range.
local check <const> = require "check"

local S <const> = dotyk.solver
local function has(text, part) check.that(text:find(part, 1, true), part .. " not in: " .. text) end
local function near(a, b, off) check.that(math.abs(a - b) <= off, ("%.17g is not %.17g"):format(a, b)) end

-- 1. A disc in a V without friction: its rotation is free until the next node closes; every method gives the least.
local function disc(cells, angle, friction)
  local d = dotyk.body{ name = "disc", mesh = dotyk.mesh.disc{ center = {0,0}, radius = 1, cells = cells },
    material = dotyk.material{ E = 1000, nu = 0.3 }, force = { math.cos(math.rad(angle)), math.sin(math.rad(angle)) } }
  local scene, walls, q = dotyk.scene{ d }, {}, math.sqrt(0.5)
  for _, side in ipairs{ -1, 1 } do
    walls[#walls + 1] = scene:contact{ d:part("side" .. side, function(x, y) return x * side > 0 and y < 0.2 end), friction = friction,
      rigid = dotyk.rigid.plane{ point = { 0, -math.sqrt(2) }, normal = { -side * q, q } } }
  end
  return scene, walls, d
end
do
  local scene, walls, d = disc(8, -90)
  has(scene:plan(), "a solution exists with unique stress; whether its displacement is unique is unknown before solving")
  check.that(not scene:plan():find("a unique solution", 1, true))
  check.that(scene:balance().verdict == "unknown" and scene:balance().solvable)
  local first
  for _, method in ipairs{ S.pdas{}, S.pdas{ reduced = false }, S.active_set{}, S.interior_point{}, S.feti{}, S.projected_cg{}, S.newton{} } do
    local s = method:solve(scene)
    check.that(s.converged, s.reason)
    has(s.reason, "displacement up to 'disc': rotation about (0, 0), by displacements from -0.0479")
    local x = s:displacement(d, 0, 0.5)
    local _, y = s:displacement(d, 0.5, 0)
    first = first or { x, y }
    near(x, first[1], 1e-9)
    near(y, first[2], 1e-9)
    for _, wall in ipairs(walls) do
      local c = s:contact(wall)
      check.that(c.closed == 1, c.closed) -- and not one without pressure, open by 0.006
      for _, node in ipairs(c.nodes) do check.that((node.status == "closed") == (node.pressure > 1e-6)) end
    end
  end
  check.that(math.abs(first[1]) < 1e-9) -- no rotation
end
has(dotyk.solve((disc(16, -90))).reason, "'disc': rotation about (0, 0) is resisted only by terms of the order of the mesh")

-- 2. With friction and a load that rolls it: small displacements do not hold.
do
  local scene = disc(16, -40, dotyk.friction.coulomb(0.2))
  has(scene:plan(), "unknown before solving")
  check.that(not scene:plan():find "unique solution exists")
  local s = S.proximal{}:solve(scene)
  check.that(s.converged, s.reason)
  has(s.warnings[1], "'disc' turns by 0.08")
  has(tostring(s), "the equations are those of small strains and rotations")
end

-- 3. A free block on a plane with given friction: both halves slip outwards, and it may be anywhere in a range.
do
  local b = dotyk.body{ name = "block", mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {5,5}, element = "Q1" },
    material = dotyk.material{ E = 1000, nu = 0.3 } }
  b:part"top":load{ 0, -1 }
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = dotyk.friction.tresca(0.001) }
  has(scene:plan(), "unknown before solving")
  local at
  for seed = 1, 4 do
    local s = S.newton{ seed = seed }:solve(scene)
    has(s.reason, "displacement up to 'block': translation along x, by displacements from -3.86918e-05 to 3.86918e-05")
    at = at or s:displacement(b, 1, 0)
    near(s:displacement(b, 1, 0), at, 1e-11)
  end
  -- Guided along y its only motion is a translation: pressed harder than friction resists it is unique, TR965 (3.31).
  b:part"left":fix "x"
  local guided = dotyk.scene{ b }
  guided:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = dotyk.friction.tresca(0.001) }
  has(guided:plan(), "a unique solution exists: the load presses every free body against what holds it")
  check.that(guided:balance().verdict == "unique" and guided:uniqueness().unique)
  check.that(not dotyk.solve(guided).reason:find("free", 1, true))
end

-- 4. A shaft held by given friction alone: one motion, |S| ≤ j.
do
  local b = dotyk.body{ name = "shaft", mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} }, material = dotyk.material{ E = 1000, nu = 0.3 } }
  b:part"bottom":fix "y"
  b:part"top":load{ 0.5, 0 }
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"right", rigid = dotyk.rigid.plane{ point = {10,0}, normal = {-1,0} } }
  b:part"bottom":support{ tangential = dotyk.law.friction(0.8) }
  has(scene:plan(), "a solution exists with unique stress, displacement up to 'shaft': translation along x")
end

-- 5. Coulomb friction on a body that is held: a solution exists, and is unique for coefficients below a factor times these.
do
  local function lid(mu)
    local d = dotyk.body{ name = "lid", mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }, material = dotyk.material{ E = 1000, nu = 0.3 } }
    d:part"top":displace{ x = 0.01, y = -0.01 }
    local scene = dotyk.scene{ d }
    scene:contact{ d:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = dotyk.friction.coulomb(mu) }
    return scene
  end
  has(lid(0.1):plan(), "a solution exists; whether it is unique is unknown before solving")
  local one, three = lid(0.1):uniqueness(), lid(0.3):uniqueness()
  near(one.factor, 3 * three.factor, 1e-12)
  check.that(one.exists and one.unique == (one.factor > 1))
  check.that(#dotyk.all_solutions(lid(0.1 * one.factor)) == 1)
end
-- The bound is never above the coefficient from which on a strut has several solutions (scripts/studies/stability/coulomb.lua).
for _, angle in ipairs{ 45, 60, 75 } do
  local function strut(mu)
    local mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 6}, cells = {1, 6} }
    mesh:transform(function(x, y) return x + y / math.tan(math.rad(angle)), y end)
    local body = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 }, force = { -0.3, -0.3 } }
    body:part"top":fix()
    local scene = dotyk.scene{ body }
    scene:contact{ body:part"bottom", rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = 0 }, friction = dotyk.friction.coulomb(mu) }
    return scene
  end
  local factor = strut(1):uniqueness().factor
  for _, part in ipairs{ 0.5, 0.99 } do
    local all, tried = dotyk.all_solutions(strut(part * factor))
    check.that(#all == 1, tried)
  end
end

-- 6. Wedged between two walls: rigid bodies would be in balance, elastic ones may find no pressure great enough. No promise.
for _, weight in ipairs{ 1, 100 } do
  local w = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4}, element = "Q1" },
    material = dotyk.material{ E = 1000, nu = 0.3 }, force = { 0, -weight } }
  local scene = dotyk.scene{ w }
  for part, normal in pairs{ left = {-1,0}, right = {1,0} } do
    scene:contact{ w:part(part), friction = dotyk.friction.coulomb(0.5), rigid = dotyk.rigid.gap{ normal = normal, gap = -0.005 } }
  end
  has(scene:plan(), "whether there is a solution, and only one, is unknown before solving")
  local u = scene:uniqueness()
  check.that(not u.exists and not u.unique and u.factor == nil)
end

-- 7. Held without friction: unique, and said so.
do
  local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} }, material = dotyk.material{ E = 1, nu = 0.3 } }
  b:part"bottom":fix()
  local scene = dotyk.scene{ b }
  has(scene:plan(), "a unique solution exists: every body is held by its supports")
  check.that(scene:balance().verdict == "unique")
  b:part"top":support{ normal = dotyk.law.elastic(1) } -- rows, and nothing to move
  has(scene:plan(), "a unique solution exists: every body is held by its supports")
end

-- 8. The range of a free motion is that of the family which enumeration finds.
do
  local b = dotyk.body{ name = "block", mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {3,1}, element = "Q1" },
    material = dotyk.material{ E = 1000, nu = 0.3 } }
  b:part"top":load{ 0, -1 }
  local scene = dotyk.scene{ b }
  scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = dotyk.friction.tresca(0.001) }
  local all, tried, families = dotyk.all_solutions(scene)
  check.that(#families == 1 and families[1].dimension == 1 and not families[1].unbounded and not families[1].forces_only, tried)
  local range = math.abs(all[families[1].ends[1]]:displacement(b, 0.5, 0) - all[families[1].ends[2]]:displacement(b, 0.5, 0))
  local s = dotyk.solve(scene)
  local low, high = s.reason:match "by displacements from (%-[%d.e-]+) to ([%d.e-]+) at the most"
  near(high - low, range, 1e-5 * range) -- two ways to the same range
end

-- 9. A ball in space on a plane, and beside a second one: the polygon leaves two (four) motions free, and their least amounts are one state.
do
  local mesh <const> = dotyk.mesh.box{ from = {-1,-1,-1}, to = {1,1,1}, cells = {4,4,4}, element = "Q1" }
  mesh:transform(function(x, y, z)
    return x * math.sqrt(1 - y*y/2 - z*z/2 + y*y*z*z/3), y * math.sqrt(1 - z*z/2 - x*x/2 + z*z*x*x/3), z * math.sqrt(1 - x*x/2 - y*y/2 + x*x*y*y/3)
  end)
  local ball <const> = dotyk.body{ name = "ball", mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 }, force = {0, 0, -1} }
  for planes, motions in ipairs{ 2, 4 } do
    local scene <const> = dotyk.scene{ ball }
    scene:contact{ ball:part("low", function(_, _, z) return z < -0.2 end), rigid = dotyk.rigid.plane{ point = {0, 0, -1}, normal = {0, 0, 1} } }
    if planes == 2 then scene:contact{ ball:part("side", function(x) return x > 0.2 end), rigid = dotyk.rigid.plane{ point = {1, 0, 0}, normal = {-1, 0, 0} } } end
    local least
    for _, name in ipairs{ "pdas", "active_set", "interior_point", "feti", "proximal", "psor", "newton" } do
      local s <const> = dotyk.solver[name]{}:solve(scene)
      check.that(s.converged, name .. ": " .. s.reason)
      check.that(s.reason:find("displacement up to " .. motions .. " motions, one of them 'ball'", 1, true), name .. ": " .. s.reason)
      check.that(s.reason:find("this is the least", 1, true), name .. ": " .. s.reason)
      local u <const> = { s:displacement(ball, 0.3, 0.1, 0) }
      least = least or u
      check.near(u, least, 1e-6 * math.abs(least[3]), name) -- what the methods' tolerances leave
    end
  end
end

-- 10. With Coulomb friction no theory says that the stress is unique: a disc on a plane may roll, under the stress of this solution.
for _, friction in ipairs{ dotyk.friction.coulomb(0.5), false } do
  local b <const> = dotyk.body{ name = "disc", mesh = dotyk.mesh.disc{ center = {0,1}, radius = 1, cells = 4 },
    material = dotyk.material{ E = 1000, nu = 0.3 }, force = {0, -0.01} }
  local scene <const> = dotyk.scene{ b }
  local low <const> = b:part("low", function(_, y) return y < 0.8 end)
  scene:contact{ low, rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = friction or nil }
  local s <const> = dotyk.solve(scene)
  check.that(s.converged, s.reason)
  local stress <const> = friction and "with the stress of this solution" or "unique stress"
  check.that(s.reason:find(stress .. ", displacement up to", 1, true), s.reason)
  check.that(not friction or not s.reason:find("unique", 1, true), s.reason)
end
