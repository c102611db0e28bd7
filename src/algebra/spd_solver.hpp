#pragma once

#include <string>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// A⁻¹ b for symmetric positive definite matrices of one pattern, which differ in their numbers.
class SpdSolver {
 public:
  virtual ~SpdSolver() = default;
  /// Takes a matrix of the pattern that it was made for, lower triangle. `held`, one flag an unknown: rows and columns of A that are empty
  /// but for their diagonal. False where A is seen not to be positive definite.
  virtual bool set(const SparseMatrix& lower, const std::vector<char>& held) = 0;
  /// x with ‖b − A x‖ ≤ tolerance ‖b‖; direct solvers go as far as rounding lets them, whatever the tolerance.
  virtual Vector solve(const Vector& b, double tolerance) = 0;
  virtual double bytes() const = 0;         ///< of what it keeps beside A
  virtual std::string method() const = 0;   ///< "Cholesky factor (METIS)", "conjugate gradients, …"
};

}  // namespace dotyk::algebra
