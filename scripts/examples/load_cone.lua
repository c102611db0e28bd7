-- Which loads can contact carry? The direction of a load swept over the circle and the hemisphere.
--
--   ./dotyk scripts/examples/load_cone.lua [STEP]
--
-- A block stands free on rigid ground: on one plane without and with friction, between a floor and walls.
-- A load pulls at its middle (force per volume) in every direction of a sweep; a solution exists exactly
-- where the load does no work on any admissible rigid motion. The verdict is compared with the closed
-- form direction by direction. In space the same on three mutually perpendicular planes.
-- Draws images/load_cone.png and images/load_hemisphere.png. Exits with an error where a verdict is wrong.

local step <const> = tonumber(arg[1]) or 1 -- degrees
local material <const> = dotyk.material{ E = 100, nu = 0.3 }

-- 1. A square on planes whose normals (towards the block) are given by their angles.
local function square(angle, planes, friction)
  local t = math.rad(angle)
  local block = dotyk.body{ name = "block", material = material, force = { math.cos(t), math.sin(t) },
    mesh = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = {2, 2} } }
  local scene = dotyk.scene{ block }
  for part, normal in pairs(planes) do
    scene:contact{ block:part(part), rigid = dotyk.rigid.gap{ normal = normal, gap = 0 }, friction = friction }
  end
  return scene
end

-- 2. The closed form. The load acts at the middle of the square. One plane: only straight against it
-- (any turn slides the block off); with friction, within the angle of friction (the block is too low to
-- tip before it slides). Two sides at a right angle: everything between.
local mu <const> = 0.4
local cases <const> = {
  { name = "floor", planes = { bottom = {0, -1} }, from = 270, to = 270 },
  { name = "floor, μ = 0.4", planes = { bottom = {0, -1} }, friction = dotyk.friction.coulomb(mu),
    from = 270 - math.deg(math.atan(mu)), to = 270 + math.deg(math.atan(mu)) },
  { name = "floor and wall", planes = { bottom = {0, -1}, left = {-1, 0} }, from = 180, to = 270 },
  { name = "floor and two walls", planes = { bottom = {0, -1}, left = {-1, 0}, right = {1, 0} }, from = 180, to = 360 },
}

-- 3. The sweep.
local wrong, series, all_refused = 0, {}, { {}, {} }
for row, case in ipairs(cases) do
  local carried, refused, limits = { {}, {} }, { {}, {} }, {}
  for angle = 0, 360 - step, step do
    local verdict = square(angle, case.planes, case.friction):balance()
    local expected = angle >= case.from - 1e-9 and angle <= case.to + 1e-9 or (case.to == 360 and angle == 0)
    if verdict.solvable ~= expected then
      wrong = wrong + 1
      print(("wrong: %s at %g°: %s"):format(case.name, angle, verdict.verdict))
    end
    if verdict.solvable and verdict.limit then limits[#limits + 1] = ("%g°"):format(angle) end
    local into = verdict.solvable and carried or refused
    local radius = 0.4 + 0.2 * row -- one ring a case
    into[1][#into[1] + 1] = radius * math.cos(math.rad(angle))
    into[2][#into[2] + 1] = radius * math.sin(math.rad(angle))
  end
  print(("%-20s carries %d of %d directions; limit cases at %s"):format(
    case.name, #carried[1], #carried[1] + #refused[1], table.concat(limits, ", ")))
  series[#series + 1] = { name = case.name .. ": carried", x = carried[1], y = carried[2], style = "points" }
  for k = 1, 2 do table.move(refused[k], 1, #refused[k], #all_refused[k] + 1, all_refused[k]) end
end

-- 4. On the edge, to either side: within 1e-6 of it a load is a limit case, farther away it is none.
local function edge(what, turn, verdict)
  print(("%s, turned by %8.0e beyond the edge: %s%s"):format(what, turn, verdict.verdict, verdict.limit and ", a limit case" or ""))
  if verdict.limit ~= (math.abs(turn) < 1e-6) or (turn ~= 0 and verdict.solvable ~= (turn < 0)) then wrong = wrong + 1 end
end
local turns <const> = { -1e-4, -1e-5, -2e-6, -5e-7, -1e-7, 1e-7, 5e-7, 2e-6, 1e-5, 1e-4 }
for _, turn in ipairs(turns) do
  edge("floor and wall", turn, square(270 + math.deg(turn), cases[3].planes):balance())
end
for _, turn in ipairs(turns) do
  edge("floor with friction", turn,
    square(270 + math.deg(math.atan(mu) + turn), cases[2].planes, cases[2].friction):balance())
end

-- 5. In space: a cube in a corner of three planes carries the octant of directions into the corner; on
-- one plane with friction, the cone of friction.
local function cube(x, y, z, friction)
  local block = dotyk.body{ name = "cube", material = material, force = { x, y, z },
    mesh = dotyk.mesh.box{ from = {0, 0, 0}, to = {1, 1, 1}, cells = {1, 1, 1} } }
  local scene = dotyk.scene{ block }
  local planes = friction and { bottom = {0, 0, -1} } or { bottom = {0, 0, -1}, left = {-1, 0, 0}, front = {0, -1, 0} }
  for part, normal in pairs(planes) do
    scene:contact{ block:part(part), rigid = dotyk.rigid.gap{ normal = normal, gap = 0 }, friction = friction }
  end
  return scene
end
for _, longitude in ipairs{ 0, 30, 90, 200 } do
  local b = math.rad(longitude)
  for _, turn in ipairs(turns) do
    local a = math.atan(mu) + turn -- from straight down
    edge(("cone of friction in space, towards %3d°"):format(longitude), turn,
      cube(math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), -math.cos(a), dotyk.friction.coulomb(mu)):balance())
  end
end
local count, spherical = 0, 0
local sphere <const> = { carried = { {}, {} }, refused = { {}, {} }, rubs = { {}, {} } }
for latitude = 0, 90, 5 * step do
  for longitude = 0, 360 - 5 * step, 5 * step do
    local a, b = math.rad(latitude), math.rad(longitude)
    local x, y, z = math.cos(a) * math.cos(b), math.cos(a) * math.sin(b), -math.sin(a)
    local verdict = cube(x, y, z):balance()
    local expected = x < 1e-12 and y < 1e-12 and z < 1e-12
    local rubs = cube(x, y, z, dotyk.friction.coulomb(mu)):balance()
    if rubs.solvable ~= (math.sqrt(x^2 + y^2) < -mu * z) then
      spherical = spherical + 1
      print(("wrong: with friction at latitude %g, longitude %g: %s"):format(latitude, longitude, rubs.verdict))
    end
    if rubs.solvable then sphere.rubs[1][#sphere.rubs[1] + 1], sphere.rubs[2][#sphere.rubs[2] + 1] = x, y end
    local into = sphere[verdict.solvable and "carried" or "refused"]
    into[1][#into[1] + 1], into[2][#into[2] + 1] = x, y
    count = count + 1
    if verdict.solvable ~= expected then
      spherical = spherical + 1
      print(("wrong: in space at latitude %g, longitude %g: %s"):format(latitude, longitude, verdict.verdict))
    end
  end
end
print(("space: %d directions of the lower hemisphere, %d wrong"):format(count, spherical))

table.insert(series, 1, { name = "refused", x = all_refused[1], y = all_refused[2], style = "points" })
local around <const>, ball <const> = { -1.3, 1.3 }, { -1.1, 1.1 } -- one range on both axes: circles are round
dotyk.chart{ file = "images/load_cone.png", x = "x component of the load's direction (times the ring)",
             y = "y component", series = series, x_range = around, y_range = around, size = { 900, 960 } }
dotyk.chart{ file = "images/load_hemisphere.png", x = "x component of the load's direction", y = "y component",
             x_range = ball, y_range = ball, size = { 820, 840 },
             series = { { name = "refused", x = sphere.refused[1], y = sphere.refused[2], style = "points" },
                        { name = "carried by three planes", x = sphere.carried[1], y = sphere.carried[2], style = "points" },
                        { name = "carried by a floor with friction 0.4", x = sphere.rubs[1], y = sphere.rubs[2], style = "points" } } }
print "images/load_cone.png, images/load_hemisphere.png"
if wrong + spherical > 0 then error(wrong + spherical .. " verdicts are wrong") end
