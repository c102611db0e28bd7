-- Nothing that is not finite is called a solution: given friction so small that products with it leave the range of numbers.
local function all_finite(value, where)
  if type(value) == "number" then assert(value == value and math.abs(value) < math.huge, where .. " is " .. value) end
  if type(value) == "table" then for k, v in pairs(value) do all_finite(v, where .. "." .. tostring(k)) end end
end
local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
  mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {2, 2, 2} } }
block:part"left":fix "x"
block:part"front":fix "y"
block:part"top":load{ 0.1, 0.2, -1 }
for _, g in ipairs{ 5e-324, 1e-310, 1e-200 } do
  for _, multipliers in ipairs{ "nodal", "P1-P0" } do
    local scene = dotyk.scene{ block }
    local contact = scene:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0, 0}, normal = {0, 0, 1} },
      friction = dotyk.friction.tresca(g), multipliers = multipliers }
    for _, method in ipairs{ "newton", "proximal", "psor", "uzawa", "uzawa_pdas", "projected_cg", "feti" } do
      local s = dotyk.solver[method]{}:solve(scene)
      local c = s:contact(contact)
      assert(s.converged, s.reason)
      for _, node in ipairs(c.nodes) do
        for _, key in ipairs{ "pressure", "force", "gap", "shear", "slip" } do all_finite(node[key], method .. " " .. key) end
      end
      all_finite({ s.energy, s.friction_energy, c.force, c.friction_force, s.residual.law, s.residual.friction }, method)
    end
  end
end

-- Programs: solved only with a residual that can be measured.
for _, c in ipairs{ {1, 1}, {0, 1}, {1e-10, 1}, {5e-324, 1}, {1e300, 1} } do
  for _, low in ipairs{ 0, -1e308 } do
    for _, method in ipairs{ "active_set", "interior_point" } do
      local r = dotyk.qp{ B = {{5e-324, 0}, {0, 2}}, c = c, x_low = low, method = method }
      if r.converged then
        all_finite(r.residual, method)
        all_finite({ r.objective, r.x, r.y }, method)
      end
    end
  end
end
