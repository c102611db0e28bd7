#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// Vectors p_1 … p_m with p_iᵀ Â p_j = δ_ij (the columns of P) and their products w_i = Â p_i, Â symmetric positive
/// definite: a subspace in which Â x = b is solved by projections alone. Keeps 16 n m bytes.
class ConjugateBasis {
 public:
  Eigen::Index count() const { return count_; }
  double bytes() const { return 8.0 * static_cast<double>(p_.size() + w_.size()); }
  auto directions() const { return p_.leftCols(count_); }
  auto products() const { return w_.leftCols(count_); }

  /// p − P Wᵀ p: conjugate to all of them; twice where that takes away half of p. False where the second time takes away
  /// half again (Kahan and Parlett's criterion): p was in their span, what is left is rounding, conjugate to nothing.
  bool conjugate(Vector& p) const;
  /// The solution within the span, x = P Pᵀ r, for the residual r, which becomes r − Â x = r − W Pᵀ r.
  Vector solve(Vector& r) const;
  /// Takes one more, conjugate to the others; `w` = Â p, pᵀw > 0. Throws InputError where memory does not suffice.
  void add(const Vector& p, const Vector& w);

 private:
  DenseMatrix p_, w_;  ///< with room for more columns
  Eigen::Index count_ = 0;
};

/// Room for one more column than `count`, twice as much where there is none left. Throws InputError where memory does
/// not suffice.
void grow(DenseMatrix& columns, Eigen::Index rows, Eigen::Index count);

}  // namespace dotyk::algebra
