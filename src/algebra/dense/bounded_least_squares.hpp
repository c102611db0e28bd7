#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

struct BoundedLeastSquares {
  Vector x;          ///< within its bounds
  Vector residual;   ///< b − A x, orthogonal to the columns of free x
  int steps = 0;
};

/// Minimises ‖A x − b‖ subject to low ≤ x ≤ high (±∞ allowed), for an A with few rows and any
/// number of columns, by active sets (Lawson and Hanson 1974 for x ≥ 0; Stark and Parker 1995 with
/// both bounds). `tolerance` is relative, on the angle between residual and a column. Throws
/// std::runtime_error where it does not end within 20 steps a column. `start`: where to begin, clamped to the bounds: the x of a
/// similar problem saves most of the steps. Empty: at the bounds that are nearest to 0.
BoundedLeastSquares bounded_least_squares(const DenseMatrix& A, const Vector& b, const Vector& low,
                                          const Vector& high, double tolerance = 1e-12, const Vector& start = Vector());

}  // namespace dotyk::algebra
