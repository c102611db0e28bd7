#include "solver/programs/penalty.hpp"

#include <cmath>

#include "base/text.hpp"
#include "problem/residual.hpp"
#include "solver/active/pdas.hpp"
#include "solver/programs/penalty_step.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using problem::Problem;

/// Of the springs in series with the rows; infinite where a row is a spring itself.
Vector spring_stiffness(const Problem& problem, double factor) {
  Vector p = factor * problem.row_stiffness();
  const double largest = p.size() ? p.maxCoeff() : 0;
  for (double& value : p)
    if (!(value > 0)) value = largest > 0 ? largest : factor;
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (const auto k = group.law->linear_stiffness(r - group.first); k && std::isfinite(*k)) p[r] = INFINITY;
  return p;
}

PenaltyError error_of(const Problem& problem, const Vector& springs, const problem::State& state, double factor) {
  PenaltyError error{factor, 0, 0};
  const Vector x = problem.B * state.u - problem.c;
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      if (!std::isfinite(springs[r])) continue;
      error.penetration = std::max(error.penetration, group.law->unilateral() ? x[r] : std::abs(x[r]));
      error.energy += state.lambda[r] * x[r];
    }
  return error;
}

}  // namespace

Result solve(const Problem& problem, const Penalty& settings, Monitor& monitor) {
  require_unilateral_or_linear(problem, "penalty");
  const Vector springs = spring_stiffness(problem, settings.factor);
  Pdas pdas;
  static_cast<Settings&>(pdas) = settings;
  pdas.reduced = settings.reduced;
  pdas.step = [&](const Problem&, const problem::RigidMotions&, const Vector&) {
    return penalty_step(problem, problem::rigid_motions(problem), springs, settings.ordering);
  };
  Result result = solve(with_springs(problem, springs), pdas, monitor);
  result.state.u.conservativeResize(problem.unknowns());
  result.method = "penalty";
  result.penalty = error_of(problem, springs, result.state, settings.factor);
  const double energy = std::abs(problem::energy(problem, result.state));
  result.reason += text("; of the problem with springs in place of contact: penetration up to ",
                        result.penalty->penetration, ", energy too low by ", result.penalty->energy,
                        energy > 0 ? text(" (", 100 * result.penalty->energy / energy, " %)") : "");
  return result;
}

}  // namespace dotyk::solver
