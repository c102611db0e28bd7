-- Meshes of ../shared/reference/meshes (GetFEM's gears, Serac's and Tribol's blocks): counts as their README has them,
-- positive cells (loading checks them), and contact problems on them.
local check <const> = require "check"
local folder <const> = require "reference_meshes"
if not folder then return end

local function counts(m) return { m.node_count, m.cell_count, #m.parts, #m.regions, #m:pieces() } end

do
  for name, expected in pairs{
    gear1 = { 2562, 1920, 8, 8, 1 }, gear2 = { 2562, 1920, 8, 8, 1 },
    gear1_2D = { 1302, 1180, 12, 16, 1 }, gear2_2D = { 1157, 1036, 12, 16, 1 },  -- 14 groups of lines, two of them inside
    static_contact_planetary_1 = { 2078, 1734, 80, 160, 1 },
  } do
    check.equal(counts(dotyk.mesh.load(folder .. "getfem_gears/" .. name .. ".msh")), expected, name)
  end

  -- A gear held at its hub and pressed on a flank: the hub bears what presses (mu, lambda as in GetFEM's example).
  local m <const> = dotyk.mesh.load(folder .. "getfem_gears/gear1_2D.msh")
  local mu <const>, lambda <const> = 0.83e5, 1.18e5
  local gear <const> = dotyk.body{ name = "gear", mesh = m,
    material = dotyk.material{ E = mu * (3 * lambda + 2 * mu) / (lambda + mu), nu = lambda / (2 * (lambda + mu)) } }
  local held <const> = {}
  for _, hub in ipairs{ "100133", "100142", "100143", "100183", "100243", "100273", "100282", "100283" } do
    held[#held + 1] = gear:part(hub)
    held[#held]:fix()
  end
  local flank <const> = gear:part "100113"
  flank:load{ 30, -40 }
  local s <const> = dotyk.solve(dotyk.scene{ gear })
  local x, y = 0, 0
  for _, part in ipairs(held) do
    local rx <const>, ry <const> = s:reaction(part)
    x, y = x + rx, y + ry
  end
  check.that(s.converged)
  check.near(y / x, -4 / 3, 1e-9, "the hub's force is against the load's direction")
  check.that(x < 0 and y > 0)
end

-- Two unit cubes, one on the other: a bar of two, in contact; and apart or overlapping by 0.01.
local nu <const>, E <const>, p <const> = 0.25, 100, 1
local function pile(file, interference)
  local low, high = table.unpack(dotyk.mesh.load(folder .. file):pieces())
  local material <const> = dotyk.material{ E = E, nu = nu }
  local a <const> = dotyk.body{ name = "low", mesh = low, material = material }
  local b <const> = dotyk.body{ name = "high", mesh = high, material = material }
  a:part "3":slide()
  for _, body in ipairs{ a, b } do body:part "1":slide() body:part "2":slide() end
  b:part "6":pressure(p)
  local scene <const> = dotyk.scene{ a, b }
  local contact <const> = scene:contact{ b:part "5", a:part "4", pairing = "matching", interference = interference }
  return scene, contact, a, b
end
for _, file in ipairs{ "serac/twohex_for_contact.mesh", "tribol/two_hex.mesh" } do
  check.equal(counts(dotyk.mesh.load(folder .. file)), { 16, 2, 7, 1, 2 }, file)
  local scene <const>, contact <const>, a <const>, b <const> = pile(file)
  local s <const> = dotyk.solve(scene)
  check.that(s.converged, file)
  check.near({ s:displacement(b, 1, 1, 2) }, { nu * p / E, nu * p / E, -2 * p / E }, 1e-13, file)
  check.near(s:contact(contact).force, { 0, 0, 1 }, 1e-12, file)
end
for name, gap in pairs{ two_hex_apart = 0.01, two_hex_overlap = -0.01 } do
  check.equal(counts(dotyk.mesh.load(folder .. "tribol/" .. name .. ".mesh")), { 16, 2, 7, gap > 0 and 2 or 1, 2 }, name)  -- one attribute for both cubes where they overlap
  local scene <const>, contact <const>, _, b <const> = pile("tribol/" .. name .. ".mesh", gap < 0)
  local s <const> = dotyk.solve(scene)
  check.near({ s:displacement(b, 1, 1, 2 + gap) }, { nu * p / E, nu * p / E, -gap - 2 * p / E }, 1e-13, name)
  check.near(s:contact(contact).force, { 0, 0, 1 }, 1e-12, name)
end
check.equal(counts(dotyk.mesh.load(folder .. "serac/twosquare.mesh")), { 6, 2, 2, 1, 1 })
check.equal(counts(dotyk.mesh.load(folder .. "serac/beam-hex-with-contact-block.mesh")), { 44, 9, 7, 2, 2 })
check.equal(counts(dotyk.mesh.load(folder .. "serac/beam-hex-with-contact-block.mesh", { region = "2" })), { 8, 1, 3, 1, 1 })
check.equal(counts(dotyk.mesh.load(folder .. "serac/ironing.mesh")), { 62, 17, 12, 2, 2 })
