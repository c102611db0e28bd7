#pragma once

#include "algebra/krylov/conjugate_gradient.hpp"

namespace dotyk::algebra {

/// How many of the eigenvalues, ascending, lie before the largest gap: arg max l(i+1)/l(i), 10 ≤ i ≤ 30 (P7); of
/// fewer than 11 values over all i, and 1 of one.
int number_by_gap(const Vector& values);

/// CGLAN for K x_i = b_i, one after the other (P7, section 2). The first system with b ≠ 0 is solved by conjugate
/// gradients that leave the Lanczos vectors Q and T of Â (see LanczosRecord). Q times the lowest eigenvectors of T, as
/// many as number_by_gap says, are Ritz vectors of Â; made conjugate to one another they give every further system the
/// start in their span, which has nothing left along them. Q is then freed: 16 n bytes for each of these 10 to 30
/// vectors are kept.
class Cglan {
 public:
  /// `deflate`: the iterations, too, stay conjugate to these vectors: what rounding and their inexactness bring back
  /// is taken out. Else they serve the start alone, as in the paper.
  Cglan(const Preconditioner& preconditioner, const CgSettings& settings, bool deflate)
      : preconditioner_(preconditioner), settings_(settings), deflate_(deflate) {}

  CgResult solve(const Vector& b, Monitor& monitor);

  const ConjugateBasis& basis() const { return basis_; }
  /// The Ritz values chosen, and the norms ‖Â y − θ y‖ of their vectors' residuals.
  const Vector& values() const { return values_; }
  const Vector& residuals() const { return residuals_; }
  double loss() const { return loss_; }  ///< of orthogonality, see LanczosRecord
  double greatest_bytes() const { return bytes_; }  ///< while the Lanczos vectors were there, too

 private:
  void keep_lowest(const LanczosRecord& record);

  const Preconditioner& preconditioner_;
  CgSettings settings_;
  bool deflate_;
  ConjugateBasis basis_;
  Vector values_, residuals_;
  double loss_ = 0, bytes_ = 0;
};

}  // namespace dotyk::algebra
