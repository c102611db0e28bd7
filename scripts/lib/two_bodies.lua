-- The two bodies of Vondrák's problem "cont" (ODAM 2001, P7, section 5), for scripts/papers/vondrak/cont.lua, cont_figures.lua and cont_table.lua.
--
--   local cont = include "two_bodies.lua"{ gap = 0.025, height = 0.75, fix = { upper_left = "xy", lower_bottom = "xy" } }
--
-- Two bodies of 40 × 20 rectangular cells (41 × 21 nodes; `cells`: along a body), 2 long, the lower one 1 high, the upper one `height` (1)
-- and `gap` above it. E = 2.1e5 and 1e5, ν = 0.3, plane stress, a load of -1000 per length on the top. Six control points of the upper
-- body's lower edge (a cubic B-spline) move vertically, from touching the other body to 0.25 upwards; the volume must not grow, the
-- compliance is to be least.
-- `fix`: the components that a side (upper_left, upper_right, lower_left, lower_right, lower_bottom) may not move in; if absent those with
-- which 3298 unknowns are left, see scripts/papers/vondrak/cont_figures.lua. Without `gap`: that with the paper's first compliance.
-- cont.shape(differences, method): the problem, solved by conjugate gradients to 1e-6, as in the paper, if no method is given.
-- cont.paper: the columns of table 4: designs, first and final compliance, seconds a design, CG steps of the analyses and of the derivatives.
local paper <const> = { { 36, 25.1552, 8.7547, 1.5, 310, 808 }, { 87, 25.1552, 9.9906, 6.3, 810, 5599 }, { 46, 25.1552, 12.0877, 5.58, 425, 2502 } }
local rollers <const> = { upper_left = "xy", upper_right = "x", lower_left = "x", lower_right = "x", lower_bottom = "y" }

local function two_bodies(o)
  if not o.gap then -- by bisection: compliance grows with the gap
    local low, high = 1e-4, 0.1
    while high / low > 1 + 1e-9 do
      local gap <const> = math.sqrt(low * high)
      local design <const> = two_bodies{ gap = gap, height = o.height, fix = o.fix, cells = o.cells }.shape(nil, dotyk.solver.pdas{}):design()
      if design.compliance.value < paper[1][2] then low = gap else high = gap end
    end
    return two_bodies{ gap = high, height = o.height, fix = o.fix, cells = o.cells }
  end
  local cells <const>, height <const> = o.cells or 40, o.height or 1
  local function body(name, y, high, E)
    return dotyk.body{ name = name, material = dotyk.material{ E = E, nu = 0.3, plane = "stress" },
      mesh = dotyk.mesh.rectangle{ from = { 0, y }, to = { 2, y + high }, cells = { cells, cells // 2 }, element = "Q1" } }
  end
  local cont <const> = { gap = o.gap, height = height, upper = body("upper", o.gap, height, 2.1e5), lower = body("lower", -1, 1, 1e5), paper = paper }
  for side, components in pairs(o.fix or rollers) do
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
      moves = { { part = edge, control_points = 6, direction = { 0, 1 }, lower = -cont.gap, upper = 0.25, extension = "structured" } } }
  end
  return cont
end

return two_bodies
