-- The part of dotyk written in Lua. Every file here is called with one table of
-- functions from C++ (described in src/script/bridge/lua_side.hpp) and returns its own.
-- Only what start-up needs is loaded here: the rest is loaded on first use.
local core <const> = ...

-- The functions of lua/<file>.lua, loaded when the first of them is called.
local place_of <const> = setmetatable({}, { __mode = "k" })
function core.lazily(file, name)
  local function later(...) return core.load(file)[name](...) end
  place_of[later] = { file = file, name = name }
  return later
end

-- Callable → where it is written: file and name there.
core.written_in_lua = {}
local describe <const> = core.describe
function core.describe(t)
  core.written_in_lua[t.name] = place_of[t.run]
  return describe(t)
end

core.describe{
  name = "source",
  help = "Prints the text of a function: a script's, one typed at the prompt, or one of dotyk's own that is written in Lua.",
  example = "source(dotyk.adapt)",
  arguments = { { name = "f", kind = "any", required = true, help = "a function" } },
  run = core.lazily("source", "run") }

local getinfo <const> = debug.getinfo
core.describe{
  name = "include",
  help = "Runs a file of Lua and gives what it returns, as dofile does, but looks for it from the folder of the file that the call is in: "
    .. "a script that includes others runs from every folder.",
  example = "print(pcall(include, \"lib/common.lua\"))",
  arguments = { { name = "file", kind = "string", required = true, help = "its name, from the folder of the script that includes it; at the prompt from the present one" } },
  run = function(file)
    local level, from = 2, getinfo(2, "S")
    while from and from.what == "C" do
      level = level + 1
      from = getinfo(level, "S")
    end
    local folder <const> = not file:find "^/" and from and from.source:match "^@(.*/)"
    local chunk <const>, why = loadfile((folder or "") .. file, "t")
    if not chunk then core.fail(why) end
    return chunk()
  end }

core.describe{
  name = "dotyk.adapt",
  help = "Refines meshes where a solution errs, until the error estimate is small: solves, estimates (solution:error_estimate), bisects "
    .. "the fewest cells that have a share of the squared error (refinement:refine), and again, each solve starting from the "
    .. "contacts of the last. Returns the last solution; the history: for each round unknowns, cells, estimate (relative; nil, as absolute, where the solve has not converged), "
    .. "absolute, iterations and seconds (since the beginning), and in fields of its own converged (is the estimate at most tol) "
    .. "and reason; then what the scene's function returned after the last scene. Boundary parts that the mesh brings keep "
    .. "their names; a part chosen by a function is chosen again on every mesh, so let it end where it does on the first. "
    .. "Bodies in contact or glued must all have meshes of this list; their nodes go on matching.",
  example = "local s, history, contact = dotyk.adapt{ tol = 0.2,\n"
    .. "  mesh = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {8,4} },\n"
    .. "  scene = function(mesh)\n"
    .. "    local b = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 } }\n"
    .. "    b:part \"bottom\":fix()\n    local scene = dotyk.scene{ b }\n"
    .. "    local punch = dotyk.rigid.gap{ normal = {0,1}, gap = function(x) return x^2 - 0.02 end }\n"
    .. "    return scene, scene:contact{ b:part \"top\", rigid = punch }\n  end }",
  returns = "solution",
  keys = {
    { name = "scene", kind = "function", required = true,
      help = "f(mesh, …), the refined meshes in the order given → scene, and what else is to be returned (contacts)" },
    { name = "mesh", kind = "either", required = true, help = "the mesh to begin with, or a list; triangles or tetrahedra (P1)",
      keys = { { kind = "object", type = "mesh" }, { kind = "list", item = { kind = "object", type = "mesh" }, fewest = 1 } } },
    { name = "tol", kind = "number", above = 0, default = 0.05, help = "relative error in the energy norm to be reached, as estimated" },
    { name = "share", kind = "number", above = 0, at_most = 1, default = 0.5, help = "of the squared error, of the cells refined in a round (Dörfler); 1: all that err" },
    { name = "uniform", kind = "boolean", default = false, help = "refine all cells instead, to compare" },
    { name = "max_rounds", kind = "integer", at_least = 1, default = 50, help = "solves, the first included" },
    { name = "max_unknowns", kind = "integer", at_least = 1, default = 200000, help = "no mesh with more displacement components is solved" },
    { name = "method", kind = "object", type = "solver", otherwise = "as dotyk.solve", help = "how to solve" },
    { name = "curved", kind = "list", otherwise = "none: new nodes stay on chords", help = "boundaries that new nodes are moved onto",
      item = { kind = "table", keys = {
        { name = "part", kind = "string", required = true, help = "that the mesh brings" },
        { name = "map", kind = "function", required = true, help = "coordinates near the boundary to those on it" } } } },
    { name = "on_round", kind = "function", help = "f(k, entry of the history, solution, what the scene's function returned after the scene); false stops" } },
  run = core.lazily("adapt", "run") }

core.describe{
  name = "dotyk.work_precision",
  help = "Speed against accuracy: solves the scenes of a family by several methods, prints a table, draws error against "
    .. "seconds and returns the rows of the table (method, tol, level, unknowns, rows, iterations, status, error, seconds, "
    .. "low, high, runs, assembly, motions, ordering, factor, iterate, recover, front, reason; nil where there is none). Seconds are "
    .. "the median of the runs, low and high the least and the greatest, the parts those of the run that is the median. Runs of "
    .. "different methods take turns, so that what else the machine does meets all alike. Front: converged, and no row that "
    .. "is as fast is as near, up to a hundredth (Pareto). A method that refuses a scene, does not converge or spends its budget has rows "
    .. "that say so, and marks crossed out in the figure.\n"
    .. "Errors are relative. energy: |u − ū|_E/|ū|_E, ū the reference solution (see solution:distance); for beams, and where "
    .. "the reference is a number, from energies J (with given friction's): √|J − J̄| / √|J̄|, which bounds the norm, "
    .. "up to the factor √(|J̄|/½|ū|²_E), where u minimises J (not with Coulomb's friction). displacement: in L2 (beams and plates: of the "
    .. "deflection). pressure: in L2 over the contacts. peak_pressure: |max p/max p̄ − 1|. A function gets the solution and "
    .. "what the scene's function returned after the scene: without a reference it returns the error itself, with one a value "
    .. "to be compared with the number or with its value for the reference solution. The finest reference is one level beyond the "
    .. "last, solved by dotyk.solve: where the error halves with each level, that of the last is shown 13 % too small.",
  example = "dotyk.work_precision{ levels = 3, methods = { dotyk.solver.pdas{}, dotyk.solver.interior_point{} }, scene = function(level)\n"
    .. "  local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = { 8 << level, 8 << level } },\n"
    .. "    material = dotyk.material{ E = 1000, nu = 0.3 } }\n"
    .. "  b:part \"left\":fix()\n  b:part \"top\":load{ 0, -10 }\n  local scene = dotyk.scene{ b }\n"
    .. "  return scene, scene:contact{ b:part \"bottom\", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }\nend }",
  returns = "table",
  keys = {
    { name = "scene", kind = "function", required = true,
      help = "level → scene, beam or plate, and what an error function is to get (contacts); finer for greater levels" },
    { name = "levels", kind = "either", otherwise = "4", help = "how many, from 1 on, or a list of them",
      keys = { { kind = "integer", at_least = 1 },
               { kind = "list", item = { kind = "integer", at_least = 1 }, fewest = 1 } } },
    { name = "methods", kind = "list", fewest = 1,
      otherwise = "those of pdas, newton, interior_point, uzawa_pdas that treat the scene",
      help = "methods, or { name = , method = } for a name of one's own",
      item = { kind = "either", keys = {
        { kind = "object", type = "solver", help = "a method" },
        { kind = "table", help = "a method and its name", keys = { { name = "name", kind = "string", required = true, help = "in table and legend" },
                                   { name = "method", kind = "object", type = "solver", required = true, help = "which" } } } } } },
    { name = "tolerances", kind = "list", fewest = 1, item = { kind = "number", above = 0 }, otherwise = "each method's own",
      help = "every method is run with each of these for its tol" },
    { name = "error", kind = "either", default = "energy", help = "what is measured",
      keys = { { kind = "choice", choices = { "energy", "displacement", "pressure", "peak_pressure" } }, { kind = "function" } } },
    { name = "reference", kind = "either", otherwise = "\"finest\"; none for an error function",
      help = "finest: one level beyond the last, so that nothing is compared with itself; or the exact value; or a solution",
      keys = { { kind = "choice", choices = { "finest" } }, { kind = "number" }, { kind = "object", type = "solution" },
               { kind = "object", type = "beam_solution" }, { kind = "object", type = "plate_solution" } } },
    { name = "repeats", kind = "integer", at_least = 1, default = 3, help = "runs of each; fewer where they would last longer than the budget" },
    { name = "budget", kind = "number", above = 0, default = 30, unit = "s",
      help = "a run that lasts longer is stopped, and its method goes no further up the levels" },
    { name = "file", kind = "file", written = true, otherwise = "no figure", help = "of the figure; ends in .png" },
    { name = "csv", kind = "either", otherwise = "beside the figure", help = "where the rows go as comma-separated values; false: nowhere",
      keys = { { kind = "file", written = true }, { kind = "boolean" } } },
    { name = "slopes", kind = "vector", otherwise = "none", help = "guides of these slopes" },
    { name = "title", kind = "string", otherwise = "none", help = "above the figure" },
    { name = "label", kind = "string", otherwise = "after 'error'", help = "what the error is, in the table and at the figure's axis" },
    { name = "size", kind = "vector", otherwise = "{1000, 750}", help = "of the figure", unit = "pixels" },
  },
  run = core.lazily("work_precision", "run"),
}

for _, f in ipairs{ { "sqrt", "The square root" }, { "exp", "The exponential" }, { "log", "The natural logarithm" }, { "sin", "The sine" },
                    { "cos", "The cosine" }, { "atan", "The arc tangent" }, { "abs", "The absolute value" } } do
  core.describe{
    name = "dotyk.dual." .. f[1],
    help = f[2] .. " of a number or of a dual number (a value and its gradient, see dotyk.shape), with its derivatives.",
    example = ("print(dotyk.dual.%s(0.5))"):format(f[1]),
    arguments = { { name = "x", kind = "any", required = true, help = "a number or a dual number" } },
    run = core.lazily("dual", f[1]) }
end
for _, f in ipairs{ { "max", "greater" }, { "min", "lesser" } } do
  core.describe{
    name = "dotyk.dual." .. f[1],
    help = ("The %s of two numbers or dual numbers; the first where they are equal."):format(f[2]),
    example = ("print(dotyk.dual.%s(0.5, 2))"):format(f[1]),
    arguments = { { name = "a", kind = "any", required = true, help = "a number or a dual number" },
                  { name = "b", kind = "any", required = true, help = "another" } },
    run = core.lazily("dual", f[1]) }
end
core.describe{
  name = "dotyk.dual.value",
  help = "The number itself, or the value of a dual number without its derivatives.",
  example = "print(dotyk.dual.value(0.5))",
  arguments = { { name = "x", kind = "any", required = true, help = "a number or a dual number" } },
  run = core.lazily("dual", "value") }

return core
