#pragma once

#include <vector>

#include "problem/problem.hpp"

namespace dotyk::solver {

/// Gauss–Seidel sweeps over the multipliers of x = x₀ − Wλ, with relaxation: node by node, first
///   λ_r := P(λ_r + ρ x_r),   ρ = ω/W_rr,
/// which for ω = 1 is the exact minimiser of the dual energy in λ_r, then, for the friction at that node,
///   λ_t := π_b(λ_t + ρ x_t),  ρ = ω/λ_max(W_tt),
/// b at the λ_n just found. Of given friction no step increases the energy for 0 < ω ≤ 1 (nor, for laws
/// on one component, for ω < 2). Rows that nothing moves (W_rr = 0) keep their multiplier.
class Relaxation {
 public:
  Relaxation(const problem::Problem& problem, const algebra::DenseMatrix& W);
  /// One sweep; x is kept up to date.
  void sweep(double omega, algebra::Vector& lambda, algebra::Vector& x) const;

 private:
  /// A scalar row, or a friction point.
  struct Site {
    const problem::RowGroup* rows;
    const problem::FrictionGroup* friction;
    int index;          ///< in its group
    double compliance;  ///< W_rr, λ_max(W_tt)
  };
  double compliance(int row, int count) const;

  const algebra::DenseMatrix& W_;
  std::vector<Site> sites_;
};

}  // namespace dotyk::solver
