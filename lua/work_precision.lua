-- dotyk.work_precision: every method on every scene of a family, error against seconds.
local core <const> = ...
local rows <const> = core.load "work_precision_rows"
local report <const> = core.load "work_precision_report"

local work_precision = {}

-- 1. What is asked for.

-- The scene of a level, and what else its function returned.
local function scene_at(options, level)
  local made <const> = table.pack(options.scene(level))
  local kind <const> = core.type_name(made[1])
  if kind ~= "scene" and kind ~= "beam" and kind ~= "plate" then
    core.fail(("work_precision: scene(%d) returned %s, expected a scene, a beam or a plate"):format(level,
      made[1] == nil and "nil" or "a " .. kind))
  end
  return { level = level, scene = made[1], kind = kind, rest = table.pack(table.unpack(made, 2, made.n)) }
end

local function levels_of(options)
  local given <const>, list <const> = options.levels or 4, {}
  if type(given) == "number" then
    for level = 1, given do list[level] = level end
  else
    table.sort(table.move(given, 1, #given, 1, list))
  end
  return list
end

-- A solver, what to call it, and its tol: one entry for each tolerance.
local function runners_of(methods, tolerances)
  local texts, given, out = {}, {}, {}
  for k, entry in ipairs(methods) do
    local named <const> = type(entry) == "table"
    given[k] = named and entry.method or entry
    texts[k] = named and { name = entry.name } or tostring(given[k])
  end
  local names <const> = rows.names(texts)
  for k, solver in ipairs(given) do
    for _, tol in ipairs(tolerances or { solver.tol }) do
      out[#out + 1] = { method = names[k], tol = tol, solver = tolerances and solver:with{ tol = tol } or solver }
    end
  end
  return out
end

-- 2. One solve: the solution, or nil and why not; and its seconds.
local function refusal(message)
  return (tostring(message):gsub("^[^:\n]*:%d+: ", ""):gsub("^solve: ", ""))
end

local function solve(runner, at, budget)
  local started <const> = core.clock()
  local solved <const>, s <const> = pcall(runner.solver.solve, runner.solver, at.scene, at.kind == "scene" and { seconds = budget } or nil)
  local seconds <const> = core.clock() - started
  if solved then return s, nil, seconds end
  return nil, refusal(s), seconds
end

-- The methods that treat a scene, when the script names none.
local function default_methods(at, budget)
  local found, refused = {}, {}
  for _, name in ipairs{ "pdas", "newton", "interior_point", "uzawa_pdas" } do
    local solver <const> = dotyk.solver[name]{}
    local s <const>, why <const> = solve({ solver = solver }, at, budget)
    if s then found[#found + 1] = solver else refused[#refused + 1] = ("%s (%s)"):format(name, why) end
  end
  if #found == 0 then core.fail("work_precision: no method treats the scene: " .. table.concat(refused, "; ")) end
  if #refused > 0 then print("left out: " .. table.concat(refused, "; ")) end
  return found
end

-- 3. Errors.
local of_reference <const> = { solution = true, beam_solution = true, plate_solution = true }

-- What the errors are measured against: { number = } or { solution = , rest = }, or none.
local function reference_of(options, levels)
  local given <const> = options.reference or (type(options.error) ~= "function" and "finest" or nil)
  if given == nil then return {} end
  if type(given) == "number" then
    if given == 0 then core.fail "work_precision: the reference is 0; relative errors need another number" end
    if options.error == "displacement" or options.error == "pressure" then
      core.fail(("work_precision: the error of %s needs a solution as reference, got a number"):format(options.error))
    end
    return { number = given }
  end
  if of_reference[core.type_name(given)] then return { solution = given, rest = { n = 0 } } end
  local at <const> = scene_at(options, levels[#levels] + 1)
  core.progress(("work_precision: the reference, level %d"):format(at.level))
  local s <const> = dotyk.solve(at.scene)
  if not s.converged then core.fail("work_precision: the reference solution did not converge: " .. s.reason) end
  return { solution = s, rest = at.rest, level = at.level }
end

-- Of beams and plates friction is among the laws.
local function total_energy(s, kind) return kind ~= "scene" and s.energy or s.energy + s.friction_energy end

local function deflections_apart(s, reference, length)
  local apart, whole = 0, 0
  for i = 0, 200 do
    local x <const> = length * i / 200
    local u <const> = reference:deflection(x)
    apart, whole = apart + (s:deflection(x) - u)^2, whole + u^2
  end
  return math.sqrt(apart / whole)
end

local function peak_of(s, rest)
  local peak
  for k = 1, rest.n do
    if core.type_name(rest[k]) == "contact" then peak = math.max(peak or 0, s:contact(rest[k]).max_pressure) end
  end
  return peak or core.fail "work_precision: the peak pressure beside a number needs the contact: return scene, contact"
end

local function value_of(f, s, rest)
  local value <const> = f(s, table.unpack(rest, 1, rest.n))
  if math.type(value) == nil or value ~= value then
    core.fail(("work_precision: the error function returned %s, expected a number"):format(tostring(value)))
  end
  return value
end

local function by_function(f, s, at, reference)
  local value <const> = value_of(f, s, at.rest)
  if reference.number then return math.abs(value / reference.number - 1) end
  if not reference.solution then return math.abs(value) end
  reference.value = reference.value or value_of(f, reference.solution, reference.rest)
  return math.abs(value / reference.value - 1)
end

local function without_contact(kind, s, at, reference)
  if kind == "displacement" and at.kind == "beam" then return deflections_apart(s, reference.solution, at.scene.length) end
  if kind == "displacement" or kind == "energy" then return s:distance(reference.solution)[kind] end
  core.fail(("work_precision: a %s has no contact, so no error of %s; take energy, displacement or a function"):format(at.kind, kind))
end

-- The relative error of a solution.
local function error_of(kind, s, at, reference)
  if type(kind) == "function" then return by_function(kind, s, at, reference) end
  local exact <const> = reference.solution
  local expected <const> = at.kind == "scene" and "solution" or at.kind .. "_solution"
  if exact and core.type_name(exact) ~= expected then
    core.fail(("work_precision: the reference is a %s, the scene a %s"):format(core.type_name(exact), at.kind))
  end
  if kind == "energy" and (at.kind == "beam" or reference.number) then
    local J <const> = reference.number or total_energy(exact, at.kind)
    return math.sqrt(math.abs(total_energy(s, at.kind) / J - 1))
  end
  if at.kind ~= "scene" then return without_contact(kind, s, at, reference) end
  if reference.number then return math.abs(peak_of(s, at.rest) / reference.number - 1) end
  return s:distance(exact)[kind]
    or core.fail(("work_precision: nothing is pressed together in the reference, so there is no error of %s"):format(kind))
end

-- 4. The runs.

-- One run of a runner on a scene; notes it, and whether there is to be another one.
local function run_once(runner, at, options)
  local s <const>, why <const>, seconds <const> = solve(runner, at, options.budget)
  runner.spent = runner.spent + seconds
  if s then
    runner.runs[#runner.runs + 1] = { seconds = at.kind == "beam" and seconds or s.time.total, time = s.time } -- a beam's are of one branch
    runner.last = s
  end
  runner.stopped = seconds > options.budget
  runner.why = runner.stopped and ("it lasted longer than %g s"):format(options.budget) or why
  local typical <const> = runner.spent / math.max(1, #runner.runs)
  return s and not runner.stopped and runner.spent + typical <= options.budget
end

local function level_rows(at, runners, options, reference)
  for _, runner in ipairs(runners) do runner.runs, runner.spent, runner.last, runner.going = {}, 0, nil, not runner.over end
  for turn = 1, options.repeats do
    for _, runner in ipairs(runners) do
      if runner.going then
        core.progress(("work_precision: level %d, %s, run %d of %d"):format(at.level, runner.method, turn, options.repeats))
        runner.going = run_once(runner, at, options)
      end
    end
  end
  local out <const> = {}
  for k, runner in ipairs(runners) do
    local row <const> = rows.row(runner, at.level)
    local s <const> = runner.last
    if s then row.error = error_of(options.error, s, at, reference) end
    if s then row.unknowns, row.rows = s.unknowns, s.rows end
    if runner.stopped then runner.over = runner.over or ("a run on level %d lasted longer than %g s"):format(at.level, options.budget) end
    out[k] = row
  end
  return out
end

function work_precision.run(options)
  report.check(options)
  local levels <const> = levels_of(options)
  local first = scene_at(options, levels[1])
  local methods <const> = options.methods or default_methods(first, options.budget)
  local runners <const> = runners_of(methods, options.tolerances)
  local reference <const> = reference_of(options, levels)
  if not reference.solution then solve(runners[1], first, options.budget) end  -- nothing measured is the process's first solve
  local all <const> = {}
  local function run()
    for _, level in ipairs(levels) do
      local at <const> = first or scene_at(options, level)
      first = nil
      table.move(level_rows(at, runners, options, reference), 1, #runners, #all + 1, all)
      collectgarbage()
    end
  end
  local function kept()
    return #all > 0 and ("the rows are those of the levels up to %d%s"):format(all[#all].level,
      (options.file or options.csv) and "; they are written to no file" or "") or nil
  end
  local whole <const> = core.unless_interrupted(run, kept)
  core.progress()
  rows.mark_front(all)
  report.print(all, options, reference)
  if whole then report.write(all, options) end
  return all
end

return work_precision
