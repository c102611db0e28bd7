#include "solver/rows/equilibrium.hpp"

#include "algebra/dense/dense.hpp"
#include "algebra/krylov/lanczos.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;

Equilibrium::Equilibrium(const problem::CondensedProblem& condensed, double weight)
    : condensed_(condensed), alpha_(Vector::Zero(condensed.kernel_size())) {
  if (!needed()) return;
  auto [Q, R] = algebra::orthogonal_factors(condensed.N());
  Q_ = std::move(Q), R_ = std::move(R);
  e_ = R_.transpose().triangularView<Eigen::Lower>().solve(condensed.e());
  const double largest = algebra::largest_eigenvalue(condensed.W());
  gamma_ = weight * (largest > 0 ? largest : 1);
  augmented_ = condensed.W() + gamma_ * Q_ * Q_.transpose();
}

Equilibrium::Equilibrium(const RowIteration& iteration, double weight) : Equilibrium(iteration.condensed, weight) {
  if (!iteration.begun() || !needed()) return;
  alpha_ = iteration.alpha();
  alpha_ += iteration.alpha() - alpha(iteration.lambda());
}

Vector Equilibrium::x0() const {
  if (!needed()) return condensed_.x0();
  return condensed_.x0() + condensed_.N() * alpha_ + gamma_ * Q_ * e_;
}

double Equilibrium::step_bound(const Vector& stiffness) const {
  const double largest = algebra::largest_eigenvalue(W(), stiffness.cwiseSqrt());
  return 2 / (largest > 0 ? largest : 1);
}

Vector Equilibrium::alpha(const Vector& lambda) const {
  if (!needed()) return alpha_;
  return alpha_ - gamma_ * R_.triangularView<Eigen::Upper>().solve(excess(lambda));
}

Iterate Equilibrium::at(Vector lambda) const {
  Vector amounts = alpha(lambda);
  return {std::move(lambda), std::move(amounts)};
}

bool Equilibrium::settle(RowIteration& iteration) {
  if (!needed() || iteration.law_residual() > unbalanced(iteration.lambda()) / 3) return false;
  update(iteration.lambda());
  iteration.move_to(at(iteration.lambda()));
  return true;
}

void iterate(RowIteration& it, Equilibrium& equilibrium, const std::function<Vector(Vector, Vector)>& next) {
  it.move_to(equilibrium.at(it.lambda()));
  while (it.next()) {
    it.move_to(equilibrium.at(next(it.lambda(), it.jump())));
    if (it.record()) break;
    equilibrium.settle(it);
    if (it.stalled()) break;
  }
}

}  // namespace dotyk::solver
