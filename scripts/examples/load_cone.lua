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
local wrong, series, all_refused = 0, {}, { name = "refused", reference = true, x = {}, y = {} }
for row, case in ipairs(cases) do
  -- One ring a case: what is refused is a gap in what is carried, and the other way round.
  local count, limits, ring = 0, {}, { name = ("%d: %s"):format(row, case.name), x = {}, y = {}, style = case.from == case.to and "points" or "line" }
  local function draw(angle, carried)
    for _, into in ipairs{ ring, all_refused } do
      into.x[#into.x + 1], into.y[#into.y + 1] = angle, carried == (into == ring) and row or 0/0
    end
  end
  for angle = 0, 360 - step, step do
    local verdict = square(angle, case.planes, case.friction):balance()
    local expected = angle >= case.from - 1e-9 and angle <= case.to + 1e-9 or (case.to == 360 and angle == 0)
    if verdict.solvable ~= expected then
      wrong = wrong + 1
      print(("wrong: %s at %g°: %s"):format(case.name, angle, verdict.verdict))
    end
    if verdict.solvable and verdict.limit then limits[#limits + 1] = ("%g°"):format(angle) end
    if verdict.solvable then count = count + 1 end
    draw(angle, verdict.solvable)
  end
  print(("%-20s carries %d of %d directions; limit cases at %s"):format(case.name, count, #ring.x, table.concat(limits, ", ")))
  draw(360, ring.y[1] == row)
  all_refused.x[#all_refused.x + 1], all_refused.y[#all_refused.y + 1] = 0, 0/0 -- rings are not joined
  series[row] = ring
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
local sphere <const> = { x = {}, y = {}, values = {}, names = { "refused", "carried by three planes", "carried by a floor, μ = 0.4", "carried by both" } }
for down = 0, 90, 5 * step do -- the angle from straight down; longitudes are in the middle of cells, which the boundaries at 180° and 270° do not cut
  local row <const> = {}
  for longitude = 2.5 * step, 360, 5 * step do
    local a, b = math.rad(90 - down), math.rad(longitude)
    local x, y, z = math.cos(a) * math.cos(b), math.cos(a) * math.sin(b), -math.sin(a)
    local verdict = cube(x, y, z):balance()
    local expected = x < 1e-12 and y < 1e-12 and z < 1e-12
    local rubs = cube(x, y, z, dotyk.friction.coulomb(mu)):balance()
    if rubs.solvable ~= (math.sqrt(x^2 + y^2) < -mu * z) then
      spherical = spherical + 1
      print(("wrong: with friction at %g from straight down, longitude %g: %s"):format(down, longitude, rubs.verdict))
    end
    if verdict.solvable ~= expected then
      spherical = spherical + 1
      print(("wrong: in space at %g from straight down, longitude %g: %s"):format(down, longitude, verdict.verdict))
    end
    count = count + 1
    row[#row + 1] = 1 + (verdict.solvable and 1 or 0) + (rubs.solvable and 2 or 0)
    sphere.x[#row] = longitude
  end
  sphere.y[#sphere.y + 1], sphere.values[#sphere.y + 1] = down, row
end
print(("space: %d directions of the lower hemisphere, %d wrong"):format(count, spherical))

table.insert(series, 1, all_refused)
dotyk.chart{ file = "images/load_cone.png", polar = true, x = "direction of the load", y = "case", series = series, size = { 1000, 1050 } }
dotyk.chart{ file = "images/load_hemisphere.png", polar = true, x = "longitude of the load's direction", y = "angle from straight down [°]",
             map = sphere, size = { 1000, 1050 } }
print "images/load_cone.png, images/load_hemisphere.png"
if wrong + spherical > 0 then error(wrong + spherical .. " verdicts are wrong") end
