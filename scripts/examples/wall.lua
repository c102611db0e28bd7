-- A masonry wall with a window, of dry bricks with friction, on ground that settles.
--
--   ./dotyk scripts/examples/wall.lua [COURSES]
--
-- Every brick is a free elastic body, held by contact with its neighbours alone; under the right half of the wall the
-- ground sinks. FETI: every brick is a subdomain, bricks of one shape share one factor, and their rigid motions are the
-- coarse space; Coulomb friction by the outer loop over given friction.
-- images/wall.png: the wall, deformed, with what its joints do.

local courses <const> = math.tointeger(tonumber(arg and arg[1]) or 18)
local half <const>, height <const> = 0.125, 0.125  -- half the length of a brick, its height; m
local wide <const> = 2 * (courses * 2 // 3)        -- of the wall, in half bricks
local cells <const> = 4                            -- over half a brick, and over its height
local mu <const>, sinking <const> = 0.6, 2e-4      -- friction; m
local clay <const> = dotyk.material{ E = 1e9, nu = 0.2 }
local weight <const> = 18e3                        -- N/m³

-- 1. The bricks, course by course, from and to in half bricks. Every other course begins and ends with half a one;
-- over the window lies a lintel.
local window <const> = { from = wide // 4 // 2 * 2, to = wide // 4 // 2 * 2 + 5, first = courses // 3 + 1, last = 2 * courses // 3 }
local function segments(course)
  if course >= window.first and course <= window.last then return { { 0, window.from }, { window.to, wide } } end
  if course == window.last + 1 then
    return { { 0, window.from - 1 }, { window.from - 1, window.to + 1, lintel = true }, { window.to + 1, wide } }
  end
  return { { 0, wide } }
end
local wall, bodies = {}, {}
local function add(course, from, to)
  local body <const> = dotyk.body{ name = ("brick %d.%d"):format(course, #wall[course] + 1), material = clay, force = { 0, -weight },
    mesh = dotyk.mesh.rectangle{ from = { from * half, (course - 1) * height }, to = { to * half, course * height },
                                 cells = { (to - from) * cells, cells }, element = "Q1" } }
  table.insert(wall[course], { body = body, from = from, to = to })
  table.insert(bodies, body)
end
for course = 1, courses do
  wall[course] = {}
  for _, segment in ipairs(segments(course)) do
    local from = segment[1]
    while from < segment[2] do
      local to = segment.lintel and segment[2] or from + 2 - (from + course + 1) % 2
      to = math.min(to, segment[2])
      add(course, from, to)
      from = to
    end
  end
end

-- 2. Joints: between neighbours of a course, and over each length that two bricks of two courses share.
local scene <const> = dotyk.scene(bodies)
local joints = {}
local friction <const> = dotyk.friction.coulomb(mu)
local function upper(brick, from, to, side)
  return brick.body:part(side, function(x, _, _, ny)
    return (side == "top" and ny > 0.5 or side == "bottom" and ny < -0.5) and x > from * half and x < to * half
  end)
end
for course = 1, courses do
  for k, brick in ipairs(wall[course]) do
    local next <const> = wall[course][k + 1]
    if next and next.from == brick.to then
      joints[#joints + 1] = scene:contact{ brick.body:part "right", next.body:part "left", friction = friction }
    end
    for _, above in ipairs(wall[course + 1] or {}) do
      local from <const>, to <const> = math.max(brick.from, above.from), math.min(brick.to, above.to)
      if from < to then
        joints[#joints + 1] = scene:contact{ upper(above, from, to, "bottom"), upper(brick, from, to, "top"), friction = friction }
      end
    end
  end
end
-- The ground: firm on the left, and sinking to the right of the window's middle.
local function sunk(x)
  local t <const> = math.min(1, math.max(0, (x / half / wide - 0.5) / 0.3))
  return sinking * t * t * (3 - 2 * t)
end
for _, brick in ipairs(wall[1]) do
  joints[#joints + 1] = scene:contact{ brick.body:part "bottom", friction = friction,
    rigid = dotyk.rigid.gap{ normal = {0, -1}, gap = sunk } }
end

-- 3. The solution, and what the wall does.
local solver <const> = dotyk.solver.feti{ tol = 1e-5, max_iterations = 2000 }
local s <const> = solver:solve(scene)
assert(s.converged, s.reason)
print(s)
local counts = { open = 0, stick = 0, slip = 0 }
for _, joint in ipairs(joints) do
  local c <const> = s:contact(joint)
  for key in pairs(counts) do counts[key] = counts[key] + c[key] end
end
print(("%d bricks, %d joints: %d nodes open, %d stick, %d slip"):format(#bodies, #joints, counts.open, counts.stick, counts.slip))
s:render{ file = "images/wall.png", field = "von_mises", deform = 300, contact = true, pressure = "none", units = { length = "m", stress = "Pa" }, size = { 1600, 1300 } }
print "images/wall.png"
