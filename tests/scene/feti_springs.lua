-- Springs under total FETI: rows of their own, so that every piece keeps its rigid motions for the coarse space. Steps
-- then depend neither on their stiffness nor on the number of pieces, and are those of the same foundation by a law.
local check <const> = require "check"

-- A slender strip on an elastic foundation, pressed at one end, which a wall then meets; held along x at the left, moved there.
local function strip(kind, k)
  local body = dotyk.body{ name = "strip", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = { 0, 0 }, to = { 3, 0.1 }, cells = { 120, 4 }, element = "Q1" } }
  body:part "left":displace{ x = 0.001 }
  if kind == "spring" then body:part "bottom":spring{ x = k / 2, y = k }
  else body:part "bottom":support{ normal = dotyk.law.elastic(k), tangential = dotyk.law.elastic(k / 2) } end
  body:part("patch", function(x, _, _, ny) return ny > 0.9 and x < 0.15 end):pressure(0.3)
  local scene = dotyk.scene{ body }
  scene:contact{ body:part "right", rigid = dotyk.rigid.gap{ normal = { 1, 0 }, gap = 5e-4 } }
  return scene
end

for _, k in ipairs{ 1, 100, 1e4 } do
  for _, preconditioner in ipairs{ "none", "dirichlet" } do
    local steps = {}
    for _, kind in ipairs{ "spring", "law" } do
      local scene <const> = strip(kind, k)
      local direct <const> = dotyk.solver.pdas{}:solve(scene)
      for _, pieces in ipairs{ 5, 20 } do
        local s <const> = dotyk.solver.feti{ subdomains = pieces, preconditioner = preconditioner }:solve(scene)
        assert(s.converged, s.reason)
        check.near(s.energy / direct.energy, 1, 1e-8, "energy")
        check.equal(s.feti.kernel, 3 * pieces, "rigid motions of all pieces")
        steps[kind] = math.max(steps[kind] or 0, s.feti.inner)
      end
    end
    -- 26 to 93; with springs in the matrices hundreds to thousands, as that strip was cut finer.
    assert(steps.spring <= 110 and steps.spring <= 1.3 * steps.law + 5, steps.spring)
  end
end
