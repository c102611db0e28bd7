#include "solver/rows/equilibrium.hpp"

#include <utility>

#include "algebra/dense/dense.hpp"
#include "algebra/krylov/largest_eigenvalue.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;

Equilibrium::Equilibrium(const problem::CondensedProblem& condensed, Vector start, double weight)
    : condensed_(condensed), alpha_(std::move(start)) {
  if (!needed()) return;
  const DenseMatrix& N = condensed.N();
  auto [Q, R] = algebra::orthogonal_factors(N);
  Q_ = std::move(Q), R_ = std::move(R);
  e_ = R_.transpose().triangularView<Eigen::Lower>().solve(condensed.e());
  const double largest = algebra::largest_eigenvalue(condensed.W());
  gamma_ = weight * (largest > 0 ? largest : 1);
  augmented_ = condensed.W() + gamma_ * Q_ * Q_.transpose();
}

void Equilibrium::go_on_from(const Vector& lambda, const Vector& alpha) {
  if (needed()) alpha_ += alpha - this->alpha(lambda);
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

double Equilibrium::unbalanced(const Vector& lambda) const { return needed() ? excess(lambda).norm() : 0; }

void Equilibrium::update(const Vector& lambda) { alpha_ = alpha(lambda); }

bool Equilibrium::settle(double residual, const Vector& lambda) {
  if (!needed() || residual > unbalanced(lambda) / 3) return false;
  update(lambda);
  return true;
}

}  // namespace dotyk::solver
