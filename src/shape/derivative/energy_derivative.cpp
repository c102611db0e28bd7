#include "shape/derivative/energy_derivative.hpp"

#include "base/error.hpp"
#include "scene/result/load_derivative.hpp"
#include "shape/derivative/row_changes.hpp"
#include "shape/derivative/sensitivity.hpp"

namespace dotyk::shape {
namespace {

void require_given(const problem::Problem& problem) {
  for (const problem::FrictionGroup& group : problem.friction)
    for (int p = 0; p < group.points(); ++p)
      if (group.law->bound_slope(p) > 0)
        throw InputError(group.name + " has Coulomb friction, whose solutions are not those of least energy; differentiate the energy by "
                                      "its solution's derivative");
}

/// Σ g'_p ‖x_t‖.
double friction(const problem::Problem& problem, const algebra::Vector& x, const algebra::Vector& bound) {
  double sum = 0;
  for (const problem::FrictionGroup& group : problem.friction)
    for (int p = 0; p < group.points(); ++p) sum += bound[group.row(p)] * x.segment(group.row(p), group.components).norm();
  return sum;
}

}  // namespace

double energy_derivative(const scene::Solution& solution, const Velocities& velocities) {
  const problem::Problem& problem = solution.model().problem;
  require_solution(solution);
  require_given(problem);
  scene::require_differentiable(solution.scene(), velocities);
  const RowChanges rows = row_changes(solution, velocities);
  const problem::State& state = solution.result().state;
  double sum = friction(problem, problem.B * state.u - problem.c, rows.bound) - state.lambda.dot(rows.c);
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    if (velocities[b].empty()) continue;
    const int body = static_cast<int>(b);
    const std::vector<double>& u = solution.displacement(body);
    const scene::Body& on = solution.body(body);  // its loads have their factors already
    const auto load = scene::load_derivative(on, {}, velocities[b]), inner = scene::internal_force_derivative(on, u, velocities[b]);
    for (std::size_t k = 0; k < u.size(); ++k) sum += u[k] * (0.5 * inner[k] - load[k]);
  }
  return sum;
}

}  // namespace dotyk::shape
