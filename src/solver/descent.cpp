#include "solver/descent.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;
using problem::RowGroup;

Vector admissible(const Problem& problem, const Vector& lambda) {
  Vector result(lambda.size());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      result[r] = group.law->project(r - group.first, lambda[r], 0).lambda;
  return result;
}

DualDescent::DualDescent(const Problem& problem, const CondensedProblem& condensed, const Vector& lambda)
    : problem_(problem), condensed_(condensed), lambda_(admissible(problem, lambda)),
      alpha_(Vector::Zero(condensed.kernel_size())) {
  if (condensed.kernel_size() > 0) {
    // Both terms of the augmented energy weigh alike.
    gamma_ = condensed.W().trace() / condensed.N().squaredNorm();
    augmented_ = condensed.W() + gamma_ * condensed.N() * condensed.N().transpose();
  }
  x_ = jump_at(lambda_);
}

Vector DualDescent::jump_at(const Vector& lambda) const {
  if (gamma_ == 0) return condensed_.jump(lambda, Vector());
  const Vector unbalanced = condensed_.N().transpose() * lambda - condensed_.e();
  return condensed_.jump(lambda, alpha_ - gamma_ * unbalanced);
}

double DualDescent::energy_at(const Vector& lambda) const {
  double q = 0.5 * lambda.dot(condensed_.W() * lambda) - condensed_.x0().dot(lambda);
  if (gamma_ > 0) {
    const Vector unbalanced = condensed_.N().transpose() * lambda - condensed_.e();
    q += 0.5 * gamma_ * unbalanced.squaredNorm() - alpha_.dot(unbalanced);
  }
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      q += group.law->conjugate(r - group.first, lambda[r]);
  return q;
}

void DualDescent::sweep() {
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const double w = W()(r, r);
      if (!(w > 0)) continue;  // a row that nothing moves
      const double minimiser =
          group.law->project(r - group.first, x_[r] / w + lambda_[r], 1 / w).lambda;
      x_ -= (minimiser - lambda_[r]) * W().col(r);
      lambda_[r] = minimiser;
    }
}

void DualDescent::update_equilibrium() {
  if (gamma_ == 0) return;
  alpha_ -= gamma_ * (condensed_.N().transpose() * lambda_ - condensed_.e());
  x_ = jump_at(lambda_);
}

void DualDescent::take_if_lower(const Vector& candidate) {
  const Vector near = admissible(problem_, candidate);
  if (!(energy_at(near) < energy())) return;
  lambda_ = near;
  x_ = jump_at(lambda_);
}

}  // namespace dotyk::solver
