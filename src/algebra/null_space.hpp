#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// An orthonormal basis of all x, split in two: A x ≠ 0 on every combination of `seen`, and A x = 0 on `unseen`.
struct RangeAndNull {
  DenseMatrix seen, unseen;  ///< columns of A × count
};

/// `tolerance` is relative to the greatest singular value, or to 1 where that is less. Columns that no row joins are treated apart: A is
/// taken to pieces by its graph. A piece of more than some dozens of columns is taken as of full rank
/// where a sparse factor of AᵀA shows that it is, far above the tolerance; else singular values decide.
RangeAndNull range_and_null(const DenseMatrix& A, double tolerance);

}  // namespace dotyk::algebra
