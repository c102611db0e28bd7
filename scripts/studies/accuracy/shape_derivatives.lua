-- Derivatives of contact solutions by design variables against differences of designs solved again (P7).
--
--   ./dotyk scripts/studies/accuracy/shape_derivatives.lua [CELLS]
--
-- A cantilever bent onto an elastic block, its lower edge moved by a B-spline, and in space a block pressed and turned on a rigid
-- ball; without friction, with given and with Coulomb friction. Derivatives are exact, so differences with steps h leave a V:
-- their own error falls like h², past the steps that change which nodes touch, until rounding, 1e-16/h and more, takes over.
-- Then a kink: Newton's method sets a design variable so that one node touches without force. To each side the solution has a
-- derivative of its own, by the quadratic program of P7 (15)-(17); differences to that side alone agree. Last, what is refused:
-- friction at the edge of slip, the energy of Coulomb's.
-- CELLS: along the cantilever, 40. Draws images/shape_derivatives.png and images/shape_kink.png.

local cells <const> = tonumber(arg[1]) or 40
local tresca <const>, coulomb <const> = dotyk.friction.tresca, dotyk.friction.coulomb

-- 1. Scenes, the first design alpha and the direction beta in which designs go.
local function cantilever(friction)
  local gap <const> = 0.04
  local function body(name, from, to, E)
    return dotyk.body{ name = name, mesh = dotyk.mesh.rectangle{ from = from, to = to, cells = { cells, cells // 2 } },
                       material = dotyk.material{ E = E, nu = 0.3, plane = "stress" } }
  end
  local upper <const>, lower <const> = body("upper", { 0, gap }, { 2, 1 + gap }, 2.1e5), body("lower", { 0, -1 }, { 2, 0 }, 1e5)
  upper:part "left":fix()
  upper:part "top":load{ 0, -1000 }
  lower:part "bottom":fix()
  local scene <const> = dotyk.scene{ upper, lower }
  return { scene = scene, body = upper, at = { 1.3, 0.5 },
           contact = scene:contact{ upper:part "bottom", lower:part "top", friction = friction }, friction = friction,
           move = { part = upper:part "bottom", control_points = 6, direction = { 0, 1 }, lower = -gap, upper = 2 * gap, extension = "structured" },
           alpha = { 0.01, 0.005, 0, -0.01, -0.008, 0 }, beta = { 0, 0.005, 0.01, 0.015, 0.01, -0.015 } }
end

local function block_on_ball(friction)
  local n <const> = math.max(4, 3 * cells // 10)
  local block <const> = dotyk.body{ name = "block", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.box{ from = { -1, -1, 0 }, to = { 1, 1, 1 }, cells = { n, n, n // 2 } } }
  block:part "top":displace{ x = function(x, y) return 0.004 - 0.005 * y end, y = function(x, y) return 0.002 + 0.005 * x end, z = -0.05 }
  local scene <const> = dotyk.scene{ block }
  local alpha <const>, beta <const> = {}, {}
  for i = 1, 16 do alpha[i], beta[i] = 0.005 * math.sin(i), 0.02 * math.cos(2 * i) end
  return { scene = scene, body = block, at = { 0.3, 0.2, 0.4 }, friction = friction,
           contact = scene:contact{ block:part "bottom", rigid = dotyk.rigid.ball{ center = { 0.1, 0.05, -3.01 }, radius = 3 },
                                    friction = friction, interference = true },
           move = { part = block:part "bottom", control_points = { 4, 4 }, direction = { 0, 0, 1 }, lower = -0.1, upper = 0.1 },
           alpha = alpha, beta = beta }
end

local function shape_of(case)
  return dotyk.shape{ scene = case.scene, moves = { case.move }, method = dotyk.solver[case.friction and "newton" or "pdas"]{ tol = 1e-14 } }
end
local function beside(alpha, t, beta) -- alpha + t beta
  local at <const> = {}
  for i, a in ipairs(alpha) do at[i] = a + t * beta[i] end
  return at
end

-- 2. Quantities of a design, dual numbers all.
local quantities <const> = {
  { "smoothed peak", function(d) return d.peak_pressure end },
  { "displacement", function(d, case) return (select(#case.at, d:displacement(case.body, table.unpack(case.at)))) end },
  { "nodal pressure", function(d, case) return d:contact(case.contact)[case.node].pressure end },
  { "user's function", function(d, case) -- how far the centre of the contact's force is from a point
    local force, x, y = 0, 0, 0
    for _, node in ipairs(d:contact(case.contact)) do
      force, x, y = force + node.force, x + node.force * node.x, y + node.force * node.y
    end
    return dotyk.dual.sqrt((x / force - 0.5)^2 + (y / force)^2)
  end },
  { "compliance", function(d) return d.compliance end }, -- last: Coulomb's friction has none
}
local function values(design, case)
  local v <const> = {}
  for k, quantity in ipairs(case.quantities or quantities) do v[k] = quantity[2](design, case) end
  return v
end

-- 3. Differences for h = 1e-1 ... 1e-10: central, or to one side and of second order, (-3q(0) + 4q(h) - q(2h))/2h.
local function central(at, h)
  local above <const>, below <const> = at(h), at(-h)
  return function(k) return (above[k].value - below[k].value) / (2 * h) end
end
local function one_sided(at, h)
  local zero <const>, one <const>, two <const> = at(0), at(h), at(2 * h)
  return function(k) return (4 * one[k].value - 3 * zero[k].value - two[k].value) / (2 * h) end
end

-- Their relative errors, printed; all fall below 1e-6 and rise again.
local function curves(title, difference, case)
  local shape <const>, series <const> = shape_of(case), {}
  local exact <const> = values(shape:design(case.alpha):along(case.beta), case)
  local function at(t) return values(shape:design(beside(case.alpha, t, case.beta)), case) end
  for k, quantity in ipairs(case.quantities or quantities) do series[k] = { name = quantity[1], x = {}, y = {} } end
  for power = 1, 10 do
    local h <const> = 10.0^-power
    local slope <const> = difference(at, h)
    for k, s in ipairs(series) do s.x[power], s.y[power] = h, math.abs(slope(k) / exact[k].gradient[1] - 1) end
  end
  print(("\n%-46s derivative   relative errors of differences, h = 1e-1 ... 1e-10%s least"):format(title, (" "):rep(9)))
  for k, s in ipairs(series) do
    local line, least = ("  %-42s %12.6g  "):format(s.name, exact[k].gradient[1]), math.huge
    for _, e in ipairs(s.y) do
      line, least = line .. (" %.0e"):format(e), math.min(least, e)
    end
    print(("%s   %.1e"):format(line, least))
    assert(least <= 1e-6 and s.y[1] > least and s.y[10] > least, s.name)
  end
  return series, exact
end

-- 4. Where all contact is with force, and friction not at the edge of slip.
local function most_pressed(nodes)
  local most = 1
  for k, node in ipairs(nodes) do
    if node.pressure > nodes[most].pressure then most = k end
  end
  return most
end
local panels <const> = {}
for _, smooth in ipairs{ { "Plane", cantilever }, { "Space", block_on_ball },
                         { "Plane, given friction", cantilever, tresca(300) }, { "Space, given friction", block_on_ball, tresca(12) },
                         { "Plane, Coulomb friction", cantilever, coulomb(0.4) }, { "Space, Coulomb friction", block_on_ball, coulomb(0.2) } } do
  local case <const> = smooth[2](smooth[3])
  if panels[4] then case.quantities = table.move(quantities, 1, #quantities - 1, 1, {}) end
  local first <const> = shape_of(case):design(case.alpha)
  assert(first.smooth)
  case.node = most_pressed(first:contact(case.contact))
  local c <const> = first.solution:contact(case.contact)
  local title = ("%s: %d nodes touch"):format(smooth[1], c.closed + c.stick + c.slip)
  if case.friction then title = ("%s: %d stick, %d slip"):format(smooth[1], c.stick, c.slip) end
  local series <const> = curves(title, central, case)
  panels[#panels + 1] = { title = title, y = "relative error", log = "xy", series = series }
  series[#series + 1] = { name = "10⁻⁶", reference = true, x = { 1e-10, 1e-1 }, y = { 1e-6, 1e-6 } }
end
dotyk.chart{ file = "images/shape_derivatives.png", x = "step h of the differences", panels = panels, columns = 2, size = { 2000, 1300 } }

-- 5. A kink: Newton's method for the fourth design variable, so that the last open node touches.
local case <const> = cantilever()
local shape <const>, variable <const> = shape_of(case), 4
case.beta = { 0, 0, 0, 0.02, 0, 0 }
local weak
for k, node in ipairs(shape:design(case.alpha):contact(case.contact)) do
  if node.status == "open" then weak = k end
end
print(("\nA kink: node %d of the cantilever's lower edge"):format(weak))
local apart, pressed -- values of the variable, on both sides of the kink once a step has gone beyond it: halved from then on
for step = 1, 80 do
  local node <const>, value <const> = shape:design(case.alpha):contact(case.contact)[weak], case.alpha[variable]
  if step <= 3 then print(("  step %d: variable %.15f, gap %.1e, force %.1e"):format(step, value, node.gap.value, node.force.value)) end
  if node.status == "open" then apart = value else pressed = value end
  if node.status == "open" and node.gap.value < 1e-16 or value == (apart + (pressed or 0)) / 2 then break end
  case.alpha[variable] = pressed and (apart + pressed) / 2 or value - node.gap.value / node.gap.gradient[variable]
end
local kink <const> = shape:design(case.alpha)
print("  in weak contact: " .. kink.weak)
assert(not kink.smooth)
case.node = weak + 1
local backwards <const> = setmetatable({ beta = beside({ 0, 0, 0, 0, 0, 0 }, -1, case.beta) }, { __index = case })
local forth <const>, right <const> = curves("As the variable grows", one_sided, case)
local back <const>, left <const> = curves("As it falls", one_sided, backwards)

print "\nTo both sides of the kink               falling      growing"
for k, quantity in ipairs(quantities) do
  local before <const>, after <const> = -left[k].gradient[1], right[k].gradient[1]
  print(("  %-30s %12.6g %12.6g"):format(quantity[1], before, after))
  assert(math.abs(after / before - 1) > 0.01 or quantity[1] == "compliance") -- least energies have no kinks
end

-- Through the kink: pressures with their tangents, drawn to their own side and a little beyond; how the smoothed peak changes.
local reach <const>, steps <const> = 0.18, 36
local through <const> = { [0] = kink }
for i = 1, steps do
  for side = -1, 1, 2 do through[side * i] = shape:design(beside(case.alpha, side * reach * i / steps, case.beta)) end
end
local function curve(name, from, to, of)
  local points <const> = { name = name, x = {}, y = {}, style = "line" }
  for i = from, to do
    points.x[i - from + 1], points.y[i - from + 1] = through[i].alpha[variable].value, of(through[i], i)
  end
  return points
end
local one_side <const> = { [-1] = kink:along(backwards.beta), [1] = kink:along(case.beta) }
local function tangent(name, side, of)
  local q <const>, scale <const> = of(one_side[side]), side * case.beta[variable]
  return { name = name, reference = true, x = { case.alpha[variable] - scale * reach / 3, case.alpha[variable] + scale * reach },
           y = { q.value - q.gradient[1] * reach / 3, q.value + q.gradient[1] * reach } }
end
local pressures <const> = {}
for k = weak, weak + 1 do
  local function of(d) return d:contact(case.contact)[k].pressure end
  pressures[#pressures + 1] = curve(k == weak and "node that begins to touch" or "next node", -steps, steps, function(d) return of(d).value end)
  pressures[#pressures + 1] = tangent(k > weak and "one-sided derivatives" or nil, 1, of)
  pressures[#pressures + 1] = tangent(nil, -1, of)
end
local function slope(side)
  return function(d, i)
    if i ~= 0 then return d.peak_pressure.gradient[variable] end
    return one_side[side].peak_pressure.gradient[1] / (side * case.beta[variable])
  end
end
dotyk.chart{ file = "images/shape_kink.png", columns = 2, size = { 2100, 1500 }, panels = {
  { title = "A node begins to touch", x = "design variable", y = "pressure", series = pressures },
  { title = "Smoothed peak pressure", x = "design variable", y = "derivative", series = { curve("node touches", -steps, 0, slope(-1)), curve("node open", 0, steps, slope(1)) } },
  { title = "Differences as the variable rises", x = "step h", y = "relative error", log = "xy", series = forth },
  { title = "Differences as the variable falls", x = "step h", y = "relative error", log = "xy", series = back } } }

-- 6. What is refused.
print "\nRefused:"
local function refused(what, f)
  local ok <const>, message <const> = pcall(f)
  assert(not ok, what)
  print(("  %s\n    %s"):format(what, message))
end
local stuck <const> = cantilever(tresca(1e4))
local nodes <const> = shape_of(stuck):design(stuck.alpha).solution:contact(stuck.contact).nodes
local inner <const> = (weak + #nodes) // 2
local node <const> = nodes[inner]
assert(node.status == "stick")
local shear <const> = math.sqrt(node.shear[1]^2 + node.shear[2]^2)
local function edge(share) return cantilever(tresca(function(x) return math.abs(x - node.x) < 1e-9 and share * shear or 1e4 end)) end
refused("given friction that just holds at one node", function()
  local it <const> = edge(1)
  return shape_of(it):design(it.alpha).peak_pressure
end)
for _, share in ipairs{ 0.999, 1.001 } do -- beside it
  local it <const> = edge(share)
  local d <const> = shape_of(it):design(it.alpha)
  assert(d.solution:contact(it.contact).nodes[inner].status == (share < 1 and "slip" or "stick") and d.peak_pressure.gradient[1] ~= 0)
end
refused("the compliance with Coulomb friction", function()
  local it <const> = cantilever(coulomb(0.4))
  return shape_of(it):design(it.alpha).compliance
end)
print "\nimages/shape_derivatives.png, images/shape_kink.png"
