#pragma once

#include <memory>

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Coulomb friction by the outer loop over given friction (TR965, introduction): b := μλ_n, solve with that b
/// given, repeat, until the natural map of Coulomb's own law is within tol. It starts from b so large that
/// nothing slips, which can be solved wherever Coulomb's problem can, and goes on from the last solution. The
/// map b ↦ μλ_n(b) contracts for small μ only; history[k].contraction is ‖b_{k+1} − b_k‖ / ‖b_k − b_{k−1}‖.
struct CoulombLoop : RowMethod {
  /// Solves with given friction, to a tenth of the tolerance at least; counts no iterations of the loop.
  std::shared_ptr<const RowMethod> inner;
  const char* name() const override { return "coulomb_loop"; }
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver
