#include "solver/active/descent.hpp"

#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;

Vector admissible(const Problem& problem, const Vector& lambda) {
  return project(problem, lambda, Vector::Zero(lambda.size()));
}

DualDescent::DualDescent(const Problem& problem, const CondensedProblem& condensed, const Vector& lambda)
    : problem_(problem), equilibrium_(condensed), relaxation_(problem, equilibrium_.W()), lambda_(admissible(problem, lambda)), x_(jump_at(lambda_)) {}

double DualDescent::energy_at(const Vector& lambda) const {
  double q = 0.5 * lambda.dot(equilibrium_.W() * lambda) - equilibrium_.x0().dot(lambda);
  for (const auto& [law, k, r] : problem_.scalar_rows()) q += law.conjugate(k, lambda[r]);
  return q;
}

void DualDescent::update_equilibrium() {
  if (!equilibrium_.needed()) return;
  equilibrium_.update(lambda_);
  x_ = jump_at(lambda_);
}

void DualDescent::take_if_lower(const Vector& candidate) {
  const Vector near = admissible(problem_, candidate);
  if (!(energy_at(near) < energy())) return;
  lambda_ = near;
  x_ = jump_at(lambda_);
}

}  // namespace dotyk::solver
