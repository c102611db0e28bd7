-- The part of dotyk written in Lua. Every file here is called with one table of
-- functions from C++ (described in src/script/lua_side.hpp) and returns its own.
-- Only what start-up needs is loaded here: the rest is loaded on first use.
local core <const> = ...

-- The functions of lua/<file>.lua, loaded when the first of them is called.
function core.lazily(file, name)
  return function(...)
    return core.load(file)[name](...)
  end
end

core.describe{
  name = "dotyk.adapt",
  help = "Refines meshes where a solution errs, until the error estimate is small: solves, estimates (solution:error_estimate), bisects "
    .. "the fewest cells that have a share of the squared error (refinement:refine), and again, each solve starting from the "
    .. "contacts of the last. Returns the last solution; the history: for each round unknowns, cells, estimate (relative), "
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

return core
