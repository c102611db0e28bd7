// Callables written in Lua, in lua/.
#include "script/bind/bind.hpp"
#include "script/bind/models/models.hpp"

namespace dotyk::script {
namespace {

void bind_source(Library& library) {
  library.function({.name = "source",
                    .help = "Prints the text of a function: a script's, one typed at the prompt, or one of dotyk's own that is written in Lua.",
                    .example = "source(dotyk.adapt)",
                    .arguments = {key::any("f", "a function").required()},
                    .in_lua = {"source", "run"}});
  library.function({.name = "include",
                    .help = "Runs a file of Lua and gives what it returns, as dofile does, but looks for it from the folder of the file that the call is in: "
                            "a script that includes others runs from every folder.",
                    .example = "print(pcall(include, \"lib/common.lua\"))",
                    .arguments = {key::string("file", "its name, from the folder of the script that includes it; at the prompt from the present one").required()},
                    .in_lua = {"init", "include"}});
}

std::vector<Key> adapt_keys() {
  const Key curve = key::table("", {key::string("part", "that the mesh brings").required(),
                                    key::function("map", "coordinates near the boundary to those on it").required()}, "");
  return {key::function("scene", "f(mesh, …), the refined meshes in the order given → scene, and what else is to be returned (contacts)").required(),
          key::either("mesh", {key::object<MeshHandle>("", ""), key::list("", key::object<MeshHandle>("", ""), "").some()},
                      "the mesh to begin with, or a list; triangles or tetrahedra (P1)").required(),
          key::positive("tol", "relative error in the energy norm to be reached, as estimated").fallback(0.05),
          key::number("share", "of the squared error, of the cells refined in a round (Dörfler); 1: all that err").above(0).within(0, 1).fallback(0.5),
          key::boolean("uniform", "refine all cells instead, to compare").fallback(false),
          key::integer("max_rounds", "solves, the first included").at_least(1).fallback(50.0),
          key::integer("max_unknowns", "no mesh with more displacement components is solved").at_least(1).fallback(200000.0),
          key::object<Solver>("method", "how to solve").otherwise("as dotyk.solve"),
          key::list("curved", curve, "boundaries that new nodes are moved onto").otherwise("none: new nodes stay on chords"),
          key::function("on_round", "f(k, entry of the history, solution, what the scene's function returned after the scene); false stops")};
}

void bind_adapt(Library& library) {
  library.function(
      {.name = "dotyk.adapt",
       .help = "Refines meshes where a solution errs, until the error estimate is small: solves, estimates (solution:error_estimate), bisects "
               "the fewest cells that have a share of the squared error (refinement:refine), and again, each solve starting from the "
               "contacts of the last. Returns the last solution; the history: for each round unknowns, cells, estimate (relative; nil, as absolute, where the solve has not converged), "
               "absolute, iterations and seconds (since the beginning), and in fields of its own converged (is the estimate at most tol) "
               "and reason; then what the scene's function returned after the last scene. Boundary parts that the mesh brings keep "
               "their names; a part chosen by a function is chosen again on every mesh, so let it end where it does on the first. "
               "Bodies in contact or glued must all have meshes of this list; their nodes go on matching.",
       .example = "local s, history, contact = dotyk.adapt{ tol = 0.2,\n"
                  "  mesh = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {8,4} },\n"
                  "  scene = function(mesh)\n"
                  "    local b = dotyk.body{ mesh = mesh, material = dotyk.material{ E = 1000, nu = 0.3 } }\n"
                  "    b:part \"bottom\":fix()\n    local scene = dotyk.scene{ b }\n"
                  "    local punch = dotyk.rigid.gap{ normal = {0,1}, gap = function(x) return x^2 - 0.02 end }\n"
                  "    return scene, scene:contact{ b:part \"top\", rigid = punch }\n  end }",
       .arguments = {key::table(adapt_keys())},
       .returns = "solution",
       .in_lua = {"adapt", "run"}});
}

std::vector<Key> work_precision_keys() {
  const Key named = key::table("", {key::string("name", "in table and legend").required(), key::object<Solver>("method", "which").required()}, "a method and its name");
  const Key level = key::integer("", "").at_least(1);
  return {key::function("scene", "level → scene, beam or plate, and what an error function is to get (contacts); finer for greater levels").required(),
          key::either("levels", {level, key::list("", level, "").some()}, "how many, from 1 on, or a list of them").otherwise("4"),
          key::list("methods", key::either("", {key::object<Solver>("", "a method"), named}, ""), "methods, or { name = , method = } for a name of one's own")
              .some().otherwise("those of pdas, newton, interior_point, uzawa_pdas that treat the scene"),
          key::list("tolerances", key::positive("", ""), "every method is run with each of these for its tol").some().otherwise("each method's own"),
          key::either("error", {key::choice("", {"energy", "displacement", "pressure", "peak_pressure"}, ""), key::function("", "")}, "what is measured").fallback("energy"),
          key::either("reference", {key::choice("", {"finest"}, ""), key::number("", ""), key::object<scene::Solution>("", ""), key::object<BeamResult>("", ""),
                                    key::object<plate::Solution>("", "")},
                      "finest: one level beyond the last, so that nothing is compared with itself; or the exact value; or a solution")
              .otherwise("\"finest\"; none for an error function"),
          key::integer("repeats", "runs of each; fewer where they would last longer than the budget").at_least(1).fallback(3.0),
          key::positive("budget", "a run that lasts longer is stopped, and its method goes no further up the levels").unit("s").fallback(30.0),
          key::file("file", "of the figure; ends in .png, .pdf or .svg").written().otherwise("no figure"),
          key::either("csv", {key::file("", "").written(), key::boolean("", "")}, "where the rows go as comma-separated values; false: nowhere").otherwise("beside the figure"),
          key::vector("slopes", "guides of these slopes").otherwise("none"),
          key::string("title", "above the figure").otherwise("none"),
          key::string("label", "what the error is, in the table and at the figure's axis").otherwise("after 'error'"),
          key::vector("size", "of the figure").unit("pixels").otherwise("{1000, 750}")};
}

void bind_work_precision(Library& library) {
  library.function(
      {.name = "dotyk.work_precision",
       .help = "Speed against accuracy: solves the scenes of a family by several methods, prints a table, draws error against "
               "seconds and returns the rows of the table (method, tol, level, unknowns, rows, iterations, status, error, seconds, "
               "low, high, runs, assembly, motions, ordering, factor, iterate, recover, front, reason; nil where there is none). Seconds are "
               "the median of the runs, low and high the least and the greatest, the parts those of the run that is the median. Runs of "
               "different methods take turns, so that what else the machine does meets all alike. Front: converged, and no row that "
               "is as fast is as near, up to a hundredth (Pareto). A method that refuses a scene, does not converge or spends its budget has rows "
               "that say so, and marks crossed out in the figure.\n"
               "Errors are relative. energy: |u − ū|_E/|ū|_E, ū the reference solution (see solution:distance); for beams, and where "
               "the reference is a number, from energies J (with given friction's): √|J − J̄| / √|J̄|, which bounds the norm, "
               "up to the factor √(|J̄|/½|ū|²_E), where u minimises J (not with Coulomb's friction). displacement: in L2 (beams and plates: of the "
               "deflection). pressure: in L2 over the contacts. peak_pressure: |max p/max p̄ − 1|. A function gets the solution and "
               "what the scene's function returned after the scene: without a reference it returns the error itself, with one a value "
               "to be compared with the number or with its value for the reference solution. The reference is one level finer than the "
               "last, solved by dotyk.solve: if errors halve per level, the last level's error is reported 13 % too small.",
       .example = "dotyk.work_precision{ levels = 3, methods = { dotyk.solver.pdas{}, dotyk.solver.interior_point{} }, scene = function(level)\n"
                  "  local b = dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = { 8 << level, 8 << level } },\n"
                  "    material = dotyk.material{ E = 1000, nu = 0.3 } }\n"
                  "  b:part \"left\":fix()\n  b:part \"top\":load{ 0, -10 }\n  local scene = dotyk.scene{ b }\n"
                  "  return scene, scene:contact{ b:part \"bottom\", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }\nend }",
       .arguments = {key::table(work_precision_keys())},
       .returns = "table",
       .in_lua = {"work_precision", "run"}});
}

void bind_dual(Library& library) {
  const Key x = key::any("x", "a number or a dual number").required();
  const auto add = [&](const std::string& name, const std::string& help, const std::string& numbers, std::vector<Key> arguments) {
    const std::string whole = "dotyk.dual." + name;
    library.function({.name = whole, .help = help, .example = "print(" + whole + numbers + ")", .arguments = std::move(arguments), .in_lua = {"dual", name}});
  };
  for (const auto& [name, what] : {std::pair{"sqrt", "square root"}, {"exp", "exponential"}, {"log", "natural logarithm"}, {"sin", "sine"}, {"cos", "cosine"},
                                   {"atan", "arc tangent"}, {"abs", "absolute value"}})
    add(name, text("The ", what, " of a number or of a dual number (a value and its gradient, see dotyk.shape), with its derivatives."), "(0.5)", {x});
  for (const auto& [name, what] : {std::pair{"max", "greater"}, {"min", "lesser"}})
    add(name, text("The ", what, " of two numbers or dual numbers; the first where they are equal."), "(0.5, 2)",
        {key::any("a", "a number or a dual number").required(), key::any("b", "another").required()});
  add("value", "The number itself, or the value of a dual number without its derivatives.", "(0.5)", {x});
}

}  // namespace

void bind_lua(Library& library) {
  bind_source(library);
  bind_adapt(library);
  bind_work_precision(library);
  bind_dual(library);
}

}  // namespace dotyk::script
