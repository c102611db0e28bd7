#pragma once

#include <memory>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// Sparse LU of a square, possibly indefinite matrix (both triangles stored), by UMFPACK.
class SparseLu {
 public:
  explicit SparseLu(const SparseMatrix& a);
  ~SparseLu();
  SparseLu(const SparseLu&) = delete;
  SparseLu& operator=(const SparseLu&) = delete;

  /// The matrix is singular to working precision.
  bool singular() const;
  Vector solve(const Vector& b) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace dotyk::algebra
