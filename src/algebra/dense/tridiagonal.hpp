#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

struct Eigenpairs {
  Vector values;        ///< ascending
  DenseMatrix vectors;  ///< orthonormal columns
};

/// The `count` least eigenvalues of the symmetric tridiagonal matrix and their vectors, by LAPACK's dstevr (multiple
/// relatively robust representations); all of them where there are fewer.
Eigenpairs lowest_eigenpairs(Vector diagonal, Vector off_diagonal, int count);

}  // namespace dotyk::algebra
