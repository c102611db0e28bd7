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

}  // namespace dotyk::algebra
