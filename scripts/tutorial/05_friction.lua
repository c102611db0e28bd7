-- Tutorial 5: friction: none, given (Tresca), Coulomb's.
--
--   ./dotyk scripts/tutorial/05_friction.lua

local function solve(friction)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 4, 1 }, cells = { 80, 20 }, element = "Q1" } }
  block:part"top":load{ 0, -10 }
  block:part"left":load{ 2, 0 } -- pushed along x, on its whole height 1
  block:part"right":spring{ x = 5 } -- a soft spring along x, per length
  local scene <const> = dotyk.scene{ block }
  local ground <const> = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } }
  local contact <const> = scene:contact{ block:part"bottom", rigid = ground, friction = friction }
  local s <const> = dotyk.solve(scene)
  return s, s:contact(contact)
end

print "friction                 stick  slip  force of friction  moved by"
local shown
for _, law in ipairs{ { "none" }, { "given, at most 0.6", dotyk.friction.tresca(0.6) }, { "Coulomb, 0.04", dotyk.friction.coulomb(0.04) }, { "Coulomb, 0.3", dotyk.friction.coulomb(0.3) } } do
  local s <const>, c <const> = solve(law[2])
  local moved = 0
  for _, n in ipairs(c.nodes) do moved = math.max(moved, math.abs(n.slip[1])) end
  print(("%-24s %5d %5d %17.3f %10.4f"):format(law[1], c.stick, c.slip, c.friction_force[1], moved))
  -- The shear is never more than the law allows, and where it is less nothing slips.
  for _, n in ipairs(c.nodes) do
    local bound <const> = law[1]:find "given" and 0.6 or (tonumber(law[1]:match "Coulomb, (.*)") or 0) * n.pressure
    assert(math.abs(n.shear[1]) <= bound + 1e-8)
    assert(n.status ~= "stick" or math.abs(n.slip[1]) < 1e-9)
  end
  if law[1] == "given, at most 0.6" then shown = s end
end
print("wrote", shown:render{ file = "images/tutorial_05.png", title = "Given friction: some nodes stick, some slip", deform = "auto" })
