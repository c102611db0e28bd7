-- Curved parts of cells of order 1 that end on planes of symmetry: the one facet there does not have the part's normal, which the supports
-- know. Methods converge, and agree; normals lie in the planes.
local methods = { "newton", "coulomb_loop", "proximal", "uzawa_pdas" }
local soft, hard = dotyk.material{ E = 1000, nu = 0.3 }, dotyk.material{ E = 3000, nu = 0.2 }

-- Two boxes n x n x m over [0, 4]^2 in a quarter, one above the other, their common sides bent to heights.
local function quarter(n, m, lower, upper, first, pressed)
  local function block(name, from, to, cells, height, material)
    local mesh = dotyk.mesh.box{ from = { 0, 0, from }, to = { 4, 4, to }, cells = { cells, cells, cells }, element = "P1" }
    mesh:transform(function(x, y, z) return x, y, z + height(x, y) * (1 - math.abs(z) / 4) end)
    local body = dotyk.body{ name = name, mesh = mesh, material = material }
    body:part"left":fix "x"
    body:part"front":fix "y"
    return body
  end
  local low, high = block("low", -4, 0, m, lower, soft), block("high", 0, 4, n, upper, hard)
  low:part"bottom":fix()
  if pressed then high:part"top":displace{ z = -0.1 } else high:part"top":load{ 0, 0, -8 } end
  local scene = dotyk.scene{ low, high }
  local parts = { high:part"bottom", low:part"top", friction = dotyk.friction.coulomb(0.2) }
  if first == "low" then parts[1], parts[2] = parts[2], parts[1] end
  return scene, scene:contact(parts)
end
local function flat() return 0 end
local function bowl(k) return function(x, y) return k * (x^2 + y^2) end end

local cases = {
  { "bent box", flat, bowl(0.02), 4, 4 },
  { "bent box, unlike nodes", flat, bowl(0.02), 5, 4 },
  { "ball in a socket", bowl(0.02), bowl(0.025), 4, 4 },
  { "ball in a socket, unlike nodes", bowl(0.02), bowl(0.025), 5, 4 },
  { "wheel on a rail", function(_, y) return -0.02 * y^2 end, function(x) return 0.02 * x^2 end, 4, 4 },
  { "wheel on a rail, unlike nodes", function(_, y) return -0.02 * y^2 end, function(x) return 0.02 * x^2 end, 5, 4 },
}
for _, case in ipairs(cases) do
  local name, lower, upper, n, m = table.unpack(case)
  for k = 0, 3 do
    local first, pressed = k % 2 == 0 and "high" or "low", k > 1
    local scene, contact = quarter(n, m, lower, upper, first, pressed)
    local known
    for _, method in ipairs(pressed and methods or { "newton", "coulomb_loop", "uzawa_pdas", "psor" }) do
      local s = dotyk.solver[method]{ max_iterations = 2000 }:solve(scene)
      assert(s.converged, name .. ", " .. method .. ": " .. s.reason)
      local c = s:contact(contact)
      for _, node in ipairs(c.nodes) do
        if node.x < 1e-9 then assert(math.abs(node.normal[1]) < 1e-9, name) end
        if node.y < 1e-9 then assert(math.abs(node.normal[2]) < 1e-9, name) end
      end
      local total, shear = 0, 0
      for _, node in ipairs(c.nodes) do
        total = total + node.pressure * node.weight
        shear = shear + math.sqrt(node.shear[1]^2 + node.shear[2]^2) * node.weight
      end
      known = known or { total, shear }
      assert(math.abs(total / known[1] - 1) < 1e-6 and math.abs(shear / known[2] - 1) < 1e-5,
             ("%s, %s first, %s: %g %g against %g %g"):format(name, first, method, total, shear, known[1], known[2]))
    end
  end
end

-- A held edge is no plane of symmetry where nodes beside it in the plane are free: friction acts there along the plane's normal, too.
for _, pairing in ipairs{ "node_to_segment", "mortar" } do
  local function block(name, z, cells, E)
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3 },
                       mesh = dotyk.mesh.box{ from = { 0, 0, z }, to = { 2, 2, z + 1 }, cells = cells } }
  end
  local low, high = block("low", 0, { 3, 2, 2 }, 1000), block("high", 1, { 4, 3, 2 }, 3000)
  low:part"bottom":fix()
  low:part"front":fix "y"
  high:part"left":fix()
  high:part"right":load{ 0, 4, 0 }
  high:part"top":load{ 0, 0, -1 }
  local scene <const> = dotyk.scene{ low, high }
  local contact <const> = scene:contact{ low:part"top", high:part"bottom", pairing = pairing, friction = dotyk.friction.tresca(0.3) }
  local s <const> = dotyk.solve(scene)
  assert(s.converged, s.reason)
  local across = 0
  for _, node in ipairs(s:contact(contact).nodes) do
    local slip <const>, shear <const> = node.slip, node.shear
    local way <const> = math.sqrt(slip[1] ^ 2 + slip[2] ^ 2)
    if way > 1e-7 then
      local off <const> = math.sqrt((shear[1] + 0.3 * slip[1] / way) ^ 2 + (shear[2] + 0.3 * slip[2] / way) ^ 2)
      assert(off < 1e-4, ("%s at (%g, %g): shear (%g, %g) does not oppose slip (%g, %g)"):format(pairing, node.x, node.y, shear[1], shear[2], slip[1], slip[2]))
      if node.y < 1e-9 then across = math.max(across, math.abs(slip[2])) end
    end
  end
  assert(pairing == "mortar" or across > 1e-5, "nodes slip off the front")
end
