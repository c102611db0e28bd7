#pragma once

#include <vector>

#include "solver/rows/row_iteration.hpp"

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
    const problem::Law* law;
    const problem::FrictionGroup* friction;
    int index, row;     ///< in its group; its first of all
    double compliance;  ///< W_rr, λ_max(W_tt)
  };
  double compliance(int row, int count) const;

  const algebra::DenseMatrix& W_;
  std::vector<Site> sites_;
};

/// Projected successive over-relaxation: sweeps over the nodes (Relaxation), normal row first, then its
/// friction at the bound just found, so that Coulomb's law is treated directly. Converges for given bounds
/// and 0 < ω < 2 in the plane, ω ≤ 1 in space. Free bodies by an augmented Lagrangian (Equilibrium).
struct Psor : RowMethod {
  double omega = 1.0;
  const char* name() const override { return "psor"; }
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver
