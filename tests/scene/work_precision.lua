-- dotyk.work_precision on problems whose errors are known; its parts on made-up rows; what it refuses.
local check <const> = require "check"
local refused <const> = require "refused"

local said = {}
local real_print <const> = print
print = function(...) said[#said + 1] = table.concat({ ... }, "\t") end

-- 1. The pure parts, loaded from lua/.
local lua <const> = arg[0]:match "^(.*)/tests/" .. "/lua/"
local rows <const> = assert(loadfile(lua .. "work_precision_rows.lua"))({})
local report <const> = assert(loadfile(lua .. "work_precision_report.lua"))({ load = function() return rows end })

local function row(seconds, err, status) return { seconds = seconds, error = err, status = status or "converged", method = "m", level = 1 } end
do
  local fast, near, beaten, slow = row(1, 0.1), row(2, 0.01), row(3, 0.05), row(4, 0.001)
  local failed, refusal, tie, late = row(0.5, 0.001, "not converged"), row(nil, nil, "refused"), row(2, 0.5), row(5, 0.000995)
  local front <const> = rows.front{ late, slow, refusal, beaten, tie, near, failed, fast }
  check.equal(#front, 3)
  check.that(front[1] == fast and front[2] == near and front[3] == slow, "the front, by seconds; a gain below 1 % is none")
  check.equal(rows.front{}, {})
  check.equal(rows.front{ failed, refusal }, {})
end
do
  local runs <const> = { { seconds = 3 }, { seconds = 1 }, { seconds = 2 }, { seconds = 9 } }
  local middle <const>, low <const>, high <const> = rows.median(runs)
  check.equal({ middle.seconds, low, high }, { 2, 1, 9 })
  check.equal(runs[1].seconds, 3, "the runs keep their order")
end
check.equal(rows.names{ "solver pdas: rho = 1, reduced, tol = 1e-10", "solver pdas: rho = 1, full, tol = 1e-10", "solver psor, tol = 1" },
            { "pdas, reduced", "pdas, full", "psor" })
check.equal(rows.names{ "solver pdas: rho = 1", "solver pdas: rho = 1", { name = "mine" } }, { "pdas", "pdas (2)", "mine" })
check.equal(report.csv{ { method = 'a "b", c', level = 1, status = "refused", front = false, reason = "two\nlines" } },
  "method,tol,level,unknowns,rows,iterations,status,error,seconds,low,high,runs,assembly,motions,ordering,factor,iterate,recover,front,reason\n"
  .. '"a ""b"", c",,1,,,,refused,,,,,,,,,,,,false,"two\nlines"\n')

do
  local function timed(method, seconds, tol, status) return { method = method, seconds = seconds, tol = tol, level = 2, status = status or "converged" } end
  check.equal(report.verdict{ timed("a", 2), timed("b", 1), timed("c", 0.5, nil, "not converged") }, "on level 2 b is fastest; times as long: a 2")
  check.equal(report.verdict({ timed("a", 2, 1e-1), timed("a", 3, 1e-3), timed("b", 4, 1e-1), timed("b", 9, 1e-3) }, { 1e-3, 1e-1 }),
    "on level 2 to tol 1e-03 a is fastest; times as long: b 3")
  check.equal(report.verdict{ timed("a", 2) }, nil)
end

-- 2. Distances. A pressed block with nu = 0 has one strain: twice the load is twice everything.
local function pressed(load, n)
  local block = dotyk.body{ name = "block", material = dotyk.material{ E = 10, nu = 0 },
    mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {n,n} } }
  block:part "left":fix "x"
  block:part "top":load{ 0, -load }
  local scene = dotyk.scene{ block }
  return scene, scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }
end
do
  local one <const>, two <const> = dotyk.solve((pressed(1, 3))), dotyk.solve((pressed(2, 5)))
  local same <const>, far <const> = one:distance(one), two:distance(one)
  for _, what in ipairs{ "energy", "displacement", "pressure", "peak_pressure" } do
    check.near(same[what], 0, 1e-12, what)
    check.near(far[what], 1, 1e-9, what)
  end
end

-- Without contact Galerkin's orthogonality holds on nested meshes: |u_f - u_c|² = |u_f|² - |u_c|².
local function cantilever(level, load)
  local n <const> = 2 << level
  local body = dotyk.body{ name = "bar", material = dotyk.material{ E = 1000, nu = 0.3 },
    mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = { 2 * n, n }, element = "Q1" } }
  body:part "left":slide()
  body:part "bottom":slide()
  body:part "top":load(load or function(x) return 0, math.sin(math.pi * x / 2) end)
  return dotyk.scene{ body }
end
do
  local function linear(x) return 0, x end  -- integrated exactly on every mesh
  local coarse <const>, fine <const> = dotyk.solve(cantilever(1, linear)), dotyk.solve(cantilever(2, linear))
  local d <const> = coarse:distance(fine)
  check.near(d.energy, math.sqrt(1 - coarse.energy / fine.energy), 1e-8)
  check.that(d.pressure == nil and d.displacement < d.energy, "no contact, no pressure; L2 falls faster")
  refused(function() dotyk.solve((pressed(1, 2))):distance(fine) end, "another scene", "0 contacts, the solution 1")
  refused(function() fine:distance(3) end, "expected a solution")
end

-- 3. Orders. Q1: the energy norm falls as h, the displacement as h², for a smooth solution.
for what, order in pairs{ energy = 1, displacement = 2 } do
  local t <const> = dotyk.work_precision{ scene = cantilever, levels = { 2, 3, 4 }, error = what, repeats = 1, methods = { dotyk.solver.pdas{} },
    reference = dotyk.solve(cantilever(6)) }
  check.equal(#t, 3)
  for level = 2, 3 do
    check.near(math.log(t[level - 1].error / t[level].error, 2), order, 0.1, what)  -- seen: 0.99, 1.04; 1.98, 2.06
  end
end

-- 4. The rows, the file, the table.
do
  local seen = {}
  local t <const> = dotyk.work_precision{
    scene = function(level) seen[#seen + 1] = level; return pressed(1, 2 << level) end,
    levels = { 3, 1 }, tolerances = { 1e-3, 1e-8 }, repeats = 2, error = "peak_pressure", reference = 1,
    methods = { dotyk.solver.pdas{}, { name = "mine", method = dotyk.solver.uzawa{ max_iterations = 1 } } },
    file = "work_precision_test.png" }
  check.equal(seen, { 1, 3 }, "coarse first, no reference is solved for a number")
  check.equal(#t, 8)
  local front = 0
  for k, r in ipairs(t) do
    check.equal({ r.method, r.tol, r.level }, { (k - 1) % 4 < 2 and "pdas" or "mine", k % 2 == 1 and 1e-3 or 1e-8, k <= 4 and 1 or 3 })
    check.equal(r.runs, 2)
    check.that(r.low <= r.seconds and r.seconds <= r.high and r.assembly + r.ordering + r.factor + r.iterate + r.recover <= r.seconds)
    check.that(r.unknowns > 0 and r.rows > 0 and type(r.error) == "number")
    if r.method == "pdas" then check.near(r.error, 0, 1e-9) end
    if r.front then front = front + 1 end
  end
  check.that(front >= 1)
  local lines = {}
  for line in io.lines "work_precision_test.csv" do lines[#lines + 1] = line end
  check.equal(#lines, 9)
  local text <const> = table.concat(said, "\n")
  check.that(text:find("front: pdas on level", 1, true) and text:find("work_precision_test.png, work_precision_test.csv", 1, true), text)
  check.that(io.open "work_precision_test.png", "no figure")
end

-- A method that refuses, one that does not converge, one over its budget: rows that say so.
do
  local function rubbing(level)
    local block = dotyk.body{ name = "block", material = dotyk.material{ E = 10, nu = 0.3 },
      mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = { 4 * level, 4 * level } } }
    block:part "top":displace{ x = 0.1, y = -0.1 }
    local scene = dotyk.scene{ block }
    return scene, scene:contact{ block:part "bottom", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }, friction = dotyk.friction.coulomb(0.2) }
  end
  local t <const> = dotyk.work_precision{ scene = rubbing, levels = 2, repeats = 2,
    methods = { dotyk.solver.newton{}, dotyk.solver.pdas{}, dotyk.solver.uzawa{ max_iterations = 2 } }, file = "failures.png", csv = false }
  check.equal({ t[1].status, t[2].status, t[3].status }, { "converged", "refused", "not converged" })
  check.that(t[2].seconds == nil and t[2].error == nil and not t[2].front and #t[2].reason > 10, t[2].reason)
  check.that(t[3].seconds and t[3].error > t[1].error and not t[3].front and t[3].reason:find "no convergence", t[3].reason)
  check.that(not io.open "failures.csv")
  -- Without methods: those that apply.
  local names = {}
  for _, r in ipairs(dotyk.work_precision{ scene = rubbing, levels = 1, repeats = 1 }) do names[#names + 1] = r.method end
  check.equal(names, { "newton", "uzawa_pdas" })
  local slow <const> = dotyk.work_precision{ scene = rubbing, levels = 2, repeats = 2, budget = 1e-9, reference = -1,
    methods = { dotyk.solver.newton{} } }
  check.equal({ slow[1].status, slow[2].status }, { "stopped", "not run" })
  check.that(slow[2].reason:find("on level 1 lasted longer", 1, true), slow[2].reason)
end

-- A beam, by a function, by energies, and the deflection: order 2 and 4.
do
  local function beam(level)
    return dotyk.beam{ cells = 2 << level, load = function(x) return -math.exp(x) end,
      left = { deflection = dotyk.law.signorini() }, right = { deflection = dotyk.law.signorini() } }
  end
  for what, order in pairs{ energy = 2, displacement = 4 } do
    local t <const> = dotyk.work_precision{ scene = beam, levels = 3, error = what, repeats = 1, methods = { dotyk.solver.pdas{} } }
    check.near(math.log(t[1].error / t[2].error, 2), order, 0.15, what)
    for _, r in ipairs(t) do
      check.equal({ r.unknowns, r.rows }, { 2 * ((2 << r.level) + 1), 2 })
      check.that(r.assembly > 0 and r.assembly + r.ordering + r.factor + r.iterate + r.recover <= r.seconds)
    end
  end
  local t <const> = dotyk.work_precision{ scene = beam, levels = 1, repeats = 1, reference = 2, methods = { dotyk.solver.newton{} },
    error = function(s) return s:reaction("left").force / (math.exp(1) - 2) end }
  check.near(t[1].error, 0.5, 1e-9)
  refused(function() dotyk.work_precision{ scene = beam, error = "pressure", methods = { dotyk.solver.pdas{} } } end, "no contact", "energy, displacement")
  refused(function() dotyk.work_precision{ scene = cantilever, reference = dotyk.solve(beam(1)), methods = { dotyk.solver.pdas{} }, levels = 1 } end,
    "the reference is a beam_solution, the scene a scene")
end

-- A clamped plate, Morley's element: order 1 in the energy norm, 2 for the deflection. What the error is called.
do
  local function plate(level)
    local n <const> = 4 << level
    return dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {n,n} }, element = "morley", load = -1,
      edge = { deflection = dotyk.law.prescribed(0), rotation = dotyk.law.prescribed(0) } }
  end
  local reference <const> = dotyk.solve(plate(5))
  for what, order in pairs{ energy = 1, displacement = 2 } do
    local t <const> = dotyk.work_precision{ scene = plate, levels = 3, error = what, repeats = 1, methods = { dotyk.solver.pdas{} }, reference = reference,
      label = "how far the plate is off" }
    check.near(math.log(t[2].error / t[3].error, 2), order, 0.15, what)
    check.that(t[1].unknowns > 0 and t[1].assembly > 0)
  end
  check.that(table.concat(said, "\n"):find("error: how far the plate is off;", 1, true))
end

-- 5. What it refuses, at the script's line.
local pdas <const> = { dotyk.solver.pdas{} }
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, error = "enrgy" } end, '"energy"')
refused(function() dotyk.work_precision{ scene = cantilever, methods = {} } end, "methods")
refused(function() dotyk.work_precision{ scene = cantilever, methods = { "pdas" } } end, "methods")
refused(function() dotyk.work_precision{ methods = pdas } end, "scene")
refused(function() dotyk.work_precision{ scene = function() end, methods = pdas } end, "scene(1) returned nil", "a scene, a beam or a plate")
refused(function() dotyk.work_precision{ scene = function() return 3 end, methods = pdas } end, "scene(1) returned a number")
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 0 } end, "levels")
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 1, reference = 0 } end, "reference is 0")
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 1, reference = 1, error = "displacement" } end, "needs a solution")
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 1, error = "pressure" } end, "no error of pressure")
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 1, error = "peak_pressure", reference = 1 } end, "return scene, contact")
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 1, error = function() return "x" end } end, "returned x, expected a number")
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 1, reference = dotyk.solve((pressed(1, 2))) } end, "another scene")
refused(function() dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 1, repeats = 1, file = "none/a.png" } end, "none")
-- Said before hours of runs.
local function never() error "a run" end
for key, bad in pairs{ file = "none/a.png", csv = "none/a.csv", title = "\xff", label = "\xff" } do
  refused(function() dotyk.work_precision{ scene = never, methods = pdas, [key] = bad } end, key == "file" and "folder none" or key == "csv" and "folder none" or key .. "' is not valid UTF-8")
end
refused(function() dotyk.work_precision{ scene = never, methods = pdas, file = "a.gif" } end,
  "work_precision: cannot write a.gif: the file name must end in .png, .pdf or .svg")
refused(function() dotyk.work_precision{ scene = never, methods = pdas, title = ("x"):rep(1001) } end, "'title' has 1001 bytes")
-- The figure is what its name says; the rows lie beside it.
for ending, first in pairs{ pdf = "%PDF", svg = "<svg" } do
  dotyk.work_precision{ scene = cantilever, methods = pdas, levels = 2, repeats = 1, file = "figure." .. ending }
  local file <close> = assert(io.open("figure." .. ending))
  check.that(file:read(200):find(first, 1, true), ending)
  check.that(os.remove "figure.csv")
end

-- 6. The same method with another tol, and a limit on seconds.
do
  local rough <const> = dotyk.solver.uzawa{}:with{ tol = 1e-2 }
  check.near(rough.tol, 1e-2)
  check.equal(tostring(rough), tostring(dotyk.solver.uzawa{ tol = 1e-2 }))
  local scene <const> = pressed(1, 8)
  check.equal(rough:solve(scene).iterations, dotyk.solver.uzawa{ tol = 1e-2 }:solve(scene).iterations)
  local counted = 0
  dotyk.solver.uzawa{ on_iteration = function() counted = counted + 1 end }:with{ tol = 1e-1 }:solve(scene)
  check.that(counted > 0, "on_iteration is kept")
  check.that(rough:solve(scene, { seconds = 1e9 }).converged)
  refused(function() rough:solve(scene, { seconds = 0 }) end, "seconds")
  refused(function() rough:with{ tol = -1 } end, "tol")
end
print = real_print
