#include "scene/solve/all_solutions.hpp"

#include "base/stopwatch.hpp"
#include "solver/pieces/enumeration.hpp"

namespace dotyk::scene {

AllSolutions all_solutions(std::shared_ptr<const Scene> scene, Monitor& monitor) {
  Stopwatch watch;
  scene = std::make_shared<const Scene>(*scene);
  problem::Clock clock;
  const Model model = build(*scene, clock, monitor);
  solver::Enumeration found = solver::enumerate(model.problem, monitor);
  AllSolutions all{{}, {}, found.summary()};
  const auto add = [&](solver::Enumeration::Solution& each) {
    each.result.clock.assembly += clock.assembly;
    all.solutions.push_back(std::make_shared<Solution>(scene, model, nullptr, std::move(each.result), Past{}));
    all.solutions.back()->set_total(watch.seconds());
  };
  for (solver::Enumeration::Solution& each : found.solutions) add(each);
  for (solver::Enumeration::Family& family : found.families) {
    all.families.push_back({family.dimension, {}, family.unbounded > 0, family.forces_only, family.connected});
    for (solver::Enumeration::Solution& end : family.ends) {
      all.families.back().ends.push_back(static_cast<int>(all.solutions.size()));
      add(end);
    }
  }
  return all;
}

}  // namespace dotyk::scene
