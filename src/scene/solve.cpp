#include "base/stopwatch.hpp"
#include "scene/solution.hpp"

namespace dotyk::scene {

namespace {

solver::Result run(const Scene& scene, const Model& model, const Method& method, const Start& start,
                   Monitor& monitor) {
  const auto with_start = [&](auto settings) {
    if (start.coarse || start.closed) settings.start = start_flags(scene, model, start);
    return settings;
  };
  const auto* pdas = std::get_if<solver::Pdas>(&method);
  const auto* newton = std::get_if<solver::Newton>(&method);
  if (model.problem.rows() == 0)
    return solver::solve_linear(model.problem, pdas ? pdas->ordering : newton ? newton->ordering
                                                                             : algebra::Ordering::automatic, monitor);
  if (newton) return solver::solve(model.problem, with_start(*newton), monitor);
  if (!pdas && !model.problem.friction.empty()) return solver::solve(model.problem, with_start(solver::Newton{}), monitor);
  return solver::solve(model.problem, with_start(pdas ? *pdas : solver::Pdas{}), monitor);
}

}  // namespace

std::shared_ptr<Solution> solve(std::shared_ptr<const Scene> scene, const Method& method, const Start& start,
                                Monitor& monitor) {
  Stopwatch watch;
  // A copy: on_iteration may run a script that adds contacts to the scene.
  scene = std::make_shared<const Scene>(*scene);
  problem::Clock clock;
  Model model = build(*scene, clock, monitor);
  solver::Result result = run(*scene, model, method, start, monitor);
  result.clock.assembly += clock.assembly;
  auto solution = std::make_shared<Solution>(std::move(scene), std::move(model), std::move(result));
  solution->set_total(watch.seconds());
  return solution;
}

}  // namespace dotyk::scene
