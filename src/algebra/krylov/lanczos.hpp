#pragma once

#include "algebra/linear_map.hpp"

namespace dotyk::algebra {

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

}  // namespace dotyk::algebra
