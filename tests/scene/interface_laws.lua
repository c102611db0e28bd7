-- Laws on interfaces: closed forms, limits, what each method can treat, and that the ground, a rigid plane and a part are one.
local check <const> = require "check"
local l <const> = dotyk.law

local function box(name, low, high, cells, element, nu)
  local make <const> = #low == 2 and dotyk.mesh.rectangle or dotyk.mesh.box
  return dotyk.body{ name = name, material = dotyk.material{ E = 1000, nu = nu or 0.3 }, mesh = make{ from = low, to = high, cells = cells, element = element } }
end

local function floor(dimension)
  return dotyk.rigid.plane(dimension == 2 and { point = { 0, 0 }, normal = { 0, 1 } } or { point = { 0, 0, 0 }, normal = { 0, 0, 1 } })
end

-- Asperities under a column with nu = 0, pressed by p: they yield by (p/c)^(1/m) everywhere.
local p <const>, c <const>, m <const> = 3, 2e5, 2.5
for _, element in ipairs{ "P1", "Q1", "P2", "Q2" } do
  for dimension = 2, 3 do
    for _, where in ipairs{ "rigid", "ground", "part" } do
      local low <const>, high <const> = dimension == 2 and { 0, 0 } or { 0, 0, 0 }, dimension == 2 and { 1, 1 } or { 1, 1, 1 }
      local cells <const> = dimension == 2 and { 3, 2 } or { 2, 2, 2 }
      local body <const> = box("column", low, high, cells, element, 0)
      local under <const> = body:part"bottom"
      body:part"top":pressure(p)
      for _, side in ipairs(dimension == 2 and { "left" } or { "left", "front" }) do body:part(side):slide() end
      local bodies <const>, law <const> = { body }, l.compliance{ c = c, m = m }
      if where == "part" then
        bodies[2] = box("base", dimension == 2 and { 0, -1 } or { 0, 0, -1 }, dimension == 2 and { 1, 0 } or { 1, 1, 0 }, cells, element, 0)
        bodies[2]:part"bottom":fix()
      end
      local scene <const> = dotyk.scene(bodies)
      local contact <const> = where == "rigid" and scene:contact{ under, rigid = floor(dimension), normal = law } or where == "part" and scene:contact{ under, bodies[2]:part"top", normal = law }
      if where == "ground" then under:support{ normal = law } end
      local s <const> = dotyk.solve(scene)
      check.that(s.converged, s.reason)
      for _, node in ipairs((contact and s:contact(contact) or s:support(under)).nodes) do
        check.near(node.pressure, p, 1e-9 * p, where .. " " .. element)
        check.near(contact and node.gap or node.away, -(p / c) ^ (1 / m), 1e-12)
        check.equal(node.status, "closed")
      end
    end
  end
end

-- Two solids with power-law asperities and Coulomb friction between them, part of them open.
local function pressed(normal, tangential, steps)
  local upper <const>, lower <const> = box("upper", { 0, 0 }, { 1, 0.5 }, { 12, 6 }, "Q1"), box("lower", { -0.5, -1 }, { 1.5, 0 }, { 24, 8 }, "Q1")
  lower:part"bottom":fix()
  upper:part"top":displace{ x = 0.001, y = function(x) return 0.02 * (x - 0.7) end }
  local scene <const> = dotyk.scene{ upper, lower }
  local touching <const> = lower:part("touching", function(x, y, _, ny) return ny > 0.9 and x > 0 and x < 1 end)
  return scene, scene:contact{ upper:part"bottom", touching, normal = normal, tangential = tangential }, lower
end
local function tractions(s, contact)
  local out <const> = {}
  for _, node in ipairs(s:contact(contact).nodes) do out[#out + 1], out[#out + 2], out[#out + 3] = node.pressure, node.shear[1], node.shear[2] end
  return out
end
local scene <const>, contact <const>, lower <const> = pressed(l.compliance{ c = 1e6, m = 2 }, dotyk.friction.coulomb(0.5))
local known <const> = dotyk.solver.newton{ tol = 1e-12 }:solve(scene)
local result <const> = known:contact(contact)
check.that(result.open > 0 and result.stick > 0 and result.slip > 0, ("%d open, %d stick, %d slip"):format(result.open, result.stick, result.slip))
for _, node in ipairs(result.nodes) do
  check.near(node.pressure, 1e6 * math.max(0, -node.gap) ^ 2, 1e-9 * result.max_pressure)
  local shear <const> = math.sqrt(node.shear[1] ^ 2 + node.shear[2] ^ 2)
  check.that(shear <= 0.5 * node.pressure + 1e-9 * result.max_pressure)
  if node.status == "slip" then check.near(shear, 0.5 * node.pressure, 1e-9 * result.max_pressure) end
end
local held <const> = { known:reaction(lower:part"bottom") }
for i = 1, 2 do check.near(held[i], result.force[i], 1e-9 * math.abs(result.force[2]), "action and reaction") end

-- Its force is no piecewise linear function of the penetration: methods that need one say so, the others agree.
local agreed <const>, refused <const> = {}, {}
for _, name in ipairs{ "coulomb_loop", "feti", "newton", "projected_cg", "proximal", "psor", "uzawa", "uzawa_pdas" } do
  local done <const>, s <const> = pcall(function() return dotyk.solver[name]{ tol = 1e-12, max_iterations = 20000 }:solve(scene) end)
  if done then
    check.that(s.converged, name .. ": " .. s.reason)
    check.near(tractions(s, contact), tractions(known, contact), 1e-8 * result.max_pressure, name)
    agreed[#agreed + 1] = name
  else
    check.that(tostring(s):find "compliance law", tostring(s))
    refused[#refused + 1] = name
  end
end
print("agree: " .. table.concat(agreed, ", ") .. "; refuse a law that does not tell its springs: " .. table.concat(refused, ", "))
check.that(#agreed >= 3 and #refused >= 1)
local frictionless <const> = pressed(l.compliance{ c = 1e6, m = 2 })
for _, name in ipairs{ "active_set", "interior_point", "pdas", "penalty", "feti" } do
  check.error(function() dotyk.solver[name]{}:solve(frictionless) end, "compliance law")
end
check.that(dotyk.solve(frictionless).converged)

-- A stiff spring is a stop, and glue: the distance falls as 1/k.
local function off(law, limit)
  local one <const>, first <const> = pressed(law.normal, law.tangential)
  local two <const>, second <const> = pressed(limit.normal, limit.tangential)
  local a <const>, b <const> = dotyk.solver.newton{ tol = 1e-13 }:solve(one), dotyk.solver.newton{ tol = 1e-13 }:solve(two)
  check.that(a.converged and b.converged)
  local sum = 0
  for i = 1, 2 do sum = math.max(sum, math.abs(a:contact(first).force[i] - b:contact(second).force[i])) end
  return sum
end
for _, pair in ipairs{ { function(k) return { normal = l.one_sided_elastic(k) } end, { normal = l.signorini() } },
                       { function(k) return { normal = l.elastic(k), tangential = l.elastic(k) } end, { normal = l.prescribed(0), tangential = l.prescribed(0) } } } do
  check.near(off(pair[1](1e7), pair[2]) / off(pair[1](1e8), pair[2]), 10, 0.3)
end

-- The ground is a rigid plane on which the part lies, in a history too: friction remembers.
for dimension = 2, 3 do
  for _, laws in ipairs{ { l.signorini(), dotyk.friction.coulomb(0.3) }, { l.one_sided_elastic(5e3), dotyk.friction.coulomb(function(x) return 0.2 + 0.2 * x end) },
                         { l.compliance{ c = 1e5, m = 2 }, dotyk.friction.coulomb(0.3) }, { l.elastic(5e3), dotyk.friction.tresca(0.4) }, { l.load(2), dotyk.friction.coulomb(0.3) } } do
    local found <const> = {}
    for k, where in ipairs{ "rigid", "ground" } do
      local body <const> = dimension == 2 and box("block", { 0, 0 }, { 1, 0.5 }, { 8, 4 }, "Q1") or box("block", { 0, 0, 0 }, { 1, 0.5, 0.5 }, { 4, 2, 2 }, "Q1")
      local set <const>, under <const>, top <const> = dotyk.scene{ body }, body:part"bottom", body:part"top"
      local down <const>, zero <const> = function(x) return 0.006 * (x - 1.2) end, 0
      top:displace(dimension == 2 and { y = down } or { y = zero, z = down })
      top:displace{ x = 0.004, case = "push" }
      local given <const> = where == "rigid" and set:contact{ under, rigid = floor(dimension), normal = k == 1 and tostring(laws[1]):find "load" and l.free() or laws[1],
        tangential = tostring(laws[1]):find "load" and dotyk.friction.tresca(0.6) or laws[2] } or under:support{ normal = laws[1], tangential = laws[2] }
      if where == "rigid" and tostring(laws[1]):find "load" then under:pressure(2) end
      local s <const> = dotyk.solver.newton{ tol = 1e-12 }:solve(set, { steps = { { load = { push = 0 } }, { load = { push = 1 } }, { load = { push = -0.5 } } } })
      check.that(s.converged, s.reason)
      local of <const> = where == "rigid" and s:contact(given) or s:support(under)
      found[k] = { of.dissipated }
      for _, node in ipairs(of.nodes) do
        if not tostring(laws[1]):find "load" then found[k][#found[k] + 1] = node.pressure end
        for i = 1, #node.shear do found[k][#found[k] + 1] = node.shear[i] end
      end
    end
    check.that(found[1][1] > 0, "something slips")
    check.near(found[2], found[1], 1e-9, tostring(laws[1]) .. ", " .. dimension .. "-D")
  end
end

-- Where a normal law pulls, Coulomb friction bears nothing: nodes slide, on a rigid plane and on the ground.
for _, where in ipairs{ "rigid", "ground" } do
  local body <const> = box("block", { 0, 0 }, { 1, 0.5 }, { 4, 2 }, "Q1")
  local set <const>, under <const> = dotyk.scene{ body }, body:part"bottom"
  body:part"top":displace{ x = 0.01, y = function(x) return 0.02 * (x - 0.5) end }
  local laws <const> = { under, normal = l.elastic(1e3), tangential = dotyk.friction.coulomb(0.2) }
  local given <const> = where == "rigid" and set:contact{ under, rigid = floor(2), normal = laws.normal, tangential = laws.tangential } or nil
  if where == "ground" then under:support{ normal = laws.normal, tangential = laws.tangential } end
  local s <const> = dotyk.solve(set)
  local pulled = 0
  for _, node in ipairs((given and s:contact(given) or s:support(under)).nodes) do
    if node.pressure < 0 then
      pulled = pulled + 1
      check.near(node.shear[1], 0, 1e-12)
      check.equal(given and node.status or node.tangential, "slip")
    end
  end
  check.that(pulled > 0)
end

-- A law that bears no more than its limit, with Coulomb friction on it: a load beyond is refused.
for _, law in ipairs{ l.one_sided_friction(0.5), l.friction(0.5), l.capped_elastic(1e3, 0.5) } do
  local body <const> = box("block", { 0, 0 }, { 1, 1 }, { 4, 4 }, "Q1")
  body:part"top":load{ 0, -1 }
  body:part"bottom":support{ normal = law, tangential = dotyk.friction.coulomb(0.3) }
  check.equal(dotyk.scene{ body }:balance().verdict, "unsolvable", tostring(law))
end

-- What a law would give where supports hold the nodes is said to be left out.
do
  local body <const> = box("block", { 0, 0 }, { 1, 0.5 }, { 4, 2 }, "Q1")
  body:part"bottom":displace{ x = 0, y = -0.01 }
  body:part"top":fix()
  local set <const> = dotyk.scene{ body }
  set:contact{ body:part"bottom", rigid = floor(2), normal = l.elastic(100) }
  check.that(table.concat(dotyk.solve(set).warnings, "\n"):find "supports hold 5 of its 5 nodes across the contact; what its law %(elastic%) would give there is left out")
end

-- What cannot be is refused where it is said.
local function refuse(text, t)
  local a <const>, b <const> = box("a", { 0, 0 }, { 1, 1 }, { 2, 2 }, "Q1"), box("b", { 0, -1 }, { 1, 0 }, { 2, 2 }, "Q1")
  t[1], t[2] = a:part"bottom", b:part"top"
  check.error(function() dotyk.scene{ a, b }:contact(t) end, text)
end
refuse("cannot have the normal law load", { normal = l.load(1) })
refuse("cannot have the normal law breaking", { normal = l.breaking(1, 1) })
refuse("cannot be tangential", { tangential = l.signorini() })
refuse("a given slip is not known", { tangential = l.prescribed(1) })
refuse("Coulomb's bound is mu times the normal force", { normal = l.free(), friction = dotyk.friction.coulomb(0.1) })
refuse("'friction' is a tangential law; it is given with 'tangential'", { tangential = l.elastic(1), friction = dotyk.friction.coulomb(0.1) })
refuse("are for Signorini's law", { normal = l.elastic(1), multipliers = "P1-P0" })
local alone <const> = box("alone", { 0, 0 }, { 1, 1 }, { 2, 2 }, "Q1")
check.error(function() alone:part"bottom":support{ tangential = dotyk.friction.coulomb(0.1) } end, "has Coulomb friction and no normal law")
check.error(function() alone:part"bottom":support{ normal = l.signorini(), tangential = dotyk.friction.coulomb(function() return -1 end) } end, "mu is -1 at (0, 0); it must be zero or positive")
check.error(function() l.compliance{ c = 1, m = 0.5 } end, "m")
