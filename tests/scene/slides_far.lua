-- Contact is that of what faces each other before the load: where parts that press slide far along each other, or along a ball,
-- the solution says so.
local is <const> = require("check").that

local function told(way, ball)
  local function block(name, low) return dotyk.body{ name = name, material = dotyk.material{ E = 1000, nu = 0.3 }, mesh = dotyk.mesh.rectangle{ from = {0, low}, to = {1, low + 1}, cells = {4, 4} } } end
  local above <const>, below <const> = block("above", 1), block("below", 0)
  local scene <const> = dotyk.scene{ above, below }
  if ball then scene:contact{ above:part"bottom", rigid = dotyk.rigid.ball{ center = {0.5, 0.5}, radius = 0.5 } }
  else scene:contact{ above:part"bottom", below:part"top" } end
  below:part"bottom":fix()
  above:part"top":displace{ x = way, y = -0.001 }
  local s <const> = dotyk.solve(scene)
  is(s.converged, s.reason)
  for _, warning in ipairs(s.warnings) do
    if warning:find "what presses slides by" then return tonumber(warning:match "slides by (%S+) times") end
  end
end

is(not told(0.01) and not told(0.01, true), "a short way is no matter")
is(told(0.3) > 0.1 and told(0.3) < 0.4, "along a body: a part of its size")
is(told(0.3, true) > 0.5 and told(0.3, true) < 0.7, "along a ball: a part of its radius")

-- Facets that are chords are told where they leave nodes open, too: rings pressed together, whose pressure would be even.
local function ring(name, from, to, cells)
  local mesh <const> = dotyk.mesh.rectangle{ from = {0, 0}, to = {1, 1}, cells = { cells, 4 } }:transform(function(u, v)
    local t <const>, r <const> = math.pi / 2 * (1 - u), from + (to - from) * v
    return r * math.cos(t), r * math.sin(t)
  end)
  local body <const> = dotyk.body{ name = name, mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 } }
  body:part"left":slide()
  body:part"right":slide()
  return body
end
for _, cells in ipairs{ {8, 9}, {10, 11}, {16, 19} } do
  local inner <const>, outer <const> = ring("inner", 0.5, 1.0005, cells[1]), ring("outer", 1, 1.5, cells[2])
  local scene <const> = dotyk.scene{ inner, outer }
  local contact <const> = scene:contact{ inner:part"top", outer:part"bottom", interference = true }
  local s <const> = dotyk.solve(scene)
  is(s:contact(contact).area < 0.9 * math.pi / 2, "chords leave nodes open")
  is(#s.warnings == 1 and s.warnings[1]:find "facets are chords up to", s.warnings[1] or "no warning")
end
