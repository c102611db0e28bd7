-- The two bodies of Vondrák's problem "cont" (ODAM 2001, P7, section 5), for scripts/cont.lua and scripts/papers/cont_table.lua.
--
--   local cont = dofile "two_bodies.lua"{ gap = 0.025, height = 0.75, fix = { upper_left = "xy", lower_bottom = "xy" } }
--
-- Two bodies of 40 × 20 rectangular cells (41 × 21 nodes), 2 long, the upper one `height` high and `gap` above the lower one, which is 1 high;
-- E = 2.1e5 and 1e5, ν = 0.3, plane stress, a load of -1000 per length on the top. `fix`: the components that a side (upper_left,
-- upper_right, lower_left, lower_right, lower_bottom) may not move in. `cells` along a body, 40. Six control points of the upper body's lower
-- edge (a cubic B-spline) move vertically, from touching the other body to 0.25 upwards; the volume must not grow, the compliance is to be
-- least. cont.shape(differences, method): the problem, solved by `method`, conjugate gradients to 1e-6 if absent as in the paper.
-- cont.paper: the columns of table 4.
return function(o)
  local cells <const> = o.cells or 40
  local function body(name, y, height, E)
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3, plane = "stress" },
      mesh = dotyk.mesh.rectangle{ from = { 0, y }, to = { 2, y + height }, cells = { cells, cells // 2 }, element = "Q1" } }
  end
  local cont <const> = { upper = body("upper", o.gap, o.height, 2.1e5), lower = body("lower", -1, 1, 1e5), middle = o.gap + o.height / 2 }
  for side, components in pairs(o.fix) do
    local name <const>, edge <const> = side:match "^(%a+)_(%a+)$"
    for component in components:gmatch "." do cont[name]:part(edge):fix(component) end
  end
  local edge <const> = cont.upper:part "bottom"
  cont.upper:part "top":load{ 0, -1000 }
  cont.scene = dotyk.scene{ cont.upper, cont.lower }
  cont.contact = cont.scene:contact{ edge, cont.lower:part "top" }
  function cont.shape(differences, method)
    return dotyk.shape{ scene = cont.scene, objective = "compliance", constraints = { { quantity = "volume" } }, differences = differences,
      method = method or dotyk.solver.projected_cg{ tol = 1e-6 },
      moves = { { part = edge, control_points = 6, direction = { 0, 1 }, lower = -o.gap, upper = 0.25, extension = "structured" } } }
  end
  cont.paper = { -- designs, first and final compliance, seconds a design, CG steps of the analyses and of the derivatives
    { 36, 25.1552, 8.7547, 1.5, 310, 808 }, { 87, 25.1552, 9.9906, 6.3, 810, 5599 }, { 46, 25.1552, 12.0877, 5.58, 425, 2502 } }
  return cont
end
