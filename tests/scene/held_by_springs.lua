-- What springs alone hold goes where they balance the load, however soft they are beside the body and however small their
-- forces are beside those of contact: a block on smooth ground, pressed onto it, pushed along it against springs of
-- stiffness k an area by F an area. It moves by F/k, or as far as a wall in its way.
local is <const> = require("check").that
local S <const> = dotyk.solver

local far <const>, wall <const> = 1e-3, 0.4e-3 -- F/k, and where the wall stands

local function block(dimension, k, walled)
  local plane <const> = dimension == 2
  local mesh <const> = plane and dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {3, 3} }
    or dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {2, 2, 2} }
  local b <const> = dotyk.body{ material = dotyk.material{ E = 1000, nu = 0 }, mesh = mesh }
  local scene <const> = dotyk.scene{ b }
  local up <const>, along <const> = plane and {0, 1} or {0, 0, 1}, plane and {-1, 0} or {-1, 0, 0}
  scene:contact{ b:part "bottom", rigid = dotyk.rigid.plane{ point = plane and {0, 0} or {0, 0, 0}, normal = up } }
  b:part"top":pressure(1)
  if not plane then b:part"front":slide() end
  b:part"left":pressure(k * far)
  b:part"right":spring{ x = k }
  if walled then scene:contact{ b:part "right", rigid = dotyk.rigid.plane{ point = plane and {1 + wall, 0} or {1 + wall, 0, 0}, normal = along } } end
  return b, scene
end

for dimension = 2, 3 do
  for power = -1, 12 do
    local k <const> = 1000 * 10.0^-power
    for _, walled in ipairs{ false, power < 10 and true or nil } do -- forces of walls are known beside all others
      local b <const>, scene <const> = block(dimension, k, walled)
      local right <const> = walled and wall or far
      for _, method in ipairs{ false, S.newton{}, S.proximal{}, S.active_set{} } do
        local s <const> = method and method:solve(scene) or dotyk.solve(scene)
        local what <const> = ("%s, k = %g%s: %s"):format(s.method, k, walled and ", a wall" or "", s.reason)
        is(s.converged, what)
        local u <const> = dimension == 2 and s:displacement(b, 1, 0.5) or s:displacement(b, 1, 0.5, 0.5)
        is(math.abs(u - right) < (walled and 1e-5 or 1e-6) * right, ("%s: %.10g for %g"):format(what, u, right))
      end
    end
  end
end

-- How soft springs are hides nothing of another body: a block on springs of 1e-14 of its stiffness, and one that stands on the
-- ground as if it were alone. What bears is closed.
local soft <const>, stands <const> = block(2, 1e-11), dotyk.body{ name = "stands", material = dotyk.material{ E = 2000, nu = 0.3 },
  mesh = dotyk.mesh.rectangle{ from = {3, 0}, to = {5, 1}, cells = {4, 2} } }
stands:part"top":pressure(10)
stands:part"right":fix()
local function standing(bodies)
  local scene <const> = dotyk.scene(bodies)
  if #bodies > 1 then scene:contact{ soft:part "bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } } end
  local contact <const> = scene:contact{ stands:part "bottom", rigid = dotyk.rigid.plane{ point = {4, -0.002}, normal = {0, 1} } }
  local s <const> = S.pdas{}:solve(scene)
  is(s.converged, s.reason)
  return s:contact(contact).nodes
end
local alone <const> = standing{ stands }
local closed = 0
for k, node in ipairs(standing{ soft, stands }) do
  is(node.status == alone[k].status and math.abs(node.pressure - alone[k].pressure) < 1e-8 * 10,
    ("node %d: %s with %.10g for %s with %.10g"):format(k, node.status, node.pressure, alone[k].status, alone[k].pressure))
  is((node.status == "closed") == (node.pressure > 0), ("node %d: %s with %g"):format(k, node.status, node.pressure))
  closed = closed + (node.status == "closed" and 1 or 0)
end
is(closed > 0 and closed < #alone, "some nodes touch: " .. closed)
