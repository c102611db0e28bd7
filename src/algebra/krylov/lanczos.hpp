#pragma once

#include <functional>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// A linear map, known by what it makes of a vector.
using LinearMap = std::function<Vector(const Vector&)>;

/// ‖3A(v/3) − Av‖, a sample of the rounding in `Av`: v/3 has other digits than v.
inline double rounding_seen(const LinearMap& A, const Vector& v, const Vector& Av) { return (3 * A(v / 3) - Av).norm(); }

/// The least and the greatest Ritz value of a symmetric linear map, each with the norm of its residual: an
/// eigenvalue lies within that of it.
struct SpectrumEnds {
  double least = 0, greatest = 0;
  double least_residual = 0, greatest_residual = 0;
  int steps = 0;
  /// greatest + its residual (Zhou and Li 2011, "Bounding the spectrum of large Hermitian matrices").
  double bound() const { return greatest + greatest_residual; }
};

enum class Ends { greatest, both };

/// The extreme Ritz values of the symmetric A in span{v, Av, A²v, …}, every direction orthogonalised against all before
/// (Lanczos): all of A's spectrum that v has a part in. Ends where the residuals of the ends asked for are at most
/// a thousandth of their values, where the span is exhausted, and after `most` steps, one application of A each.
/// `v`: where to start; without components outside the subspace that is looked at. Zeros where v is zero or empty.
SpectrumEnds lanczos(const LinearMap& A, Vector v, int most, Ends ends);

/// A unit vector that no symmetry of a mesh leaves in an invariant subspace: where to start from.
Vector lanczos_start(Eigen::Index n);

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
