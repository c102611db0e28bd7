-- dotyk.adapt: meshes refined where the solution errs.
local core <const> = ...

local adapt = {}

local function total(meshes, count)
  local sum = 0
  for _, mesh in ipairs(meshes) do sum = sum + count(mesh) end
  return sum
end

local function cells(mesh) return mesh.cell_count end
local function components(mesh) return mesh.dimension * mesh.node_count end  -- those held included

local function build(o, meshes)
  local made <const> = table.pack(o.scene(table.unpack(meshes)))
  if core.type_name(made[1]) ~= "scene" then
    core.fail(("adapt: 'scene' must return a scene first, it returned %s"):format(core.type_name(made[1])))
  end
  return made
end

local function solve(o, scene, coarse)
  local options <const> = coarse and { start = coarse } or nil
  if o.method then return o.method:solve(scene, options) end
  return dotyk.solve(scene, options)
end

local function refine(o, refinement, s)
  if o.uniform then refinement:refine() else refinement:refine(s, o.share or 0.5) end
  for _, curve in ipairs(o.curved or {}) do refinement:project(curve.part, curve.map) end
end

-- Why the rounds end here; nil where they go on.
local function ended(o, entry, s, round)
  if not s.converged then return "the solve did not converge: " .. s.reason end
  if entry.estimate <= (o.tol or 0.05) then return "the estimate is at most tol", true end
  if round >= (o.max_rounds or 50) then return "max_rounds reached" end
end

function adapt.run(o)
  local begun <const> = core.clock()
  local refinement <const> = dotyk.refinement(core.type_name(o.mesh) == "mesh" and { o.mesh } or o.mesh)
  local history <const> = { converged = false }
  local last, of_last  -- the solution of the last whole round, and what its scene's function returned
  local function go_on(round)
    local meshes <const> = refinement.meshes
    local made <const> = build(o, meshes)
    local s <const> = solve(o, made[1], last)
    local relative, parts
    if s.converged then relative, parts = s:error_estimate() end
    local entry <const> = { unknowns = s.unknowns, cells = total(meshes, cells), estimate = relative, absolute = parts and parts.absolute,
                            iterations = s.iterations, seconds = core.clock() - begun }
    history[round], last, of_last = entry, s, made
    if core.terminal "stderr" then
      core.progress(("adapt: round %d, %d unknowns, estimated error %s, %.1f s"):format(round, s.unknowns, relative and ("%.3g"):format(relative) or "none", entry.seconds))
    end
    local goes_on <const> = not o.on_round or o.on_round(round, entry, s, table.unpack(made, 2, made.n)) ~= false
    history.reason, history.converged = ended(o, entry, s, round)
    history.converged = history.converged or false
    if not goes_on then history.reason = history.reason or "stopped by on_round" end
    if history.reason then return end
    refine(o, refinement, s)
    if total(refinement.meshes, components) > (o.max_unknowns or 200000) then history.reason = "max_unknowns reached" end
  end
  local function rounds()
    repeat go_on(#history + 1) until history.reason
  end
  local function kept()
    return last and ("the result is that of round %d, the last whole one; look at it or leave it"):format(#history)
  end
  if not core.unless_interrupted(rounds, kept) then history.reason = "interrupted; this is the last whole round" end
  core.progress()
  return last, history, table.unpack(of_last, 2, of_last.n)
end

return adapt
