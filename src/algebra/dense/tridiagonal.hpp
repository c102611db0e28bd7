#pragma once

#include "algebra/dense/decompositions.hpp"

namespace dotyk::algebra {

/// All eigenvalues of the symmetric tridiagonal matrix and their vectors, by QR steps; off_diagonal is shorter by one.
Eigenpairs all_eigenpairs(const Vector& diagonal, const Vector& off_diagonal);

/// The `count` least eigenvalues of the symmetric tridiagonal matrix and their vectors, by LAPACK's dstevr (multiple
/// relatively robust representations); all of them where there are fewer.
Eigenpairs lowest_eigenpairs(Vector diagonal, Vector off_diagonal, int count);

}  // namespace dotyk::algebra
