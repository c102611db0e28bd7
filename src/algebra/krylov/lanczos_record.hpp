#pragma once

#include "algebra/types.hpp"

namespace dotyk::algebra {

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
