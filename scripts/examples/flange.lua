-- A bolted flange, pulled off on one side, in space: pressure around the bolts, a joint that opens, stick and slip.
--
--   ./dotyk scripts/examples/flange.lua [CELLS]
--
-- Two rings of unequal thickness on pipes that are welded into their bores, six bolts; one half is modelled, beside the plane of
-- symmetry y = 0. A bolt is its tension: pressure below the washers on both sides, which stays as the joint is loaded. The bolts are
-- tightened, then the upper pipe pulls, most at x > 0, and sideways. Nothing but contact and friction holds the upper flange against
-- that. Both meshes are boxes with the holes left out, transformed. Shows the contact after each step, the balance of forces, and
-- images/flange.png. Units: N, mm.

local n <const> = tonumber(arg[1]) or 16 -- cells along a bolt's share of the ring and across the ring, a multiple of 16
local bolts <const> = 3                  -- of the half
local inner <const>, outer <const>, hole <const>, washer <const> = 30, 60, 5.5, 10 -- radii
local thick <const> = { upper = 10, lower = 14 }
local tension <const> = 20e3             -- of a bolt
local pull <const>, sideways <const> = 12e3, 1.5e3 -- of the upper pipe, on the half
local mu <const> = 0.2

-- 1. A ring: for each bolt a square |u|, |w| <= 1 without its middle, u outwards and w around. Circles about the bolt's axis are
-- the square's rings up to the washer's rim; from there straight to the share's border.
local edge <const>, rim <const> = 3 / 8, 5 / 8 -- of the square: the hole's and the washer's
local share <const> = math.pi / bolts
local function bolt_axis(k) return (inner + outer) / 2, (k + 0.5) * share end
local function polar(r, angle) return r * math.cos(angle), r * math.sin(angle) end
local function ring(from, to, layers)
  local function within(v) -- which bolt, and w
    local k = math.min(math.floor((v + 1) / 2), bolts - 1)
    return k, v - 2 * k
  end
  return dotyk.mesh.box{ from = {-1, -1, from}, to = {1, 2 * bolts - 1, to}, cells = {n, n * bolts, layers}, element = "Q1" }
    :keep(function(u, v) return math.max(math.abs(u), math.abs(select(2, within(v)))) > edge end, "holes")
    :transform(function(u, v, z)
      local k, w = within(v)
      local p = math.max(math.abs(u), math.abs(w))
      local r, angle = bolt_axis(k)
      local x, y = polar(r, angle)
      local out = p < rim and hole + (washer - hole) * (p - edge) / (rim - edge) or washer
      local dx, dy = polar(out, angle + math.atan(w, u))
      x, y = x + dx, y + dy
      local bx, by = polar(r + (outer - inner) / 2 * u / p, angle + share / 2 * w / p)
      local t = math.max(0, (p - rim) / (1 - rim))
      return x + t * (bx - x), y + t * (by - y), z
    end)
end

-- 2. The bodies, the loads by name, and what touches.
local steel <const> = dotyk.material{ E = 210e3, nu = 0.3 }
local upper <const> = dotyk.body{ name = "upper", mesh = ring(0, thick.upper, 3), material = steel }
local lower <const> = dotyk.body{ name = "lower", mesh = ring(-thick.lower, 0, 4), material = steel }
local function below_washers(body, height)
  return body:part("washers", function(x, y, z)
    if math.abs(z - height) > 1e-6 then return false end
    for k = 0, bolts - 1 do
      local cx, cy = polar(bolt_axis(k))
      if math.sqrt((x - cx)^2 + (y - cy)^2) < washer then return true end
    end
  end)
end
local function area(radius, part) -- of a circle of chords, the square's ring
  local m <const>, sum = math.tointeger(n / 2 * part), 0
  for i = -m, m - 1 do sum = sum + 2 * radius^2 * math.sin(math.atan(i + 1, m) - math.atan(i, m)) end
  return sum
end
local pressure <const> = tension / (area(washer, rim) - area(hole, edge))
below_washers(upper, thick.upper):pressure(pressure, "bolts")
below_washers(lower, -thick.lower):pressure(pressure, "bolts")
for _, body in ipairs{ upper, lower } do
  body:part "front":slide()
  body:part "back":slide()
end
lower:part "left":fix() -- the bore
local bore <const> = bolts * n * 2 * inner * math.sin(share / n / 2) * thick.upper -- its area, of chords
upper:part "left":load(function(x, y) return sideways / bore, 0, pull / bore * (1 + x / inner) end, "pull")
local scene <const> = dotyk.scene{ upper, lower }
local contact <const> = scene:contact{ upper:part "bottom", lower:part "top", friction = dotyk.friction.coulomb(mu) }

-- 3. The history of loads.
local steps <const> = { { load = { bolts = 1, pull = 0 } } }
for k = 1, 3 do steps[#steps + 1] = { load = { pull = k / 3 } } end
local s <const> = dotyk.solve(scene, { steps = steps })
print(s)
print "pull    open  stick  slip   greatest pressure [MPa]"
for k, step in ipairs(s.steps) do
  local c <const> = step:contact(contact)
  print(("%4.2f %7d %6d %5d %25.1f"):format(steps[k].load.pull, c.open, c.stick, c.slip, c.max_pressure))
end

-- 4. Does it balance? Contact bears what is left of the bolts' tension; the lower pipe bears the pull.
local c <const> = s:contact(contact)
local fx, _, fz = s:reaction(lower:part "left")
print(("contact on the upper flange: %.4f N along x, %.4f N along z; the lower pipe bears %.4f N, %.4f N"):format(c.force[1], c.force[3], fx, fz))
local function near(a, b) return math.abs(a - b) < 1e-8 * tension end
assert(s.converged and #s.warnings == 0)
assert(near(c.force[3], bolts * tension - pull) and near(c.force[1], -sideways), "loads and contact balance on the upper flange")
assert(near(fx, -sideways) and near(fz, -pull), "the lower pipe bears the loads")

local units = { length = "mm", stress = "MPa" }
dotyk.pictures{ file = "images/flange.png", columns = 2,
                s:picture{ field = "pressure", units = units, explode = 2, view = { 0.6, -1.2, 1.2 }, title = "Rings drawn apart" },
                s:picture{ field = "von_mises", units = units, view = { 0.6, -1.2, 1.2 }, pressure = "none", title = "Stress" },
                s:picture{ map = contact, units = units, title = "Pressure in the joint" },
                s:picture{ map = contact, field = "gap", units = units, title = "Gap" } }
print "images/flange.png"
