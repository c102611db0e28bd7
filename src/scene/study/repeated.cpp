#include "scene/study/repeated.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/listed.hpp"
#include "scene/result/load_derivative.hpp"

namespace dotyk::scene {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;

const Body& only_body(const Scene& scene) {
  const char* other = "; dotyk.solve takes such scenes";
  if (scene.bodies.size() != 1) throw InputError(text("the scene has ", scene.bodies.size(), " bodies; it must have one", other));
  const Body& body = *scene.bodies.front();
  if (!scene.contacts.empty()) throw InputError(text("'", body.name, "' is in contact, which is not linear", other));
  if (!body.laws.empty() || !body.slides.empty())
    throw InputError(text("'", body.name, "' has ", body.laws.empty() ? "a slide along no axis" : "support laws",
                          ", which are not part of its stiffness", other));
  return body;
}

const problem::Block& held_block(const Model& model) {
  const problem::Block& block = model.problem.blocks.front();
  if (block.kernel.cols() == 0) return block;
  throw InputError(text("'", block.name, "' is free to move (", listed(texts(block.motions)), "); its stiffness must be positive definite: fix it"));
}

Loading only(const Scene& scene, const std::string& load_case) {
  Loading loading;
  loading.take({.all = 0.0, .factor = {{load_case, 1.0}}, .move = {}}, scene);
  return loading;
}

Vector gather(const elasticity::Numbering& numbering, const std::vector<double>& nodal) {
  Vector b(numbering.count());
  for (std::size_t k = 0; k < nodal.size(); ++k)
    if (numbering.unknown[k] >= 0) b[numbering.unknown[k]] = nodal[k];
  return b;
}

RepeatedSolution finish(const Body& body, const Model& model, const algebra::RepeatedSystems& systems, RepeatedSolution solution) {
  solution.mesh = body.mesh;
  solution.systems = systems.results();
  solution.unknowns = model.problem.blocks.front().size();
  solution.setup_seconds = systems.setup_seconds();
  solution.bytes = systems.bytes();
  solution.kept = systems.kept();
  return solution;
}

}  // namespace

bool RepeatedSolution::converged() const {
  return std::all_of(systems.begin(), systems.end(), [](const auto& s) { return s.converged; });
}

RepeatedSolution solve_load_cases(const Scene& scene, const std::vector<std::string>& cases,
                                  const algebra::RepeatedSettings& settings, Monitor& monitor) {
  const Body& body = only_body(scene);
  problem::Clock clock;
  Model model = build(scene, clock, monitor, only(scene, cases.at(0)));
  const problem::Block& block = held_block(model);
  DenseMatrix B(block.size(), cases.size());
  std::vector<std::vector<double>> prescribed;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    reload(scene, {body}, only(scene, cases[k]), model, clock);
    B.col(static_cast<Eigen::Index>(k)) = model.problem.blocks.front().f;
    prescribed.push_back(model.numbering.front().values());
  }
  monitor.phase(text("solving ", cases.size(), " systems"));
  algebra::RepeatedSystems systems(block.K, block.node, settings);
  const DenseMatrix X = systems.solve(B, monitor);
  RepeatedSolution solution;
  solution.names = cases;
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    solution.solutions.push_back(spread(model.numbering.front(), X.col(k), prescribed[static_cast<std::size_t>(k)]));
    solution.energies.push_back(X.col(k).dot(B.col(k)));
  }
  return finish(body, model, systems, std::move(solution));
}

RepeatedSolution solve_sensitivities(const Scene& scene, const std::vector<std::vector<double>>& velocities,
                                     const algebra::RepeatedSettings& settings, Monitor& monitor) {
  const Body& body = only_body(scene);
  for (const auto& V : velocities) require_differentiable(scene, {V});
  problem::Clock clock;
  const Model model = build(scene, clock, monitor);
  const problem::Block& block = held_block(model);
  const elasticity::Numbering& numbering = model.numbering.front();
  algebra::RepeatedSystems systems(block.K, block.node, settings);
  RepeatedSolution solution;
  const Vector u = systems.solve(block.f, monitor);
  solution.names = {"analysis"};
  solution.solutions.push_back(spread(numbering, u, numbering.values()));
  solution.energies.push_back(u.dot(block.f));
  DenseMatrix B(block.size(), velocities.size());
  for (std::size_t k = 0; k < velocities.size(); ++k)
    B.col(static_cast<Eigen::Index>(k)) = gather(numbering, load_derivative(body, {}, velocities[k])) -
                                          gather(numbering, internal_force_derivative(body, solution.solutions.front(), velocities[k]));
  monitor.phase(text("solving for ", velocities.size(), " sensitivities"));
  const DenseMatrix X = systems.solve(B, monitor);
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    solution.names.push_back(text("sensitivity ", k + 1));
    solution.solutions.push_back(spread(numbering, X.col(k), std::vector<double>(numbering.unknown.size(), 0.0)));
    solution.energies.push_back(X.col(k).dot(B.col(k)));
  }
  return finish(body, model, systems, std::move(solution));
}

}  // namespace dotyk::scene
