-- Coulomb friction with several solutions: an inclined strut that jams, slides or lifts off under the same load.
--
--   ./dotyk scripts/examples/several_solutions.lua [ANGLES] [STARTS]
--
-- A strut clamped at its upper end leans on a rigid floor. Pulled sideways it would swing up and away; with
-- enough friction it may as well stay jammed. For each load (a force per area, ANGLES directions) and
-- coefficient all solutions are found by enumeration of open, stick and slip at each contact node. On one load:
-- which of its three solutions Newton's method finds from STARTS random starts, and what the fixed-point
-- iteration over given friction, g = mu times the last pressure, does. At last a triangle that has a continuum of
-- solutions at one coefficient. Draws images/several_solutions.png, the
-- three states, images/several_open.png, several_stick.png and several_slip.png, and images/several_family.png.

local angles <const>, starts <const> = tonumber(arg[1]) or 45, tonumber(arg[2]) or 1000
local material <const> = dotyk.material{ E = 1000, nu = 0.3 }

-- 1. The strut: 60° to the floor, three contact nodes.
local function strut(law, force)
  local mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 6}, cells = {2, 12} }
  local tangent = math.tan(math.rad(60))
  mesh:transform(function(x, y) return x + y / tangent, y end)
  local body = dotyk.body{ name = "strut", material = material, mesh = mesh, force = force }
  body:part"top":fix()
  local scene = dotyk.scene{ body }
  return scene, scene:contact{ body:part"bottom", rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = 0 }, friction = law }
end

local function states(c)
  local text = {}
  for k, node in ipairs(c.nodes) do
    text[k] = node.status == "slip" and (node.slip[1] > 0 and "slip right" or "slip left") or node.status
  end
  return table.concat(text, ", ")
end

-- 2. How many solutions? Load directions against coefficients: all round, then where there are several.
local function count(mu, angle)
  local t = math.rad(angle)
  return #dotyk.all_solutions((strut(dotyk.friction.coulomb(mu), { math.cos(t), math.sin(t) })))
end
local first <const>, last <const> = 160, 250
for _, mu in ipairs{ 0.3, 1, 2, 3 } do
  for angle = last, first + 360, 10 do assert(count(mu, angle + 0.37) == 1) end
end
print(("one solution for all directions from %d° on to %d°; between these:"):format(last, first))
print "coefficient   directions with one, with three solutions, from … to …"
local regions <const> = { [1] = { name = "1 solution", style = "points", x = {}, y = {} },
                          [3] = { name = "3 solutions", style = "points", x = {}, y = {} } }
for tenths = 1, 30 do
  local mu, of, from, to = tenths / 10, { [1] = 0, [3] = 0 }, nil, nil
  for k = 1, angles do
    local angle = first + (last - first) * (k - 0.37) / angles
    local n = count(mu, angle)
    of[n] = of[n] + 1
    table.insert(regions[n].x, angle)
    table.insert(regions[n].y, mu)
    if n == 3 then from, to = from or angle, angle end
  end
  print(("%8.1f      %4d  %4d  %s"):format(mu, of[1], of[3], from and ("%.1f° to %.1f°"):format(from, to) or ""))
end
dotyk.chart{ file = "images/several_solutions.png", x = "direction of the load [degrees]", y = "coefficient of friction",
             series = { regions[1], regions[3] } }

-- 3. One load in full.
local mu <const>, force <const> = 1, { -0.3, -0.3 }
local scene, contact = strut(dotyk.friction.coulomb(mu), force)
local all, tried = dotyk.all_solutions(scene)
print(("\nmu = %g, force per area (%g, %g): %s"):format(mu, force[1], force[2], tried))
print "      energy   normal force   friction force   equilibrium  law        contact nodes"
for k, s in ipairs(all) do
  local c = s:contact(contact)
  print(("%d  %10.6f  %12.6f  %15.6f      %.0e    %.0e  %s"):format(k, s.energy, c.force[2], c.force[1],
    s.residual.equilibrium, s.residual.law, states(c)))
end

-- 4. What Newton's method finds.
local found, unconverged, elsewhere = {}, 0, 0
for seed = 1, starts do
  local s = dotyk.solver.newton{ seed = seed }:solve(scene)
  local which
  for k, one in ipairs(all) do
    if math.abs(s.energy - one.energy) < 1e-7 * math.abs(one.energy) then which = k end
  end
  if not s.converged then unconverged = unconverged + 1
  elseif which then found[which] = (found[which] or 0) + 1
  else elsewhere = elsewhere + 1 end
end
print(("\nNewton's method from %d random starts, %d unconverged, %d at none of these:"):format(starts, unconverged, elsewhere))
for k = 1, #all do print(("   solution %d: %d times"):format(k, found[k] or 0)) end
local cold = dotyk.solve(scene)
for k, one in ipairs(all) do
  if math.abs(cold.energy - one.energy) < 1e-7 * math.abs(one.energy) then print("   from rest: solution " .. k) end
end
assert(unconverged == 0 and elsewhere == 0)

-- 5. The fixed-point iteration g := mu p over given friction, from no friction and from near each solution.
local function outer(pressure)
  local state = "no convergence in 200 iterations"
  for iteration = 1, 200 do
    local given = dotyk.friction.tresca(function(x) return mu * pressure(x) end)
    local s2, c2 = strut(given, force)
    local s = dotyk.solve(s2)
    local next = {}
    local change, size = 0, 0
    for _, node in ipairs(s:contact(c2).nodes) do
      next[#next + 1] = { node.x, node.pressure }
      change, size = change + math.abs(node.pressure - pressure(node.x)), size + node.pressure
    end
    local before = pressure
    pressure = function(x)
      for _, p in ipairs(next) do if math.abs(p[1] - x) < 1e-9 then return p[2] end end
      return before(x)
    end
    if change <= 1e-9 * size then
      for k, one in ipairs(all) do
        if math.abs(s.energy - one.energy) < 1e-6 * math.abs(one.energy) then
          state = ("solution %d after %d iterations"):format(k, iteration)
        end
      end
      break
    end
  end
  return state
end
print "\nthe fixed-point iteration over given friction:"
print("   from no friction: " .. outer(function() return 0 end))
for k, one in ipairs(all) do
  local nodes = one:contact(contact).nodes
  local function near(x)
    for _, node in ipairs(nodes) do if math.abs(node.x - x) < 1e-9 then return 0.999 * node.pressure end end
    return 0
  end
  print(("   from 0.999 times the pressure of solution %d: %s"):format(k, outer(near)))
end

-- 6. The states.
for _, s in ipairs(all) do
  local c = s:contact(contact)
  local name = c.slip + c.stick == 0 and "open" or c.stick > 0 and "stick" or "slip"
  s:render{ file = "images/several_" .. name .. ".png", field = "displacement", units = { length = "mm", stress = "MPa" }, deform = 10, supports = true, zoom = name ~= "open" and { -0.3, -0.5, 1.3, 0.5 } or nil }
end

-- 7. A continuum. The triangle O (0,0), B (1,0), P (1/5, 4/15) on a rigid floor; O and P are held (P displaced), B is loaded and free: at mu = 3 its slip
-- lowers the friction that it meets exactly as much as the force that drives it, so that it may stop anywhere between
-- sticking and lifting off. Enumeration finds the singular combination and the ends of its solutions.
local function triangle(mu)
  local mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {1, 1}, element = "P1" }
  mesh:transform(function(x, y) -- the upper left triangle is held whole
    if y < 0.5 then return x, y end
    return x / 5, x > 0.5 and 4 / 15 or 1
  end)
  local body = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 2.2, nu = 0.1 } }
  body:part"left":fix()
  body:part"top":displace{ x = function(x) return 2 * x end, y = function(x) return -8 * x / 27 end }
  body:part"right":load{ 40 / (9 * math.sqrt(10)), 0 }
  local scene = dotyk.scene{ body }
  return scene, scene:contact{ body:part"bottom", rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = 0 }, friction = dotyk.friction.coulomb(mu) }, body
end
local isolated <const>, continuum <const> = { name = "isolated solutions", style = "points", x = {}, y = {} }, { name = "a continuum", x = {}, y = {} }
print "\nthe triangle:"
for quarters = 8, 16 do
  local mu = quarters / 4
  local one, floor, body = triangle(mu)
  local found, told, families = dotyk.all_solutions(one)
  assert((#families == 1) == (mu == 3), told)
  local into = mu == 3 and continuum or isolated
  if mu % 0.5 == 0 then print(("   mu = %g: %s"):format(mu, told)) end
  for k, s in ipairs(found) do
    local moved = s:displacement(body, 1, 0)
    into.x[#into.x + 1], into.y[#into.y + 1] = mu, moved
    if mu % 0.5 == 0 then print(("      B moves by %.6f, normal force %.6f"):format(moved + 0, s:contact(floor).force[2])) end
  end
end
assert(#continuum.y == 2 and math.abs(math.abs(continuum.y[1] - continuum.y[2]) - 2) < 1e-9)
dotyk.chart{ file = "images/several_family.png", x = "coefficient of friction", y = "displacement of B along the floor", y_range = { -0.1, 2.1 }, series = { isolated, continuum } }
print "images/several_solutions.png, several_open.png, several_stick.png, several_slip.png, several_family.png"
