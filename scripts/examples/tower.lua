-- A tower on the ground, pushed sideways at its top: at which load does it tip, at which does it slide?
--
--   ./dotyk scripts/examples/tower.lua
--
-- The tower (width 1, height 4, weight 4) is held by contact and friction alone. It tips when the push's
-- moment about its foot exceeds the weight's, H · 4 = 4 · ½, that is at H = ½; it slides when H exceeds
-- mu times the weight. The limit found by bisection on scene:balance() is compared with that; then the
-- state just below: contact opens from one side. Draws images/tower.png.

local weight <const>, width <const>, height <const> = 4, 1, 4
local material <const> = dotyk.material{ E = 2000, nu = 0.2 }

local function tower(push, mu, cells)
  local body = dotyk.body{ name = "tower", material = material, force = { 0, -weight / (width * height) },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {width, height}, cells = {cells, 4 * cells}, element = "Q1" } }
  -- A shear on the top: its lever arm about the foot is the height.
  body:part"top":load{ push / width, 0 }
  local scene = dotyk.scene{ body }
  return scene, scene:contact{ body:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} },
                               friction = dotyk.friction.coulomb(mu) }
end

-- 1. The limits.
local worst = 0
for _, mu in ipairs{ 0.05, 0.1, 0.2, 0.5, 1 } do
  local low, high = 0, 10
  while high - low > 1e-9 do
    local middle = (low + high) / 2
    if tower(middle, mu, 4):balance().solvable then low = middle else high = middle end
  end
  local tips, slides = weight * width / 2 / height, mu * weight
  local exact = math.min(tips, slides)
  worst = math.max(worst, math.abs(low / exact - 1))
  print(("mu = %4.2f: %s at H = %.7f, closed form %.7f"):format(mu, slides < tips and "slides" or "tips  ", low, exact))
end
print(("greatest relative difference %.1e"):format(worst))

-- 2. On the way there the foot lifts off; the least the ground needs to carry the weight is its edge.
for _, part in ipairs{ 0.2, 0.5, 0.8, 0.95, 0.99 } do
  local scene, contact = tower(0.5 * part, 1, 40)
  local s = dotyk.solve(scene)
  local c = s:contact(contact)
  print(("push %3.0f %% of the limit: %2d of %d nodes open, force %.9f %.9f, %s in %d iterations"):format(
    100 * part, c.open, #c.nodes, c.force[1], c.force[2], s.converged and "converged" or s.reason, s.iterations))
end
local scene = tower(0.4, 1, 20)
dotyk.solve(scene):render{ file = "images/tower.png", field = "yy", units = { length = "m", stress = "kPa", load = "kPa" }, loads = true, zoom = { -0.15, -0.4, 1.25, 0.6 } }
print "images/tower.png"
if worst > 1e-6 then error "the limit load is wrong" end
