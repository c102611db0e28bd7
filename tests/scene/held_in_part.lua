-- Two parts clamped at the same end press on each other. A clamped node faces a facet that is clamped in part: the condition there is about
-- what the facet's free node does, along the normal and, with friction, along the tangent.
local soft, hard = dotyk.material{ E = 10, nu = 0.3 }, dotyk.material{ E = 10000, nu = 0.2 }

local function length(v) return math.sqrt(v[1]^2 + v[2]^2 + (v[3] or 0)^2) end

local function check(scene, contact, mu)
  for _, method in ipairs(mu > 0 and { "newton", "coulomb_loop" } or { "pdas", "proximal" }) do
    local s = dotyk.solver[method]{ max_iterations = 2000 }:solve(scene)
    assert(s.converged, method .. ": " .. s.reason)
    local c, greatest = s:contact(contact), 0
    for _, node in ipairs(c.nodes) do greatest = math.max(greatest, node.pressure) end
    local slips = 0
    for k, node in ipairs(c.nodes) do
      local at = ("%s, node %d"):format(method, k)
      assert(node.gap > -1e-8 and node.pressure > -1e-8 * greatest and math.min(node.gap, node.pressure / greatest) < 1e-8, ("%s: gap %g, pressure %g of %g"):format(at, node.gap, node.pressure, greatest))
      if mu > 0 then
        local slip, shear = length(node.slip), length(node.shear)
        assert(shear < mu * node.pressure + 1e-7 * greatest, at)
        if slip > 1e-5 then
          assert(math.abs(shear - mu * node.pressure) < 1e-4 * greatest, ("%s: slip %g, shear %g of %g"):format(at, slip, shear, mu * node.pressure))
          if node.pressure > 0.01 * greatest then slips = slips + 1 end
        end
      end
    end
    assert(mu == 0 or slips > 0, "no friction to be seen")
  end
end

for _, mu in ipairs{ 0, 0.1 } do
  for _, cells in ipairs{ { 5, 3 }, { 3, 5 }, { 4, 1 } } do
    local low = dotyk.body{ name = "low", mesh = dotyk.mesh.rectangle{ from = { 0, -1 }, to = { 2, 0 }, cells = { cells[1], 2 }, element = "Q1" }, material = hard }
    local high = dotyk.body{ name = "high", mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 2, 1 }, cells = { cells[2], 2 }, element = "Q1" }, material = soft }
    low:part"left":fix()
    high:part"left":fix()
    low:part"bottom":fix()
    high:part"top":load{ 1, -2 }
    local scene = dotyk.scene{ low, high }
    local parts = { low:part"top", high:part"bottom" }
    if mu > 0 then parts.friction = dotyk.friction.coulomb(mu) end
    check(scene, scene:contact(parts), mu)
  end
end

-- All of a part held across its contact: the support bears what presses, and a warning says that Coulomb friction has nothing to do.
local b = dotyk.body{ name = "b", material = soft, mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {3,3} } }
b:part"bottom":slide()
b:part"left":spring{ x = 1 }
b:part"top":load{ 0.1, -1 }
local scene = dotyk.scene{ b }
scene:contact{ b:part"bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = dotyk.friction.coulomb(0.3) }
assert(table.concat(dotyk.solve(scene).warnings):find("they bear what presses, not the contact, and there is no friction", 1, true))
