#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// An upper bound of the greatest eigenvalue of diag(s) A diag(s), A symmetric positive semidefinite and
/// s > 0 (one number a row; empty: all 1): the lesser of its greatest absolute row sum, which is one
/// always, and of θ + r, θ the greatest Ritz value of a few dozen Lanczos steps (from a fixed start) and r
/// the norm of its residual, which exceeds the eigenvalue by a thousandth where Lanczos has settled (Zhou
/// and Li 2011, "Bounding the spectrum of large Hermitian matrices"). 0 for an empty or zero matrix.
double largest_eigenvalue(const DenseMatrix& A, const Vector& s = {});

/// A proved upper bound of the greatest eigenvalue of a symmetric positive semidefinite A: the first of largest_eigenvalue() times powers of
/// 1.01 that leaves bound · I − A with a Cholesky factor. Asks whether to stop, as cholesky() does.
double proved_largest_eigenvalue(const DenseMatrix& A);

}  // namespace dotyk::algebra
