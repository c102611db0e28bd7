#include "base/stopwatch.hpp"
#include "scene/solution.hpp"

namespace dotyk::scene {

std::shared_ptr<Solution> solve(std::shared_ptr<const Scene> scene, const Method& method, const Start& start,
                                Monitor& monitor) {
  Stopwatch watch;
  // A copy: on_iteration may run a script that adds contacts to the scene.
  scene = std::make_shared<const Scene>(*scene);
  problem::Clock clock;
  Model model = build(*scene, clock, monitor);
  solver::Result result;
  if (model.problem.rows() == 0) {
    const auto* pdas = std::get_if<solver::Pdas>(&method);
    result = solver::solve_linear(model.problem, pdas ? pdas->ordering : algebra::Ordering::automatic, monitor);
  } else {
    solver::Pdas pdas;
    if (const auto* given = std::get_if<solver::Pdas>(&method)) pdas = *given;
    if (start.coarse || start.closed) pdas.start = start_flags(*scene, model, start);
    result = solver::solve(model.problem, pdas, monitor);
  }
  result.clock.assembly += clock.assembly;
  auto solution = std::make_shared<Solution>(std::move(scene), std::move(model), std::move(result));
  solution->set_total(watch.seconds());
  return solution;
}

}  // namespace dotyk::scene
