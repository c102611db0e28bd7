-- Random scenes, each solved by two methods and checked from nodal output: what does the program get wrong?
--
--   ./dotyk scripts/studies/random_scenes.lua [SEED] [COUNT] [show] [plain | contradictions]
--
-- COUNT scenes from the seeds SEED, SEED + 1, …: bodies in the plane and in space, of all elements, stacked and side by
-- side, touching, overlapping, glued or apart, held, sprung, supported by laws or free, of materials over eight orders;
-- thin ones, springs so weak that they hold nothing, two obstacles for one part, histories that unload, methods with
-- loose tolerances, conditions that contradict each other; some beams and plates. `plain`: without what is rare;
-- `contradictions`: these alone. Each is a script of its own, which `show` prints. It is solved by the method that its
-- plan names, and by an independent second one. Where a result is called converged this script checks signs, gaps,
-- complementarity, friction and laws at all nodes, the equilibrium of each body and of each node, with forces of an
-- assembly of its own, energies likewise, and that both methods find the same energy. Where a scene is refused it asks
-- an independent criterion of solvability (random_scenes/balance.lua). It prints counts by class, and each scene that is
-- not as it should be with its seed: SEED 1 runs that one again. Exit status 1 where anything is wrong.
--
-- Classes: solved (two methods agree), one method (no second one converges), several (Coulomb friction: two methods find
-- two states that are both right), beyond (greater strains or rotations than the equations are for, said), refused
-- (rightly; what friction cannot bear by trying all its combinations; also "not converged" where conditions contradict
-- each other, or where rounding hides what holds a body), undecided (refused; the criterion cannot tell, or the
-- combinations are too many), in doubt (no method converges, and Coulomb friction must bear loads that nothing else
-- balances: there may be no solution, while without such loads there is one whatever the coefficient, by Brouwer's
-- theorem on the bounds of friction), not converged; WRONG, REFUSED (it has a solution) and ERROR.

local first_seed <const>, count <const> = tonumber(arg[1]) or 1, tonumber(arg[2]) or 200
local asked <const> = {}
for k = 3, #arg do asked[arg[k]] = true end

local dice <const> = include "random_scenes/dice.lua"
local laws <const> = include "random_scenes/laws.lua"
local solids <const> = include "random_scenes/solids.lua"
local random_solids <const> = include "random_scenes/sides.lua"
local contradictions <const> = include "random_scenes/contradictions.lua"
local models <const> = include "random_scenes/beams_and_plates.lua"
local balance <const>, probe <const> = include "random_scenes/balance.lua", include "random_scenes/probe.lua"
local check_solids <const> = include "random_scenes/checks.lua"

io.stdout:setvbuf "line"

-- 1. A scene from its source. `held`: with springs on all bodies, which hold any scene.
local function run(lines) return assert(load(table.concat(lines, "\n"), "=scene"))() end

local function boundary_of(body) return body.disc and { "boundary" } or solids.geometry.side_names[#body.low - 1] end

local function make(scene, held)
  if not scene.dimension then return { scene = run(scene.lines) } end
  local lines, names = { table.unpack(scene.lines) }, { contacts = {}, supports = {}, bodies = {} }
  for k, contact in ipairs(scene.contacts) do names.contacts[k] = contact.name end
  for k, support in ipairs(scene.supports) do names.supports[k] = support.name end
  for k, body in ipairs(scene.bodies) do
    names.bodies[k] = body.name
    for _, side in ipairs(held and boundary_of(body) or {}) do
      local stiffness = body.E / scene.size
      table.insert(lines, ("%s:part%q:spring{ x = %g, y = %g%s }"):format(body.name, side, stiffness, stiffness,
        scene.dimension == 3 and (", z = %g"):format(stiffness) or ""))
    end
  end
  table.insert(lines, ("return { scene = scene, contacts = { %s }, supports = { %s }, bodies = { %s } }"):format(
    table.concat(names.contacts, ", "), table.concat(names.supports, ", "), table.concat(names.bodies, ", ")))
  local made = run(lines)
  if held then made.solution = dotyk.solve(made.scene) end
  return made
end

-- Much more seconds than a scene takes, also where others want the machine.
local function options_of(scene)
  if not scene.dimension then return nil end
  local steps = scene.steps and {}
  for k, factor in ipairs(scene.steps or {}) do steps[k] = { load = factor } end
  return { seconds = 600, steps = steps }
end

-- 2. Second methods, tried in a random order until one converges.
local frictionless <const> = { "interior_point", "active_set", "proximal", "psor", "projected_cg" }
local rubbing <const> = { "proximal", "psor", "coulomb_loop", "projected_cg" }

local function second_solution(scene, made)
  local names <const> = { table.unpack(scene.friction == "none" and frictionless or rubbing) }
  while #names > 0 do
    local name = table.remove(names, dice.whole(1, #names))
    local options = options_of(scene)
    local good, other = pcall(function() return dotyk.solver[name]{}:solve(made.scene, options) end)
    if good and other.converged then return other, name end
  end
end

-- Does a reason say which methods were tried?
local unnamed = 0
local function names_methods(reason)
  for _, list in ipairs{ frictionless, rubbing, { "newton", "pdas" } } do
    for _, name in ipairs(list) do if reason:find(name, 1, true) then return true end end
  end
  unnamed = unnamed + 1
  return false
end

-- Do rigid motions allow a solution? `without`: were there no "friction" at contacts, or no "weak" springs.
local function balanced(scene, without)
  if not scene.dimension then return balance.verdict(models.problem(scene)) end
  local function motion(b, mode) return balance.motion(scene, b, mode) end
  local probed <const> = scene.curved and probe(scene, run, boundary_of, motion, 3 * scene.dimension - 3)
  return balance.scene(scene, make(scene, true), probed, without)
end

-- Are loads borne by springs alone that are so weak that rounding hides them? Or, of a state that is given up because of
-- rounding, may one rounding error of the forces move what the weakest springs hold by more than a millionth, or is the
-- rounding of its inner forces, stiffness times displacement, more than a part of 1e-8 of the greatest force, `factor`
-- times that of the whole load?
local function lost_in_rounding(scene, made, s, factor)
  if scene.weakest and scene.weakest < 1e-9 and balanced(scene, "weak") ~= "solvable" then return true end
  if not s or not s.reason:find "rounding" then return false end
  if s.reason:find "that springs alone hold" then return scene.weakest and 1e-16 / scene.weakest > 1e-6 end
  local rounding <const>, force <const> = check_solids.rounding(scene, made, s)
  return rounding > 1e-8 * force * factor
end

-- Has a scene no solution though forces in the cones of friction would balance its loads? All combinations of open, stick and slip
-- are tried where they are few; else it is known of no method that solves it, and no more.
local function unbearable(scene, made, message)
  local other, name = second_solution(scene, made)
  if other then return "REFUSED", message .. ": " .. name .. " converges" end
  local tried, all, _, families = pcall(dotyk.all_solutions, made.scene)
  if not tried then return "undecided", message end
  if #all + #families == 0 then return "refused" end
  return "REFUSED", message .. ": all_solutions finds one"
end

-- 3. The class of a scene, and what there is to say about it.
local function refused(scene, message, made)
  message = message:gsub("^.-:%d+: ", "")
  -- Sides of bent bodies may lie beside each other.
  if message:find "do not face each other" and (scene.curved or scene.bent) then return "refused" end
  if message:find "no displacement can part them" then
    if contradictions.told(scene, message) then return "refused" end
    return "REFUSED", message
  end
  if message:find "as good as free" then
    if lost_in_rounding(scene) then return "refused" end
    return "REFUSED", message
  end
  if message:find "friction cannot bear" then return unbearable(scene, made, message) end
  if not (message:find "not held" or message:find "no solution" or message:find "nothing holds it") then return "ERROR", message end
  -- Nothing at all happens to a body that is free and not loaded: refused by custom, since it could be anywhere.
  local idle <const> = tonumber(message:match "^solve: 'b(%d+)' is not held: nothing stops its")
  if message:find "nothing loads it" or (idle and #scene.bodies[idle].loads == 0) then return "refused" end
  local verdict, left = balanced(scene)
  if verdict == "unsolvable" then return "refused" end
  message = ("%s (%.3g of the load left)"):format(message, left)
  return (verdict == "solvable" and not scene.inexact) and "REFUSED" or "undecided", message
end

local function energy(scene, s) return s.energy + (scene.dimension and s.friction_energy or 0) end

local function check(scene, made, s, method)
  local complaints, tol
  if not scene.dimension then complaints, tol = models.check(scene, s) end
  for k, step in ipairs(scene.dimension and s.steps or {}) do
    if complaints and #complaints > 0 then break end
    scene.factor = scene.steps and scene.steps[k] or 1
    complaints, tol = check_solids.check(scene, made, step, k > 1 and s.steps[k - 1] or nil)
  end
  if #complaints > 0 then return nil, ("%s: %s (%d in all)"):format(method, complaints[1], #complaints) end
  return tol
end

-- Have all steps converged? If not why, and which part of the load acted.
local function all_converged(scene, s)
  for k, step in ipairs(scene.steps and s.steps or {}) do
    local factor = scene.steps[k]
    if not step.converged then return false, ("step %d of %d (load %g): %s"):format(k, #scene.steps, factor, step.reason), math.abs(factor) end
  end
  return s.converged, s.reason, 1
end

-- Does a solution say that its strains, rotations or ways along a contact are far beyond what the equations are for? What is then moved by
-- wedges that close after many times their size is a solution of the equations, and of no use: it has to be said.
local function told_as_beyond(s)
  local all <const> = {}
  for _, step in ipairs(s.steps or { s }) do table.move(step.warnings, 1, #step.warnings, #all + 1, all) end
  for _, warning in ipairs(all) do
    local percent <const>, radians <const> = warning:match "strained by (%S+) %%", warning:match "turns by (%S+) radians"
    local sizes <const> = warning:match "slides by (%S+) times"
    if (tonumber(percent) or 0) > 100 or (tonumber(radians) or 0) > 1 or (tonumber(sizes) or 0) > 1 then return true end
  end
  return false
end

-- A method with a tolerance that a scene names: what it calls converged obeys all laws to twenty times that part of the
-- greatest force (its residuals are beside the norm of all).
local function check_loose(scene, made)
  local name <const>, tol <const> = table.unpack(scene.loose)
  local good, s = pcall(function() return dotyk.solver[name]{ tol = tol }:solve(made.scene, options_of(scene)) end)
  if not good or not s.converged then return end
  scene.accuracy = math.max(1e-6, 20 * tol)
  local _, wrong = check(scene, made, s, ("%s{ tol = %g }"):format(name, tol))
  scene.accuracy = nil
  return wrong
end

local slowest <const> = { seconds = 0 }

-- Conditions contradict each other: a refusal is right, and so is that nothing converges.
local function judge_impossible(made)
  local solved, s = pcall(dotyk.solve, made.scene)
  if not solved or not s.converged then return "refused" end
  return "WRONG", ("%s: converged, though conditions contradict each other"):format(s.method)
end

local function judge(scene)
  local good, made = pcall(make, scene)
  if not good and scene.impossible then return "refused" end
  if not good then return refused(scene, tostring(made)) end
  if scene.impossible then return judge_impossible(made) end
  local start <const> = os.clock()
  local solved, s = pcall(dotyk.solve, made.scene, options_of(scene))
  local seconds <const> = os.clock() - start
  if seconds > slowest.seconds then slowest.seconds, slowest.seed = seconds, scene.seed end
  if not solved then return refused(scene, tostring(s), made) end
  local converged, reason, factor = all_converged(scene, s)
  local other, name = second_solution(scene, made)
  if not converged then
    local text = ("%s: %s (%s)"):format(s.method, reason, name and name .. " converges" or "no second method converges")
    if scene.dimension and lost_in_rounding(scene, made, s, factor) then return "refused" end
    if not other and scene.coulomb and balanced(scene, "friction") ~= "solvable" then return "in doubt", text end
    return "not converged", names_methods(reason) and text or text .. ": THE REASON NAMES NO METHOD THAT WAS TRIED"
  end
  local tol, wrong = check(scene, made, s, s.method)
  if not tol and told_as_beyond(s) then return "beyond" end
  if not tol then return "WRONG", wrong end
  wrong = scene.loose and check_loose(scene, made)
  if wrong then return "WRONG", wrong end
  if not other then return "one method" end
  tol, wrong = check(scene, made, other, name)
  if not tol and told_as_beyond(other) then return "one method" end
  if not tol then return "WRONG", wrong end
  local a, b = energy(scene, s), energy(scene, other)
  if math.abs(a - b) <= 1e-6 * math.abs(a) + tol.energy then return "solved" end
  if told_as_beyond(s) then return "beyond" end
  return scene.coulomb and "several" or "WRONG", ("energies %.10g (%s) and %.10g (%s)"):format(a, s.method, b, name)
end

-- 4. All scenes, counted by class in each family.
local function random_scene(seed)
  dice.roll(seed)
  local family = dice.weighted{ "plane", 60, "space", 24, "beam", 8, "plate", 8 }
  local solid <const> = family == "plane" or family == "space" or asked.contradictions
  if not solid then return models[family](), family .. "s" end
  if asked.contradictions or (not asked.plain and dice.chance(0.05)) then
    local scene = contradictions.random(family == "space" and 3 or 2)
    return scene, ("%s, %s"):format(family == "space" and "space" or "plane", scene.coulomb and "Coulomb friction" or "no friction")
  end
  local scene = random_solids(family == "plane" and 2 or 3, not asked.plain)
  local kinds = { none = "no friction", tresca = "given friction", coulomb = scene.coulomb and "Coulomb friction" or "no friction" }
  return scene, ("%s, %s"):format(family, kinds[scene.friction])
end

local classes <const> = { "solved", "one method", "several", "beyond", "refused", "undecided", "in doubt", "not converged", "WRONG", "REFUSED", "ERROR" }
local families <const> = { "plane, no friction", "plane, given friction", "plane, Coulomb friction", "space, no friction",
                           "space, given friction", "space, Coulomb friction", "beams", "plates", "all" }
local counts <const> = {}
for _, family in ipairs(families) do
  counts[family] = { all = 0 }
  for _, class in ipairs(classes) do counts[family][class] = 0 end
end

for seed = first_seed, first_seed + count - 1 do
  local scene, family = random_scene(seed)
  if asked.show then print(table.concat(scene.lines, "\n")) end
  if asked.show and scene.steps then print("-- loads of the steps: " .. table.concat(scene.steps, ", ")) end
  scene.seed = seed
  if scene.wide and dice.chance(0.1) then
    local names <const> = scene.friction == "none" and frictionless or rubbing
    scene.loose = { dice.pick{ "newton", "uzawa", table.unpack(names) }, 10.0 ^ -dice.whole(1, 4) }
  end
  local class, text = judge(scene)
  for _, f in ipairs{ family, "all" } do
    counts[f][class], counts[f].all = counts[f][class] + 1, counts[f].all + 1
  end
  if text then
    local what = { family }
    for _, name in ipairs{ "thin", "weakest" } do
      if scene[name] then table.insert(what, ("%s %.2g"):format(name, scene[name])) end
    end
    if scene.contrast == 4 then table.insert(what, "contrast") end
    if scene.impossible ~= nil then table.insert(what, scene.impossible and "impossible" or "just possible") end
    if scene.steps then table.insert(what, "steps") end
    print(("seed %d (%s): %s: %s"):format(seed, table.concat(what, ", "), class, text))
  end
end

local function line(name, of)
  local text = ("%-26s %6s"):format(name, of.all)
  for _, class in ipairs(classes) do text = text .. (" %" .. math.max(#class, 6) .. "s"):format(of[class]) end
  print(text)
end
local heading <const> = { all = "all" }
for _, class in ipairs(classes) do heading[class] = class end
line("scenes", heading)
for _, family in ipairs(families) do line(family, counts[family]) end

-- 5. The verdict. Without Coulomb friction the energy is convex: all must be solved or refused; with it at most 0.5 %
-- may be given up, and none may take longer than 20 seconds of the processor.
local all <const> = counts.all
local wrong <const> = all.WRONG + all.ERROR
local coulomb, given_up = 0, 0
for _, family in ipairs{ "plane, Coulomb friction", "space, Coulomb friction" } do
  coulomb, given_up = coulomb + counts[family].all, given_up + counts[family]["not converged"] + counts[family]["in doubt"]
end
local convex <const> = all["not converged"] + all["in doubt"] - given_up
local good <const> = wrong + all.REFUSED + convex + unnamed == 0 and given_up <= math.max(1, 0.005 * coulomb)
  and slowest.seconds <= 20
print(("%d scenes: %d solved, %d beyond small strains, %d refused rightly, %d not decided, %d refused wrongly, %d wrong or errors"):format(
  all.all, all.solved + all["one method"] + all.several, all.beyond, all.refused, all.undecided, all.REFUSED, wrong))
print(("%d convex ones not converged, %d of %d with Coulomb friction, %d without naming what was tried; seed %d took %.3g s"):format(
  convex, given_up, coulomb, unnamed, slowest.seed or 0, slowest.seconds))
print(good and "all as it should be" or "not as it should be")
if not good then os.exit(1) end
