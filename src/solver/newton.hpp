#pragma once

#include "solver/row_iteration.hpp"

namespace dotyk::solver {

/// The full generalised Newton method on normal and tangential part together (TR965's open question,
/// (2.27), (3.23)), on the condensed problem: with x = x₀ − Wλ + Nα,
///   F_n = λ_n − P(λ_n + ρ x_n),   F_t = λ_t − π_b(λ_t + ρ x_t),   Nᵀλ = e,
/// b the bound of given friction or μ (λ_n + ρ x_n)⁺ for Coulomb, with the exact derivative of both
/// projections. Steps are damped where the norm of F would exceed all of its last few values. Takes
/// every scalar law as well. Where the derivative is singular to working precision a multiple of the
/// identity is added and `reason` says so.
struct Newton : RowMethod {
  /// Multiplies 1/W_rr, the stiffness (force per displacement) that each row sees.
  double rho = 1.0;
  double map_weight() const override { return rho; }
  const char* name() const override { return "newton"; }
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver
