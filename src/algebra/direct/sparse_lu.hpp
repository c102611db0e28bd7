#pragma once

#include <memory>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// Sparse LU of a square, possibly indefinite matrix (both triangles stored), by UMFPACK.
class SparseLu {
 public:
  /// `a` must live as long.
  explicit SparseLu(const SparseMatrix& a);

  /// The matrix is singular to working precision.
  bool singular() const { return singular_; }
  Vector solve(const Vector& b) const;

 private:
  const SparseMatrix& a_;
  std::shared_ptr<void> numeric_;  ///< UMFPACK's factors
  bool singular_ = false;
};

}  // namespace dotyk::algebra
