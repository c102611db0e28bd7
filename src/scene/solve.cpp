#include "base/stopwatch.hpp"
#include "scene/solution.hpp"
#include "solver/newton.hpp"
#include "solver/pdas.hpp"

namespace dotyk::scene {

namespace {

solver::Result run(const Scene& scene, const Model& model, const solver::Method& named, const Start& start,
                   Monitor& monitor) {
  if (model.problem.rows() == 0) return solver::solve_linear(model.problem, named.ordering(), monitor);
  std::vector<char> flags;
  if (start.coarse || start.closed) flags = start_flags(scene, model, start);
  const solver::Method method = named                           ? named
                                : model.problem.friction.empty() ? solver::Method(solver::Pdas{})
                                                                 : solver::Method(solver::Newton{});
  return method.run(model.problem, {std::move(flags), nullptr}, monitor);
}

}  // namespace

std::shared_ptr<Solution> solve(std::shared_ptr<const Scene> scene, const solver::Method& method, const Start& start,
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
