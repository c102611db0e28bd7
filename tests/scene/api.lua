-- Every field and method of the interface that exists, on problems whose solutions are known: a bar of
-- E = 8, nu = 0, 2 long, 1 wide, pulled or pressed along y.
local check <const> = require "check"

local steel <const> = dotyk.material{ E = 8, nu = 0, density = 3 }
check.equal({ steel.E, steel.nu, steel.density }, { 8.0, 0.0, 3.0 })

local elements <const> = { "P1", "Q1" }
local function bar(element, options)
  options = options or {}
  options.name = options.name or "bar"
  options.mesh = options.mesh or dotyk.mesh.rectangle{ from = {0,0}, to = {1,2}, cells = {3,4}, element = element }
  options.material = options.material or steel
  return dotyk.body(options)
end

for _, element in ipairs(elements) do
  -- The mesh and the body.
  local m = dotyk.mesh.rectangle{ from = {0,0}, to = {1,2}, cells = {3,4}, element = element }
  check.equal({ m.dimension, m.node_count, m.cell_count, m.element }, { 2, 20, element == "P1" and 24 or 12, element })
  check.equal(m.parts, { "bottom", "left", "right", "top" })
  local b = bar(element, { mesh = m })
  check.equal({ b.name, b.dimension, b.node_count, b.cell_count }, { "bar", 2, 20, m.cell_count })
  check.equal(b.parts, m.parts)
  local top = b:part "top"
  check.equal({ top.name, top.facet_count }, { "top", 3 })
  check.that(top.body.name == "bar")

  -- Tension: u_y = y/4 · …: stress 2 gives strain 1/4.
  b:part "bottom":slide()
  b:part "left":slide()
  top:load{ 0, 2 }
  local scene = dotyk.scene{ b }
  check.equal({ #scene.bodies, #scene.contacts, scene.dimension }, { 1, 0, 2 })
  local s = dotyk.solve(scene)
  check.equal({ s.converged, s.method, s.iterations, s.rows }, { true, "linear", 0, 0 })
  check.equal(s.unknowns, 2 * 20 - 4 - 5)
  check.near(s.energy, -0.5)  -- half the load's work 2 · 0.5
  check.equal(s.friction_energy, 0.0)
  check.near({ s:displacement(b, 0.3, 1.1) }, { 0, 0.275 })
  local t = s:stress(b, 0.3, 1.1)
  check.near({ t.xx, t.yy, t.xy, t.zz, t.von_mises }, { 0, 2, 0, 0, 2 })
  check.near(t.principal, { 2, 0, 0 })
  check.near({ s:reaction(b:part "bottom") }, { 0, -2 })
  check.near({ s:reaction(b:part "left") }, { 0, 0 })
  check.near(s:error_estimate(), 0, 1e-7)
  check.near({ s.residual.equilibrium, s.residual.penetration, s.residual.complementarity, s.residual.friction }, { 0, 0, 0, 0 })
  local sum = 0
  for _, phase in ipairs{ "assembly", "motions", "ordering", "factor", "iterate", "recover" } do
    check.that(s.time[phase] >= 0)
    sum = sum + s.time[phase]
  end
  check.that(s.time.total > 0 and sum <= s.time.total * 1.01 + 1e-4)
  check.equal(#s.history, 0)
  check.that(s.factor_bytes > 0 and #s.ordering > 0 and #s.reason > 0)
  check.that(tostring(s):find("converged", 1, true) and tostring(scene):find("1 body", 1, true))

  -- Prescribed: the same state, its energy now that of the strain.
  b = bar(element)
  b:part "bottom":fix "y"
  b:part "left":fix("x")
  b:part "top":displace{ y = 0.5 }
  s = dotyk.solve(dotyk.scene{ b })
  check.near(s.energy, 0.5)
  check.near({ s:reaction(b:part "top") }, { 0, 2 })

  -- Springs below: they shorten by force / stiffness.
  b = bar(element)
  b:part "bottom":spring{ x = 1, y = 4 }
  b:part "top":pressure(2)
  s = dotyk.solve(dotyk.scene{ b })
  check.near({ s:displacement(b, 1, 0) }, { 0, -0.5 })
  check.near({ s:displacement(b, 1, 2) }, { 0, -1 })
  check.near({ s:reaction(b:part "bottom") }, { 0, 2 })
  check.near(s.energy, -1)

  -- Weight: sigma = -rho g (2 - y).
  b = bar(element, { force = { 0, -3 } })
  b:part "bottom":fix "y"
  b:part "left":fix "x"
  s = dotyk.solve(dotyk.scene{ b })
  check.near({ s:reaction(b:part "bottom") }, { 0, -3 * -2 })
  check.near(select(2, s:displacement(b, 0, 2)), -3 * 2^2 / 2 / 8, element == "Q1" and 1e-12 or 0.02)
end

-- Numbers or functions: the same result everywhere.
do
  local function constant(...)
    local values = table.pack(...)
    return function() return table.unpack(values) end
  end
  local function solve(as)
    local material = dotyk.material{ E = as(8), nu = as(0.25) }
    local b = bar("P1", { material = material, force = as ~= constant and { 0.5, -1 } or constant(0.5, -1) })
    b:part "bottom":displace{ x = as(0.01), y = as(-0.02) }
    b:part "left":spring{ x = as(2), y = as(3) }
    b:part "top":load(as ~= constant and { 0.2, -0.7 } or constant(0.2, -0.7))
    b:part "right":pressure(as(0.3))
    local scene = dotyk.scene{ b }
    local c = scene:contact{ b:part "top", gap = as(0.01), rigid = dotyk.rigid.gap{ normal = {0,1}, gap = as(-0.6) } }
    local s = dotyk.solve(scene)
    return s, s:contact(c), b
  end
  local s1, c1, b1 = solve(function(v) return v end)
  local s2, c2, b2 = solve(constant)
  check.near(s1.energy, s2.energy)
  check.near(c1.force, c2.force)
  check.that(c1.closed > 0)
  check.near({ s1:displacement(b1, 0.5, 1.5) }, { s2:displacement(b2, 0.5, 1.5) })
  -- Functions that vary: a linear load has its moment, a quadratic one its integral.
  local b = bar "Q1"
  b:part "bottom":fix()
  b:part "top":load(function(x, y) return 0, -6 * x^2 * y / 2 end)
  b:part "right":load(function(x, y) return y, 0 end)
  check.near({ dotyk.solve(dotyk.scene{ b }):reaction(b:part "bottom") }, { -2, 2 })
end

-- Plane strain and plane stress, isotropic and general.
do
  local E <const>, nu <const> = 8, 0.25
  local function pulled(material)
    local b = bar("Q1", { material = material })
    b:part "bottom":slide()
    b:part "left":slide()
    b:part "top":load{ 0, 2 }
    local s = dotyk.solve(dotyk.scene{ b })
    return select(2, s:displacement(b, 1, 2)) / 2, s:displacement(b, 1, 2), s:stress(b, 0.5, 1).zz
  end
  local yy, xx, zz = pulled(dotyk.material{ E = E, nu = nu, plane = "stress" })
  check.near({ yy, xx, zz }, { 2 / E, -nu * 2 / E, 0 })
  yy, xx, zz = pulled(dotyk.material{ E = E, nu = nu })
  check.near({ yy, xx, zz }, { (1 - nu^2) * 2 / E, -nu * (1 + nu) * 2 / E, nu * 2 })
  local f <const> = E / (1 - nu^2)
  yy, xx = pulled(dotyk.material{ stiffness = { { f, nu * f, 0 }, { nu * f, f, 0 }, { 0, 0, f * (1 - nu) / 2 } } })
  check.near({ yy, xx }, { 2 / E, -nu * 2 / E })
end

-- Contact of two bars, and with each kind of rigid obstacle.
for _, element in ipairs(elements) do
  for _, reduced in ipairs{ true, false } do
    local lower, upper = bar(element, { name = "lower" }), bar(element, { name = "upper", mesh = dotyk.mesh.rectangle{
      from = {0,2}, to = {1,4}, cells = {3,4}, element = element } })
    lower:part "bottom":slide()
    lower:part "left":slide()
    upper:part "left":slide()
    upper:part "top":load{ 0, -2 }
    local scene = dotyk.scene{ lower, upper }
    local c = scene:contact{ upper:part "bottom", lower:part "top", gap = 0.125, pairing = "matching" }
    check.equal({ c.rows, #scene.contacts }, { 4, 1 })
    check.that(c.name:find("contact of 'upper' bottom with 'lower' top", 1, true))
    local s = dotyk.solver.pdas{ reduced = reduced, tol = 1e-10, rho = 1, max_iterations = 50, ordering = "minimum_degree" }:solve(scene)
    local r = s:contact(c)
    check.that(s.converged)
    check.equal({ s.rows, r.open, r.closed, r.stick, r.slip, #r.nodes }, { 4, 0, 4, 0, 0, 4 })
    check.near(r.force, { 0, 2 })
    check.near({ r.area, r.max_pressure }, { 1, 2 })
    for _, n in ipairs(r.nodes) do
      check.near({ n.y, n.gap, n.pressure }, { 2, 0, 2 })
      check.near(n.force, n.weight * n.pressure)
      check.near(n.normal, { 0, -1 })
      check.near(n.shear, { 0, 0 })
      check.near(n.slip, { 0, 0 })
      check.equal(n.status, "closed")
    end
    check.near(select(2, s:displacement(upper, 0.5, 4)), -0.5 - 0.125 - 0.5)
    check.near({ s:reaction(lower:part "bottom") }, { 0, 2 })
    check.that(tostring(scene:plan()):find("pdas", 1, true))
    check.equal(#s.history, s.iterations)

    local obstacles = {
      dotyk.rigid.gap{ normal = {0,-1}, gap = 0.125 },
      dotyk.rigid.plane{ point = {7,-0.125}, normal = {0,3} },
      dotyk.rigid.ball{ center = {0.5,-1e9 - 0.125}, radius = 1e9 },
    }
    for _, rigid in ipairs(obstacles) do
      local b = bar(element)
      b:part "left":slide()
      b:part "top":load{ 0, -2 }
      local floor = dotyk.scene{ b }
      local d = floor:contact{ b:part "bottom", rigid = rigid }
      s = dotyk.solver.pdas{ reduced = reduced }:solve(floor)
      check.near(s:contact(d).force, { 0, 2 }, 1e-6)
      check.near(select(2, s:displacement(b, 0.5, 2)), -0.625, 1e-6)
    end

    -- Apart: nothing touches, the gap is what it was.
    local b = bar(element)
    b:part "top":fix()
    local free = dotyk.scene{ b }
    local d = free:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,-0.5}, normal = {0,1} } }
    r = dotyk.solver.pdas{ reduced = reduced }:solve(free):contact(d)
    check.equal({ r.open, r.closed, r.area, r.max_pressure }, { 4, 0, 0.0, 0.0 })
    check.near({ r.nodes[1].gap, r.nodes[4].gap }, { 0.5, 0.5 })
    check.equal(r.nodes[2].status, "open")

    -- Glued, the two bars are one: they also pull.
    scene = dotyk.scene{ lower, upper }
    scene:glue{ upper:part "bottom", lower:part "top" }
    upper:part "top":load{ 0, 4 }
    s = dotyk.solver.pdas{ reduced = reduced }:solve(scene)
    check.near(select(2, s:displacement(upper, 0.5, 4)), 1)
    check.near({ s:reaction(lower:part "bottom") }, { 0, -2 })
  end
end

-- In space: a box on a floor.
for _, element in ipairs(elements) do
  local m = dotyk.mesh.box{ from = {0,0,0}, to = {1,2,3}, cells = {2,2,3}, element = element }
  check.equal({ m.dimension, m.node_count, m.cell_count }, { 3, 36, element == "P1" and 72 or 12 })
  check.equal(m.parts, { "back", "bottom", "front", "left", "right", "top" })
  local b = dotyk.body{ mesh = m, material = steel }
  b:part "left":slide()
  b:part "front":slide()
  b:part "top":load{ 0, 0, -4 }
  local scene = dotyk.scene{ b }
  local c = scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0,0}, normal = {0,0,1} } }
  local s = dotyk.solve(scene)
  local r = s:contact(c)
  check.near(r.force, { 0, 0, 8 })
  check.near({ r.area, r.max_pressure, r.nodes[1].z }, { 2, 4, 0 })
  check.near({ s:displacement(b, 0.5, 1, 3) }, { 0, 0, -1.5 })
  local t = s:stress(b, 0.5, 1, 1.5)
  check.near({ t.xx, t.yy, t.zz, t.yz, t.xz, t.xy, t.von_mises }, { 0, 0, -4, 0, 0, 0, 4 })
  local patch = b:part("patch", function(x, y, z, nx, ny, nz) return nz > 0.9 and x < 0.5 end)
  check.equal(patch.facet_count, element == "P1" and 4 or 2)
end

-- The disc, moved and graded meshes.
for _, element in ipairs(elements) do
  local d = dotyk.mesh.disc{ center = {1,2}, radius = 3, cells = 8, element = element }
  check.equal({ d.dimension, d.parts }, { 2, { "boundary" } })
  local b = dotyk.body{ mesh = d, material = steel, force = { 0, -1 } }
  b:part "boundary":fix()
  local _, weight = dotyk.solve(dotyk.scene{ b }):reaction(b:part "boundary")
  check.near(weight, math.pi * 9, 0.3)
end
do
  local m = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4}, grading = { x = function(s) return s^2 end } }
  check.that(m:transform(function(x, y) return 2 * x, y + 1 end).node_count == 25)
  local b = dotyk.body{ mesh = m, material = steel }
  local narrow = b:part("narrow", function(x, y, nx, ny) return ny > 0.5 and x < 0.125 end)
  check.equal(narrow.facet_count, 1)  -- 2 · (1/4)² wide
  narrow:load{ 0, -8 }
  b:part "bottom":fix()
  check.near({ dotyk.solve(dotyk.scene{ b }):reaction(b:part "bottom") }, { 0, 1 })
end
