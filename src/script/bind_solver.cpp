#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "script/bind.hpp"
#include "script/library.hpp"
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

std::vector<Key> settings_keys() {
  return {key::positive("tol", "relative natural residual at which iterative methods stop").fallback(1e-10),
          key::integer("max_iterations", "give up after so many").at_least(1).fallback(100.0),
          key::choice("ordering", {"automatic", "minimum_degree", "nested_dissection"},
                      "elimination order of the sparse factorisation").fallback("automatic"),
          key::function("on_iteration", "called as f(k, info) after each iteration; returning false stops the solve"),
          key::boolean("verbose", "a line on standard error for each iteration").fallback(false)};
}

void read_settings(const Call& call, solver::Settings& settings) {
  settings.tol = call.number("tol");
  settings.max_iterations = static_cast<int>(std::min<long long>(call.integer("max_iterations"), 1'000'000));
  settings.ordering = static_cast<algebra::Ordering>(call.choice("ordering"));
}

int give(Call& call, scene::Method method) {
  auto made = std::make_shared<Solver>(Solver{std::move(method), call.boolean("verbose")});
  return call.give_keeping(made, {"on_iteration"});
}

int make_pdas(Call& call) {
  solver::Pdas pdas;
  read_settings(call, pdas);
  pdas.rho = call.number("rho");
  pdas.reduced = call.boolean("reduced");
  pdas.kernel = call.choice("kernel") == 0 ? solver::Pdas::Kernel::exact : solver::Pdas::Kernel::screws;
  if (call.has("screws"))
    for (const long long row : call.integers("screws")) pdas.screws.push_back(static_cast<int>(row - 1));
  return give(call, std::move(pdas));
}

int make_newton(Call& call) {
  solver::Newton newton;
  read_settings(call, newton);
  newton.rho = call.number("rho");
  return give(call, newton);
}

int count_rows(const Scene& scene) {
  std::size_t rows = 0;
  for (const auto& contact : scene.contacts)
    rows += contact->kind == scene::Contact::Kind::contact ? contact->rows.size() : 0;
  return static_cast<int>(rows);
}

/// Solves and answers Ctrl-C.
int run(Call& call, const std::shared_ptr<Scene>& scene, const scene::Method& method,
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
  return run(call, call.object<Scene>("scene"), solver->method, call.kept_function(1, "on_iteration"), solver->verbose);
}

int solve(Call& call) { return run(call, call.object<Scene>("scene"), {}, {}, false); }

std::string show(const Solver& s) {
  if (const auto* pdas = std::get_if<solver::Pdas>(&s.method))
    return text("solver pdas: rho = ", pdas->rho, ", ", pdas->reduced ? "reduced" : "full", ", tol = ", pdas->tol,
                ", max_iterations = ", pdas->max_iterations);
  const auto& newton = std::get<solver::Newton>(s.method);
  return text("solver newton: rho = ", newton.rho, ", tol = ", newton.tol, ", max_iterations = ",
              newton.max_iterations);
}

std::vector<Key> solve_keys() {
  return {key::object<Scene>("scene", "what to solve").required(),
          key::table("options", {start_key()}, "start = a coarser solution, or the rows that start closed")};
}

}  // namespace

void bind_solver(Library& library) {
  library.module("dotyk.solver", "Methods. Each is made with its options and then solves scenes.");
  std::vector<Key> keys = settings_keys();
  keys.insert(keys.begin(),
              {key::positive("rho", "weight of the gap against the force when the first active set is chosen; "
                                    "multiplies each row's own stiffness").fallback(1.0),
               key::boolean("reduced", "iterate on the contact boundary alone, after one factorisation; else on the "
                                       "whole system, factored anew in each iteration").fallback(true),
               key::choice("kernel", {"exact", "screws"}, "rigid motions of free bodies: exactly, as constraints of the "
                           "dual problem, or by magnetic screws (contact nodes taken as closed, moved where they pull)")
                   .fallback("exact"),
               key::list("screws", key::integer("", "").at_least(1), "rows (contact nodes, in order) where the screws "
                         "are placed first").otherwise("chosen by the load's equilibrium")});
  library.function({.name = "dotyk.solver.pdas",
                    .help = "The primal-dual active set method, which is Newton's method on the contact conditions: "
                            "finite, exact, usually a handful of iterations.",
                    .example = "local s = dotyk.solver.pdas{ reduced = true }:solve(scene)",
                    .arguments = {key::table(keys)},
                    .returns = "solver",
                    .run = make_pdas});
  std::vector<Key> newton_keys = settings_keys();
  newton_keys.insert(newton_keys.begin(),
                     key::positive("rho", "weight of slip and gap against force in the projections; multiplies each "
                                          "row's own stiffness").fallback(1.0));
  library.function({.name = "dotyk.solver.newton",
                    .help = "The generalised Newton method on normal and tangential part together: contact with given "
                            "or Coulomb friction, in the plane and in space, on the contact boundary alone.",
                    .example = "local s = dotyk.solver.newton{ tol = 1e-10 }:solve(scene)",
                    .arguments = {key::table(newton_keys)},
                    .returns = "solver",
                    .run = make_newton});
  library.function({.name = "dotyk.solve",
                    .help = "Solves a scene by the method its plan names; without contact that is one linear solve.",
                    .example = "local s = dotyk.solve(scene)\nlocal finer = dotyk.solve(fine_scene, { start = s })",
                    .arguments = solve_keys(),
                    .returns = "solution",
                    .run = solve});
  library.type<Solver>("A method with its options.")
      .method({.name = "solver:solve",
               .help = "Solves a scene.",
               .example = "local s = solver:solve(scene)",
               .arguments = solve_keys(),
               .returns = "solution",
               .run = solve_with})
      .text(show);
}

}  // namespace dotyk::script
