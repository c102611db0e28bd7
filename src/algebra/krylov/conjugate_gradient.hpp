#pragma once

#include <limits>
#include <string>

#include "algebra/krylov/preconditioner.hpp"
#include "algebra/types.hpp"
#include "base/monitor.hpp"

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

struct CgSettings {
  double tolerance = 1e-6;  ///< of ‖b − K x‖ / ‖b‖, formed anew from x before a run ends
  int most = 0;             ///< iterations; 0: ten times the unknowns and a hundred
  int limit(Eigen::Index unknowns) const { return most > 0 ? most : static_cast<int>(10 * unknowns + 100); }
};

struct CgResult {
  Vector x;
  int iterations = 0;
  double residual = 0;  ///< ‖b − K x‖ / ‖b‖; 0 for b = 0
  bool converged = false;
  std::string reason;
};

/// What earlier systems with K left, and what this one is to leave.
struct CgMemory {
  ConjugateBasis* basis = nullptr;  ///< where it starts: the solution in the span of it, of vectors of Â
  bool conjugate = false;           ///< also every direction is made conjugate to the basis: deflation
  bool store = false;               ///< the directions join the basis; implies `conjugate`
  LanczosRecord* record = nullptr;  ///< gets residuals and coefficients, and orthogonalises the residuals
};

/// No run lowers ‖b − K x‖ further than to this part of ‖b‖.
constexpr double kCgRounding = 32 * std::numeric_limits<double>::epsilon();

/// Preconditioned conjugate gradients for K x = b: on Â x̂ = b̂ (see Preconditioner), from x = 0 or from what the
/// basis gives. ‖r‖ = ‖C r̂‖, half a product with K, is formed in each eighth step and wherever its last ratio
/// to ‖r̂‖ says that the goal is within a factor 4. Where b − K x formed from x misses the goal that the recurrence
/// met, x is corrected by a further run; where that does not halve it the reason is rounding. No run goes further than by 32 ε,
/// nor on where the next direction is in the basis's span but for rounding. Nothing to do for b = 0.
/// After a stop (Monitor), or `most` iterations, the iterate reached is returned with converged = false. Throws
/// InputError where b is not finite and where a direction shows that K is not positive definite.
CgResult conjugate_gradient(const Preconditioner& preconditioner, const Vector& b, const CgSettings& settings,
                            Monitor& monitor, const CgMemory& memory = {});

}  // namespace dotyk::algebra
