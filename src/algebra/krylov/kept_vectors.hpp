#pragma once

#include "algebra/types.hpp"

// What a run of conjugate gradients leaves to those that follow.

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

/// The Lanczos vectors q_i = r_i/‖r_i‖ of a run of conjugate gradients on Â and the tridiagonal T = Qᵀ Â Q,
/// P7 (8)–(9). With r_iᵀÂp_i = p_iᵀÂp_i and r_iᵀÂp_{i-1} = −‖r_i‖²/α_{i-1} the formulae (9) are
///   T_ii = 1/α_i + β_{i-1}/α_{i-1},   T_{i,i+1} = −‖r_{i+1}‖/(α_i ‖r_i‖).
/// Every residual is orthogonalised against all before it (full reorthogonalisation, 4 n i operations in step i):
/// without it the vectors of converged eigenvalues come back. Keeps 8 n bytes a step.
class LanczosRecord {
 public:
  /// The first residual.
  void start(const Vector& r);
  /// After a step of length α, with the next residual, which is orthogonalised.
  void advance(double alpha, Vector& r);

  Eigen::Index steps() const { return steps_; }
  Vector diagonal() const { return diagonal_.head(steps_); }
  Vector off_diagonal() const { return off_.head(steps_ > 0 ? steps_ - 1 : 0); }
  /// T_{m,m+1}: a Ritz pair (θ, Q s) has the residual |T_{m,m+1} s_m|.
  double last_coupling() const { return steps_ > 0 ? off_[steps_ - 1] : 0; }
  auto vectors() const { return q_.leftCols(steps_); }
  /// The greatest |q_iᵀ r|/‖r‖ met before orthogonalisation: what one step loses.
  double loss() const { return loss_; }
  double bytes() const { return 8.0 * static_cast<double>(q_.size()); }

 private:
  void append(const Vector& r);

  DenseMatrix q_;          ///< with room for more columns; one more than steps_ in use
  Vector diagonal_, off_;  ///< likewise
  Eigen::Index steps_ = 0;
  double norm_ = 0, alpha_ = 0, beta_ = 0, loss_ = 0;  ///< norm_: ‖r_i‖; alpha_, beta_: of the step before
};

}  // namespace dotyk::algebra
