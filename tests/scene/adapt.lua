-- dotyk.adapt: loop, history, ends, errors.
local check = require "check"

local start = dotyk.mesh.rectangle{ from = { -1, -1 }, to = { 1, 0 }, cells = { 8, 4 } }
local function punch(mesh)
  local block = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 } }
  block:part "bottom":fix()
  local scene = dotyk.scene{ block }
  local under = block:part("under", function(x, _, _, ny) return ny > 0.9 and math.abs(x) < 0.5 end)
  return scene, scene:contact{ under, rigid = dotyk.rigid.gap{ normal = { 0, 1 }, gap = -0.02 } }
end

local rounds = 0
local s, history, contact = dotyk.adapt{ scene = punch, mesh = start, tol = 0.1, on_round = function(k, entry, solution, c)
  rounds = rounds + 1
  check.equal({ k, entry.unknowns, #solution:contact(c).nodes > 0 }, { rounds, solution.unknowns, true })
end }
check.equal({ history.converged, history.reason, #history }, { true, "the estimate is at most tol", rounds })
check.that(history[#history].estimate <= 0.1 and history[#history - 1].estimate > 0.1)
check.near(s:error_estimate(), history[#history].estimate, 1e-14)
check.that(s:contact(contact).max_pressure > 0)
for k = 2, #history do
  check.that(history[k].unknowns > history[k - 1].unknowns and history[k].cells > history[k - 1].cells)
  check.that(history[k].seconds >= history[k - 1].seconds and history[k].absolute < history[k - 1].absolute)
end

-- Uniform refinement needs more unknowns for the same estimate.
local _, uniform = dotyk.adapt{ scene = punch, mesh = start, tol = 0.1, uniform = true }
check.that(uniform.converged and uniform[#uniform].unknowns > 5 * history[#history].unknowns)

-- Other ends.
local function ended(options)
  options.scene, options.mesh = punch, start
  local _, h = dotyk.adapt(options)
  check.that(not h.converged)
  return h.reason, #h
end
check.equal({ ended{ max_rounds = 2 } }, { "max_rounds reached", 2 })
check.equal((ended{ max_unknowns = 300 }), "max_unknowns reached")
check.equal({ ended{ on_round = function() return false end } }, { "stopped by on_round", 1 })
check.that(ended{ method = dotyk.solver.uzawa{ max_iterations = 1 } }:find "the solve did not converge")

-- Two bodies: their nodes go on matching. A disc keeps its boundary.
local upper = dotyk.mesh.rectangle{ from = { -1, 0 }, to = { 1, 1 }, cells = { 8, 4 } }
local pair = dotyk.adapt{ mesh = { start, upper }, tol = 0.15, scene = function(a, b)
  local lower = dotyk.body{ name = "lower", mesh = a, material = dotyk.material{ E = 1000, nu = 0.3 } }
  local top = dotyk.body{ name = "top", mesh = b, material = dotyk.material{ E = 3000, nu = 0.3 } }
  lower:part "bottom":fix()
  top:part "top":displace{ x = 0, y = -0.02 }
  local scene = dotyk.scene{ lower, top }
  scene:contact{ lower:part "top", top:part "bottom", gap = function(x) return 0.1 * x^2 end }
  return scene
end }
check.that(pair:error_estimate() <= 0.15)

local disc = dotyk.mesh.disc{ center = { 0, 1 }, radius = 1, cells = 6 }
local d, rounds_of_disc, wheel = dotyk.adapt{ mesh = disc, tol = 0.12,
  curved = { { part = "boundary", map = function(x, y) local r = math.sqrt(x^2 + (y - 1)^2) return x / r, 1 + (y - 1) / r end } },
  scene = function(mesh)
    local body = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 }, force = { 0, -10 } }
    body:part("boundary"):spring{ x = 1, y = 0 }
    local scene = dotyk.scene{ body }
    local below = body:part("below", function(_, y) return y < 0.5 end)
    return scene, scene:contact{ below, rigid = dotyk.rigid.plane{ point = { 0, 0 }, normal = { 0, 1 } } }, body
  end }
check.that(rounds_of_disc.converged and #rounds_of_disc > 1)
check.near(d:contact(wheel).force[2], 10 * math.pi, 0.02 * 10 * math.pi) -- its weight: the polygon comes near the disc
for _, node in ipairs(d:contact(wheel).nodes) do check.near(node.x^2 + (node.y - 1)^2, 1, 1e-12) end

check.error(function() dotyk.adapt{ mesh = start, scene = function() return 1 end } end, "'scene' must return a scene first, it returned number")
check.error(function() dotyk.adapt{ mesh = start, scene = punch, tol = 0 } end, "tol")
check.error(function() dotyk.adapt{ mesh = start, scene = punch, tolerance = 1 } end, "unknown key 'tolerance'")
check.error(function() dotyk.adapt{ mesh = start, tol = 1e-3, scene = function() return punch(dotyk.refinement{ start }:refine().meshes[1]) end } end,
            "no body of the solution has one of the meshes")
