-- A law that prescribes a displacement holds what a slide holds, or displace: contact next to it has the same conditions, and the same
-- solution to rounding.
local prescribed <const> = dotyk.law.prescribed

-- A quarter of two blocks, the upper one's lower side bulging; `hold(part, axis)` is what a plane of symmetry does.
local function quarter(n, m, hold)
  local function block(name, from, to, cells, k, E)
    local mesh = dotyk.mesh.box{ from = { 0, 0, from }, to = { 4, 4, to }, cells = { cells, cells, cells } }
    mesh:transform(function(x, y, z) return x, y, z + k * (x^2 + y^2) * (1 - math.abs(z) / 4) end)
    local body = dotyk.body{ name = name, mesh = mesh, material = dotyk.material{ E = E, nu = 0.3 } }
    hold(body:part"left", "x")
    hold(body:part"front", "y")
    return body
  end
  local low, high = block("low", -4, 0, m, 0, 1000), block("high", 0, 4, n, 0.02, 3000)
  low:part"bottom":fix()
  high:part"top":load{ 0, 0, -8 }
  local scene = dotyk.scene{ low, high }
  return scene, scene:contact{ high:part"bottom", low:part"top", friction = dotyk.friction.coulomb(0.2) }, high:part"left"
end
local function slide(part) part:slide() end
local function law(part) part:support{ normal = prescribed(0) } end

local function same(a, b, scale, what) assert(math.abs(a - b) < 1e-7 * scale, ("%s: %.12g, not %.12g"):format(what, a, b)) end

for _, m in ipairs{ 4, 3 } do
  local scene, contact, left = quarter(4, m, slide)
  local s = dotyk.solve(scene)
  local by_laws, same_contact, same_left = quarter(4, m, law)
  local t = dotyk.solve(by_laws)
  assert(s.converged and t.converged, t.reason)
  assert(t.iterations <= s.iterations + 2, "as many steps: " .. t.reason)
  local known, found = s:contact(contact), t:contact(same_contact)
  for k, node in ipairs(known.nodes) do
    local other = found.nodes[k]
    same(other.pressure, node.pressure, 30, "pressure")
    same(other.shear[1], node.shear[1], 30, "shear")
    same(other.shear[2], node.shear[2], 30, "shear")
    assert(other.status == node.status, node.status .. " became " .. other.status)
  end
  -- What the plane takes is told as a support's.
  same(select(1, t:reaction(same_left)), select(1, s:reaction(left)), 100, "reaction")
end

-- A displacement that is not 0: the side of a block that a rigid plane meets is drawn along it, or away from it.
local function drawn(how, value)
  local block = dotyk.body{ name = "block", mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 8, 4 } },
                            material = dotyk.material{ E = 1000, nu = 0.3 } }
  block:part"top":load{ 0, -5 }
  if how == "law" then
    block:part"left":support{ normal = prescribed(value) }
    block:part"right":support{ normal = prescribed(0) }
  else
    block:part"left":displace{ x = value }
    block:part"right":fix "x"
  end
  local scene = dotyk.scene{ block }
  local contact = scene:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } },
                                 friction = dotyk.friction.coulomb(0.3) }
  local s = dotyk.solve(scene)
  assert(s.converged, s.reason)
  return s:contact(contact)
end
local known, found = drawn("displace", 0.01), drawn("law", 0.01)
for k, node in ipairs(known.nodes) do
  same(found.nodes[k].pressure, node.pressure, 10, "pressure")
  same(found.nodes[k].shear[1], node.shear[1], 10, "shear")
  assert(found.nodes[k].status == node.status, ("at %g: %s became %s"):format(node.x, node.status, found.nodes[k].status))
end

-- Held away from what it would meet, or inside it: the first is no contact, the second is refused.
local function held_at(value)
  local block = dotyk.body{ name = "block", mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { 4, 2 } },
                            material = dotyk.material{ E = 1000, nu = 0.3 } }
  block:part"top":fix()
  block:part"bottom":support{ normal = prescribed(value) }
  local scene = dotyk.scene{ block }
  local contact = scene:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = { 0, -0.01 }, normal = { 0, 1 } } }
  return dotyk.solve(scene):contact(contact)
end
assert(held_at(0).force[2] == 0)
local ok, why = pcall(held_at, -0.02)
assert(not ok and tostring(why):find("is fixed in the normal direction and lies 0.01 inside the other side", 1, true), tostring(why))
