#include "multigrid/multigrid.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/scene/space.hpp"
#include "script/help/nearest.hpp"

namespace dotyk::script {
namespace {

using scene::Scene;
using scene::Solution;

void require_case(const scene::Scene& scene, const std::string& name) {
  const auto known = load_cases(scene);
  const std::string near = nearest(name, known);
  if (!near.empty() && std::find(known.begin(), known.end(), name) == known.end())
    throw InputError(text("'load': no load case '", name, "', did you mean '", near, "'?"));
}

/// load = factor, or load = { case = factor, … }.
void read_load(const Arguments& given, const scene::Scene& scene, scene::Step& step) {
  lua_State* L = given.state();
  const int at = given.slot("load");
  if (lua_type(L, at) == LUA_TNUMBER) {
    step.all = lua_tonumber(L, at);
    return;
  }
  for (lua_pushnil(L); lua_next(L, at); lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING)
      throw InputError("'load' must be a factor, or a table of factors by the names of load cases: { shear = 0.5 }");
    const std::string name = lua_tostring(L, -2);
    if (lua_type(L, -1) != LUA_TNUMBER || !std::isfinite(lua_tonumber(L, -1)))
      throw InputError(text("'load': the factor of '", name, "' must be a finite number"));
    require_case(scene, name);
    step.factor[name] = lua_tonumber(L, -1);
  }
}

/// move = { [contact] = { dx, dy }, … }.
void read_move(const Arguments& given, const scene::Scene& scene, scene::Step& step) {
  lua_State* L = given.state();
  for (lua_pushnil(L); lua_next(L, given.slot("move")); lua_pop(L, 1)) {
    if (!object_at(L, -2, Wrapped<scene::Contact>::name))
      throw InputError("'move' must be a table of displacements by contact: { [contact] = { 0.1, 0 } }");
    const int value = lua_gettop(L);
    bool numbers = lua_type(L, value) == LUA_TTABLE;
    const auto number = [&](int at) {
      numbers = numbers && lua_type(L, at) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, at));
      return lua_tonumber(L, at);
    };
    const auto by = numbers ? read_list(L, value, number) : std::vector<double>();
    if (!numbers || static_cast<int>(by.size()) != scene.dimension())
      throw InputError(text("'move': the displacement of a contact's rigid shape must be a table of ", scene.dimension(), " finite numbers"));
    step.move.emplace_back(object<scene::Contact>(L, value - 1), point_of(by));
  }
}

Key steps_key() {
  return key::list(
      "steps",
      key::table("",
                 {key::either("load", {key::number("", ""), key::any("", "")},
                              "a factor on every load and prescribed displacement, or factors by load case, "
                              "{ shear = 0.5 } (part:load({ 4, 0 }, \"shear\")); those of the step before, at first 1, stay "
                              "where none is given"),
                  key::any("move", "displacements of rigid shapes by contact, { [contact] = { 0.1, 0 } }, from where they "
                           "were at rest and small: normals stay; those of the step before stay where none is given")},
                 ""),
      "a quasi-static history: tables with load and move, one a step");
}

std::vector<scene::Step> read_steps(const Arguments& options, const scene::Scene& scene) {
  std::vector<scene::Step> steps;
  for (const Arguments& given : options.tables("steps")) {
    scene::Step step;
    try {
      for (const char* key : {"load", "move"})
        if (given.has(key) && !given.is(key, LUA_TTABLE) && !(key[0] == 'l' && given.is(key, LUA_TNUMBER)))
          throw InputError(text("'", key, "' must be a table", key[0] == 'l' ? " or a number" : ""));
      if (given.has("load")) read_load(given, scene, step);
      if (given.has("move")) read_move(given, scene, step);
    } catch (const InputError& error) {
      throw InputError(text("step ", steps.size() + 1, ": ", error.what()));
    }
    steps.push_back(std::move(step));
  }
  if (steps.empty()) throw InputError("'steps' is empty; give at least one step, {} for all loads at once");
  return steps;
}

Key start_key() {
  return key::either("start",
                     {key::object<Solution>("", "a solution of a like scene, usually on a coarser mesh"),
                      key::list("", key::integer("", ""), "numbers of the rows (contact nodes, in order) that start closed")},
                     "where to start: a solution. Where it has the same meshes and contacts, multigrid, pdas on all unknowns and the methods on the contact boundary "
                     "take over its state, on all unknowns relaxed near the rows that bear; otherwise pdas, newton and active_set take over the contact status of "
                     "nearest nodes; or a list of the closed rows");
}

int count_rows(const Scene& scene) {
  std::size_t rows = 0;
  for (const auto& contact : scene.contacts)
    rows += contact->kind == scene::Contact::Kind::contact ? contact->rows.size() : 0;
  return static_cast<int>(rows);
}

void read_start(const Arguments& options, const Scene& scene, scene::Start& start) {
  if (options.has("after")) start.after = options.object<Solution>("after");
  if (options.holds<Solution>("start")) {
    start.coarse = options.object<Solution>("start");
  } else if (options.has("start")) {
    start.closed.emplace();
    for (const long long row : options.integers("start")) {
      if (row < 1 || row > count_rows(scene)) throw InputError(text("start names row ", row, "; the scene has rows 1 to ", count_rows(scene)));
      start.closed->push_back(static_cast<int>(row - 1));
    }
  }
}

std::shared_ptr<Solution> solve_scene(const Call& call, const solver::Method& method, Watch& watch) {
  const auto scene = call.object<Scene>("scene");
  scene::Start start;
  std::vector<scene::Step> steps;
  if (call.has("options")) {
    const Arguments options = call.table("options");
    if (options.has("steps")) steps = read_steps(options, *scene);
    read_start(options, *scene, start);
    if (options.has("seconds")) watch.limit(options.number("seconds"));
  }
  return scene::solve(scene, method, start, watch, steps);
}

/// Solves and answers Ctrl-C.
int solve_any(Call& call, const solver::Method& method, std::vector<Function> on_iteration, bool verbose) {
  if (call.has("options") && !call.holds<Scene>("scene")) throw InputError("options are for scenes; other problems take none");
  Watch watch(call.state(), "solving", std::move(on_iteration), verbose);
  const auto give = [&](const auto& solution, const solver::Result& result, const char* advice = "look at it or leave it") {
    watch.judge(result);
    watch.answer(advice);
    return call.give(solution);
  };
  if (call.holds<fclib::ContactProblem>("scene")) {
    const auto result = solve_contact_problem(call.object<fclib::ContactProblem>("scene"), method, watch);
    return give(result, result->result.iteration);
  }
  if (call.holds<plate::Model>("scene")) {
    const auto solution = plate::solve(call.object<plate::Model>("scene"), method, watch);
    return give(solution, solution->result());
  }
  if (call.holds<beam::Beam>("scene")) {
    const auto result = std::make_shared<BeamResult>(BeamResult{beam::solve(*call.object<beam::Beam>("scene"), method, watch)});
    return give(result, result->solution().result());
  }
  const auto solution = solve_scene(call, method, watch);
  return give(solution, solution->result(),
              method.begins_anew() ? "look at it or leave it (this method begins anew, whatever start says)"
                                   : "look at it, go on from it (start = that result), or leave it");
}

Given<Solver> with_tol(Call& call) {
  auto other = std::make_shared<Solver>(*call.self<Solver>());
  other->tol = call.number("tol");
  other->method = other->method.with_tol(other->tol);
  const int kept = call.kept(1, "on_iteration");
  const auto given = call.give_keeping(other, {});
  if (kept) call.keep(lua_gettop(call.state()), "on_iteration", kept);
  return given;
}

// The result knows the method and its options.
int solve_and_tell(Call& call) {
  const auto solver = call.self<Solver>();
  const int results = solve_any(call, solver->method, call.kept_function(1, "on_iteration"), solver->verbose);
  call.keep(lua_gettop(call.state()), "solver", 1);
  return results;
}

constexpr const char* kSteps =
    "With steps, quasi-statically one load after the other: friction opposes the slip since the last step, and all "
    "steps share one factorisation. The result is the last step; all of them are in s.steps.";

std::vector<Key> solve_keys(bool from_files) {
  std::vector<Key> kinds = {key::object<Scene>("", "a scene"), key::object<beam::Beam>("", "a beam"), key::object<plate::Model>("", "a plate")};
  if (from_files) kinds.push_back(key::object<fclib::ContactProblem>("", "a problem from a file"));
  return {key::either("scene", std::move(kinds), from_files ? "what to solve: a scene, a beam, a plate, or a problem that dotyk.fclib read"
                                                            : "what to solve: a scene, a beam or a plate").required(),
          key::table("options",
                     {start_key(), steps_key(),
                      key::object<Solution>("after", "the solution that this one follows in a quasi-static history: slip is "
                                            "measured from it, its factors and moves go on; of the same meshes, contacts "
                                            "and friction, on this scene or one like it"),
                      key::positive("seconds", "stop at the first iteration after so long, with the state so far (converged is "
                                    "false); an error where there is none yet").unit("s").otherwise("no limit")},
                     "start, steps, after, seconds")};
}

int all_solutions(Call& call) {
  Watch watch(call.state(), "enumerating");
  const scene::AllSolutions all = scene::all_solutions(call.object<scene::Scene>("scene"), watch);
  watch.answer();
  std::vector<Record> families;
  for (const scene::AllSolutions::Family& family : all.families) {
    std::vector<double> ends;
    for (const int end : family.ends) ends.push_back(end + 1);
    families.push_back({"family", {{"dimension", family.dimension}, {"ends", ends}, {"unbounded", family.unbounded},
                                   {"forces_only", family.forces_only}, {"continuum", family.continuum + 1}}});
  }
  return call.give(all.solutions, all.summary, families);
}

void bind_all_solutions(Library& library) {
  library.function(
      {.name = "dotyk.all_solutions",
       .help = "Every solution of a plane scene with few contact nodes, found by trying each combination of open, "
               "stick and slip to either side, up to 2^20 of them (ten nodes with Coulomb friction): a list of "
               "solutions, empty where there is none, and what was tried in words. With a great coefficient of "
               "friction there may be several, or a continuum; a method finds at most one of them. Third, a list of families, mostly "
               "empty: a family is all convex combinations of its ends, which follow the isolated solutions in the "
               "list. Fields: dimension, ends (their places in the list), unbounded (there is no end in some direction), forces_only "
               "(displacements are the same), continuum (families that meet have the same number).",
       .setup = setup::few_nodes(),
       .example = "local all, tried = dotyk.all_solutions(scene)\nprint(#all, tried)\n"
                  "for k, s in ipairs(all) do print(k, s.energy, s.reason) end\n"
                  "local _, _, families = dotyk.all_solutions(scene)\n"
                  "for _, f in ipairs(families) do print(f.dimension, all[f.ends[1]].energy) end",
       .arguments = {key::object<scene::Scene>("scene", "what to solve").required()},
       .run = all_solutions});
}

}  // namespace

void bind_solver(Library& library) {
  library.module("dotyk.solver", "Methods. Each is made with its options and then solves scenes.");
  bind_methods(library);
  library.function({.name = "dotyk.solve",
                    .help = std::string("Solves a scene, beam or plate. The method is the one that scene:plan() names; without contact it is one linear solve. ") + kSteps,
                    .setup = setup::pressed_block(),
                    .example = "local s = dotyk.solve(scene)\nlocal again = dotyk.solve(scene, { start = s })\n"
                               "local h = dotyk.solve(scene, { steps = { { load = 0.5 }, { load = 1 } } })\nprint(s)",
                    .arguments = solve_keys(false),
                    .returns = "solution",
                    .run = [](Call& call) { return solve_any(call, {}, {}, false); }});
  library.type<Solver>("A method with its options.")
      .setup(setup::pressed_block() + "local solver = dotyk.solver.pdas{}\n")
      .method({.name = "solver:solve",
               .help = std::string("Solves a scene, or a frictional contact problem from a file (see dotyk.fclib): then a "
                                   "contact_problem_result is returned. ") + kSteps,
               .example = "local s = solver:solve(scene)\n"
                          "local h = solver:solve(scene, { steps = { { load = 1 }, { load = 0 } } })",
               .arguments = solve_keys(true),
               .returns = "solution",
               .run = solve_and_tell})
      .method({.name = "solver:with",
               .help = "The same method with another tol; this one stays as it is.",
               .example = "local rough = solver:with{ tol = 1e-3 }:solve(scene)",
               .arguments = {key::table({key::positive("tol", "relative natural residual at which it stops").required()})},
               .run = with_tol})
      .field("tol", "relative natural residual at which it stops", [](const Solver& s) { return s.tol; })
      .text(&Solver::text);
  bind_all_solutions(library);
}

// Several processes for one script.
void bind_ranks(Library& library) {
  library.function(
      {.name = "dotyk.ranks",
       .help = "dotyk.ranks(4) lets multigrid use 4 processes on this machine and returns the number in use. Call it before the first solve by multigrid. This process goes on with the script, "
               "or the prompt. Under mpirun it starts nothing: the count is mpirun's. dotyk --ranks COUNT FILE, and mpirun -n "
               "COUNT ./dotyk FILE, which also knows other machines, do the same from outside. Everything else, and systems of less than 1000 unknowns a rank, "
               "run on this process alone. The default method is chosen for one process: name dotyk.solver.multigrid{}. For bodies with refine it is the default. Where one process dies or runs out of "
               "memory, all end. OPENBLAS_NUM_THREADS=1 keeps BLAS in each of them to one thread.",
       .example = "print(dotyk.ranks())",
       .arguments = {key::integer("count", "of processes, this one included").within(1, 4096).otherwise("as many as there are")},
       .run = [](Call& call) {
         if (call.has("count")) {
           const int count = static_cast<int>(call.number("count"));
           if (count > 1 && Library::of(call.state()).folder) throw InputError("--safe starts no other programs");
           multigrid::start_ranks(count);
         }
         return call.give(multigrid::count_ranks());
       }});
}

}  // namespace dotyk::script
