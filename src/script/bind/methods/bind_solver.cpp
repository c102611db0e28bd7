#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/models/bind_beam.hpp"
#include "script/bind/models/bind_plate.hpp"
#include "script/bind/program/bind_fclib.hpp"
#include "script/bridge/library.hpp"
#include "script/bind/methods/method_keys.hpp"
#include "script/bind/scene/read_steps.hpp"
#include "script/bind/setups.hpp"
#include "script/prompt/watch.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {
namespace {

using scene::Scene;
using scene::Solution;

Key start_key() {
  return key::either("start",
                     {key::object<Solution>("", "a solution of a like scene, usually on a coarser mesh"),
                      key::list("", key::integer("", ""), "numbers of the rows (contact nodes, in order) that start closed")},
                     "where to start: a solution, of which all methods but interior_point and feti take over the whole state where it has the same meshes and "
                     "contacts; otherwise pdas, newton and active_set take over the contact status of nearest nodes; or a list of the closed rows");
}

int count_rows(const Scene& scene) {
  std::size_t rows = 0;
  for (const auto& contact : scene.contacts)
    rows += contact->kind == scene::Contact::Kind::contact ? contact->rows.size() : 0;
  return static_cast<int>(rows);
}

/// Solves and answers Ctrl-C.
int run_solve(Call& call, const std::shared_ptr<Scene>& scene, const solver::Method& method,
        std::vector<Function> on_iteration, bool verbose) {
  scene::Start start;
  std::vector<scene::Step> steps;
  if (call.has("options")) {
    const Arguments options = call.table("options");
    if (options.has("after")) start.after = options.object<Solution>("after");
    if (options.has("steps")) steps = read_steps(options, *scene);
    if (options.holds<Solution>("start")) {
      start.coarse = options.object<Solution>("start");
    } else if (options.has("start")) {
      start.closed.emplace();
      for (long long row : options.integers("start")) {
        if (row < 1 || row > count_rows(*scene))
          throw InputError(text("start names row ", row, "; the scene has rows 1 to ", count_rows(*scene)));
        start.closed->push_back(static_cast<int>(row - 1));
      }
    }
  }
  Watch watch(call.state(), "solving", std::move(on_iteration), verbose);
  if (call.has("options") && call.table("options").has("seconds")) watch.limit(call.table("options").number("seconds"));
  const auto solution = scene::solve(scene, method, start, watch, steps);
  watch.judge(solution->result());
  watch.answer(method.begins_anew() ? "look at it or leave it (this method begins anew, whatever start says)"
                                    : "look at it, go on from it (start = that result), or leave it");
  return call.give(solution);
}

void require_no_options(const Call& call) {
  if (call.has("options")) throw InputError("options are for scenes; other problems take none");
}

int with_tol(Call& call) {
  const auto solver = call.self<Solver>();
  auto other = std::make_shared<Solver>(*solver);
  other->tol = call.number("tol");
  other->method = solver->method.with_tol(other->tol);
  const int kept = call.kept(1, "on_iteration");
  call.give(other);
  if (kept) call.keep(lua_gettop(call.state()), "on_iteration", kept);
  return 1;
}

int solve_with(Call& call) {
  const auto solver = call.self<Solver>();
  if (call.holds<fclib::ContactProblem>("scene")) {
    require_no_options(call);
    return solve_contact_problem(call, call.object<fclib::ContactProblem>("scene"), *solver,
                                 call.kept_function(1, "on_iteration"));
  }
  if (call.holds<beam::Beam>("scene")) {
    require_no_options(call);
    return solve_beam(call, *call.object<beam::Beam>("scene"), solver->method, call.kept_function(1, "on_iteration"), solver->verbose);
  }
  if (call.holds<plate::Model>("scene")) {
    require_no_options(call);
    return solve_plate(call, call.object<plate::Model>("scene"), solver->method, call.kept_function(1, "on_iteration"), solver->verbose);
  }
  return run_solve(call, call.object<Scene>("scene"), solver->method, call.kept_function(1, "on_iteration"), solver->verbose);
}

// The result knows the method and its options.
int solve_and_tell(Call& call) {
  const int results = solve_with(call);
  call.keep(lua_gettop(call.state()), "solver", 1);
  return results;
}

int solve_scene(Call& call) {
  if (call.holds<Scene>("scene")) return run_solve(call, call.object<Scene>("scene"), {}, {}, false);
  require_no_options(call);
  if (call.holds<plate::Model>("scene")) return solve_plate(call, call.object<plate::Model>("scene"), {}, {}, false);
  return solve_beam(call, *call.object<beam::Beam>("scene"), {}, {}, false);
}

constexpr const char* kSteps =
    "With steps, quasi-statically one load after the other: friction opposes the slip since the last step, and all "
    "steps share one factorisation. The result is the last step; all of them are in s.steps.";

Key scene_or_beam_key() {
  return key::either("scene", {key::object<Scene>("", "a scene"), key::object<beam::Beam>("", "a beam"), key::object<plate::Model>("", "a plate")}, "what to solve: a scene, a beam or a plate").required();
}

Key scene_or_problem_key() {
  return key::either("scene", {key::object<Scene>("", "a scene"), key::object<beam::Beam>("", "a beam"), key::object<plate::Model>("", "a plate"), key::object<fclib::ContactProblem>("", "a problem from a file")},
                     "what to solve: a scene, a beam, a plate, or a problem that dotyk.fclib read").required();
}

std::vector<Key> solve_keys(Key what) {
  return {std::move(what),
          key::table("options",
                     {start_key(), steps_key(),
                      key::object<Solution>("after", "the solution that this one follows in a quasi-static history: slip is "
                                            "measured from it, its factors and moves go on; of the same meshes, contacts "
                                            "and friction, on this scene or one like it"),
                      key::positive("seconds", "stop at the first iteration after so long, with the state so far (converged is "
                                    "false); an error where there is none yet").unit("s").otherwise("no limit")},
                     "start, steps, after, seconds")};
}

}  // namespace

void bind_solver(Library& library) {
  library.module("dotyk.solver", "Methods. Each is made with its options and then solves scenes.");
  bind_methods(library);
  bind_program_methods(library);
  library.function({.name = "dotyk.solve",
                    .help = std::string("Solves a scene by the method its plan names, without contact by one linear solve, or a beam. ") + kSteps,
                    .setup = setup::pressed_block(),
                    .example = "local s = dotyk.solve(scene)\nlocal again = dotyk.solve(scene, { start = s })\n"
                               "local h = dotyk.solve(scene, { steps = { { load = 0.5 }, { load = 1 } } })\nprint(s)",
                    .arguments = solve_keys(scene_or_beam_key()),
                    .returns = "solution",
                    .run = solve_scene});
  library.type<Solver>("A method with its options.")
      .setup(setup::pressed_block() + "local solver = dotyk.solver.pdas{}\n")
      .method({.name = "solver:solve",
               .help = std::string("Solves a scene, or a frictional contact problem from a file (see dotyk.fclib): then a "
                                   "contact_problem_result is returned. ") + kSteps,
               .example = "local s = solver:solve(scene)\n"
                          "local h = solver:solve(scene, { steps = { { load = 1 }, { load = 0 } } })",
               .arguments = solve_keys(scene_or_problem_key()),
               .returns = "solution",
               .run = solve_and_tell})
      .method({.name = "solver:with",
               .help = "The same method with another tol; this one stays as it is.",
               .example = "local rough = solver:with{ tol = 1e-3 }:solve(scene)",
               .arguments = {key::table({key::positive("tol", "relative natural residual at which it stops").required()})},
               .returns = "solver",
               .run = with_tol})
      .field("tol", "relative natural residual at which it stops", [](const Solver& s) { return s.tol; })
      .text([](const Solver& s) { return s.text(); });
}

}  // namespace dotyk::script
