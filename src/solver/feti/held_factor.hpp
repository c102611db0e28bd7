#pragma once

#include <vector>

#include "algebra/direct/cholesky.hpp"

namespace dotyk::solver {

/// A positive semidefinite matrix of which some unknowns are held at zero, so many that the rest of it has an inverse.
class HeldFactor {
 public:
  /// Orders and analyses. `lower`: lower triangle, of the pattern of all that are to be factored.
  explicit HeldFactor(const algebra::SparseMatrix& lower);
  /// Factors the rest. False where it is not positive definite to working precision; failed_unknown() then tells where
  /// (-1: nowhere in particular).
  bool factor(const algebra::SparseMatrix& lower, const std::vector<int>& held);
  int failed_unknown() const { return factor_.failed_unknown(); }
  algebra::Vector pivots() const { return factor_.pivots(); }
  /// The inverse of the rest times what the right-hand sides are there; zero where held.
  algebra::DenseMatrix solve(algebra::DenseMatrix right) const;

 private:
  std::vector<int> held_;
  algebra::Cholesky factor_;
};

}  // namespace dotyk::solver
