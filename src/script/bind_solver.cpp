#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "script/bind.hpp"
#include "script/bind_fclib.hpp"
#include "script/library.hpp"
#include "script/method_keys.hpp"
#include "script/watch.hpp"
#include "script/wrapped.hpp"

namespace dotyk::script {
namespace {

using scene::Scene;
using scene::Solution;

Key start_key() {
  return key::either("start",
                     {key::object<Solution>("", "a solution of a like scene, usually on a coarser mesh"),
                      key::list("", key::integer("", ""), "numbers of the rows (contact nodes, in order) that start closed")},
                     "where to start: a solution whose contact status is taken over, or a list of the closed rows");
}

int count_rows(const Scene& scene) {
  std::size_t rows = 0;
  for (const auto& contact : scene.contacts)
    rows += contact->kind == scene::Contact::Kind::contact ? contact->rows.size() : 0;
  return static_cast<int>(rows);
}

/// Solves and answers Ctrl-C.
int run(Call& call, const std::shared_ptr<Scene>& scene, const solver::Method& method,
        std::vector<Function> on_iteration, bool verbose) {
  scene::Start start;
  if (call.has("options")) {
    const Arguments options = call.table("options");
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
  const auto solution = scene::solve(scene, method, start, watch);
  watch.answer();
  return call.give(solution);
}

int solve_with(Call& call) {
  const auto solver = call.self<Solver>();
  if (call.holds<fclib::ContactProblem>("scene")) {
    if (call.has("options")) throw InputError("options are for scenes; a contact_problem takes none");
    return solve_contact_problem(call, call.object<fclib::ContactProblem>("scene"), *solver,
                                 call.kept_function(1, "on_iteration"));
  }
  return run(call, call.object<Scene>("scene"), solver->method, call.kept_function(1, "on_iteration"), solver->verbose);
}

int solve(Call& call) { return run(call, call.object<Scene>("scene"), {}, {}, false); }

Key scene_key() { return key::object<Scene>("scene", "what to solve").required(); }

Key scene_or_problem_key() {
  return key::either("scene", {key::object<Scene>("", "a scene"), key::object<fclib::ContactProblem>("", "a problem from a file")},
                     "what to solve: a scene, or a problem that dotyk.fclib read").required();
}

std::vector<Key> solve_keys(Key what) {
  return {std::move(what), key::table("options", {start_key()}, "start = a coarser solution, or the rows that start closed")};
}

}  // namespace

void bind_solver(Library& library) {
  library.module("dotyk.solver", "Methods. Each is made with its options and then solves scenes.");
  bind_methods(library);
  library.function({.name = "dotyk.solve",
                    .help = "Solves a scene by the method its plan names; without contact that is one linear solve.",
                    .example = "local s = dotyk.solve(scene)\nlocal finer = dotyk.solve(fine_scene, { start = s })",
                    .arguments = solve_keys(scene_key()),
                    .returns = "solution",
                    .run = solve});
  library.type<Solver>("A method with its options.")
      .method({.name = "solver:solve",
               .help = "Solves a scene, or a frictional contact problem from a file (see dotyk.fclib): then a "
                       "contact_problem_result is returned.",
               .example = "local s = solver:solve(scene)",
               .arguments = solve_keys(scene_or_problem_key()),
               .returns = "solution",
               .run = solve_with})
      .text([](const Solver& s) { return s.text; });
}

}  // namespace dotyk::script
