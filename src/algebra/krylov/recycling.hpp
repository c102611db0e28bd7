#pragma once

#include "algebra/krylov/conjugate_gradient.hpp"

namespace dotyk::algebra {

/// Successive conjugate gradients for K x_i = b_i, one after the other (Suarjana and Law 1994). The first system with
/// b ≠ 0 is solved by conjugate gradients whose directions p_j are kept, with Â p_j; every further one starts from
/// the solution in their span, Σ p_j p_jᵀb̂, and is completed by conjugate gradients. Directions are kept conjugate by
/// full reorthogonalisation, each against all kept ones (4 n m operations for the m-th). A right-hand side in
/// K span p_j takes no iteration. Memory: 16 n bytes a direction.
class SuccessiveCg {
 public:
  /// `extend`: further systems, too, add their directions, which are then made conjugate to all before.
  SuccessiveCg(const Preconditioner& preconditioner, const CgSettings& settings, bool extend = false)
      : preconditioner_(preconditioner), settings_(settings), extend_(extend) {}

  CgResult solve(const Vector& b, Monitor& monitor) {
    const bool store = extend_ || basis_.count() == 0;
    return conjugate_gradient(preconditioner_, b, settings_, monitor, {.basis = &basis_, .store = store});
  }
  const ConjugateBasis& basis() const { return basis_; }

 private:
  const Preconditioner& preconditioner_;
  CgSettings settings_;
  bool extend_;
  ConjugateBasis basis_;
};

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
  const Vector& values() const { return values_; }  ///< the Ritz values chosen
  double loss() const { return loss_; }  ///< of orthogonality, see LanczosRecord
  double greatest_bytes() const { return bytes_; }  ///< while the Lanczos vectors were there, too

 private:
  void keep_lowest(const LanczosRecord& record);

  const Preconditioner& preconditioner_;
  CgSettings settings_;
  bool deflate_;
  ConjugateBasis basis_;
  Vector values_;
  double loss_ = 0, bytes_ = 0;
};

}  // namespace dotyk::algebra
