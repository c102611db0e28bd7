-- active_set, interior_point and penalty from Lua: what their solutions say, and what they refuse.
local check, refused = require "check", require "refused"

local function scene()
  local block = dotyk.body{ name = "block", material = dotyk.material{ E = 100, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {0, 0.1}, to = {1, 1.1}, cells = {4, 4} } }
  block:part"left":slide()
  block:part"top":pressure(1)
  local s = dotyk.scene{ block }
  s:contact{ block:part"bottom", rigid = dotyk.rigid.plane{ point = {0, 0}, normal = {0, 1} } }
  return s
end

local exact = dotyk.solver.pdas{}:solve(scene())
check.that(exact.working_set == nil and exact.penalty == nil)

for _, change in ipairs{ "one", "many" } do
  for _, reduced in ipairs{ true, false } do
    local s = dotyk.solver.active_set{ change = change, reduced = reduced }:solve(scene())
    check.that(s.converged and math.abs(s.energy - exact.energy) < 1e-10 * math.abs(exact.energy))
    local w = s.working_set
    -- It hangs in the air at rest: the first system is singular, and all five rows enter.
    check.that(w.singular >= 1 and w.survived == w.singular and w.added - w.dropped == 5 and w.repeats == 0)
    check.that(#s.history > 0 and s.history[#s.history].active == 5)
  end
end

local seen = 0
local stopped = dotyk.solver.active_set{ on_iteration = function() seen = seen + 1 return false end }:solve(scene())
check.that(not stopped.converged and seen == 1)

local s = dotyk.solver.interior_point{}:solve(scene())
check.that(s.converged and math.abs(s.energy - exact.energy) < 1e-7 * math.abs(exact.energy))

-- Iterations are those of the history, those of a second start go on counting, and the limit holds for all.
check.equal(#s.history, s.iterations)
for limit = 1, s.iterations - 1 do
  local last
  local few = dotyk.solver.interior_point{ max_iterations = limit, on_iteration = function(k) last = k end }:solve(scene())
  check.equal({ few.converged, few.iterations, #few.history, last }, { false, limit, limit, limit })
  local ended = dotyk.solver.interior_point{ on_iteration = function(k) return k < limit end }:solve(scene())
  check.equal({ ended.converged, ended.iterations, #ended.history }, { false, limit, limit })
end

local p = dotyk.solver.penalty{ factor = 1e4 }:solve(scene())
check.that(p.converged and p.penalty.factor == 1e4 and p.penalty.penetration > 0)
check.that(p.residual.penetration > 0 and p.reason:find "penetration up to")
check.that(math.abs(exact.energy - p.energy - p.penalty.energy) < 1e-3 * p.penalty.energy)

refused(function() dotyk.solver.activeset{} end, "did you mean 'active_set'")
refused(function() dotyk.solver.active_set{ change = "two" } end, "change", "one", "many")
refused(function() dotyk.solver.penalty{ factor = -1 } end, "'factor' must be a positive number")
