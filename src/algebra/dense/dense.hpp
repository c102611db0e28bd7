#pragma once

#include "algebra/types.hpp"

// Dense kernels by BLAS and LAPACK, in place on Eigen storage.

namespace dotyk::algebra {

/// A := L with A = L Lᵀ (the upper triangle is zeroed). False, with A spoilt,
/// where A is not positive definite to working precision.
bool cholesky(DenseMatrix& a);

/// X := L⁻¹ X, L lower triangular.
void solve_lower(const Eigen::Ref<const DenseMatrix>& l, Eigen::Ref<DenseMatrix> x);

/// X := L⁻ᵀ X.
void solve_lower_transposed(const Eigen::Ref<const DenseMatrix>& l, Eigen::Ref<DenseMatrix> x);

/// The product A B.
DenseMatrix product(const Eigen::Ref<const DenseMatrix>& a, const Eigen::Ref<const DenseMatrix>& b);

/// XᵀX, both triangles.
DenseMatrix gram(const DenseMatrix& x);

/// L Lᵀ of a lower-triangular L, both triangles.
DenseMatrix square(const DenseMatrix& l);

/// X = Q R of X with no fewer rows than columns, by reflections: Q of X's size, R upper triangular.
struct OrthogonalFactors {
  DenseMatrix Q, R;
};
OrthogonalFactors orthogonal_factors(DenseMatrix x);

/// An orthonormal basis of the span of independent columns, by reflections: of X's size.
DenseMatrix orthonormal(const DenseMatrix& x);

/// The same span in column echelon form with pivoting: each vector as pure as can be.
DenseMatrix pure(DenseMatrix V);

/// The singular values, greatest first; NaN where an entry is not finite.
Vector singular_values(DenseMatrix a);

/// The least singular value of a square matrix, by all of them; +∞ for an empty one, NaN where an entry is
/// not finite.
double smallest_singular_value(DenseMatrix a);

}  // namespace dotyk::algebra
