#pragma once

#include <optional>
#include <vector>

#include "algebra/direct/cholesky.hpp"
#include "algebra/krylov/lanczos.hpp"
#include "solver/feti/dual_problem.hpp"

namespace dotyk::solver {

/// A positive semidefinite matrix of which some unknowns are held at zero, so many that the rest of it has an inverse.
class HeldFactor {
 public:
  /// Orders and analyses. `lower`: lower triangle, of the pattern of all that are to be factored.
  explicit HeldFactor(const algebra::SparseMatrix& lower);
  /// Factors the rest. False where it is not positive definite to working precision; failed_unknown() then tells where
  /// (-1: nowhere in particular).
  bool factor(const algebra::SparseMatrix& lower, const std::vector<int>& held);
  int failed_unknown() const { return factor_.failed_unknown(); }
  algebra::Vector pivots() const { return factor_.pivots(); }
  /// The inverse of the rest times what the right-hand sides are there; zero where held.
  algebra::DenseMatrix solve(algebra::DenseMatrix right) const;

 private:
  std::vector<int> held_;
  algebra::Cholesky factor_;
};

/// The balance of rigid motions, G̃λ = ẽ, and the projectors that it splits the multipliers by (P2 (3.1)–(3.4)): with
/// C = G̃G̃ᵀ,
///   Q = G̃ᵀC⁻¹G̃,  P = I − Q,     λ̄ = G̃ᵀC⁻¹ẽ.
/// C is singular where a motion of the pieces is noticed by no row, G̃ᵀz = 0. As many modes as there are such motions
/// are then held at zero, those that stop them all, and the rest of C inverted: a generalised inverse, so that Q, P
/// and (ẽ being orthogonal to z, which is for the caller to see to) λ̄ are what they would be with any other.
class CoarseSpace {
 public:
  /// Factors C, its rows and columns scaled to a unit diagonal. G: modes × rows; e: modes.
  CoarseSpace(const algebra::SparseMatrix& G, algebra::Vector e);

  int modes() const { return static_cast<int>(e_.size()); }
  algebra::Vector Q(const algebra::Vector& v) const;
  algebra::Vector P(const algebra::Vector& v) const;
  /// λ̄: of all that balance the load the one of least norm.
  const algebra::Vector& particular() const { return particular_; }
  /// C⁻¹G̃v, the amounts of the modes whose jump G̃ᵀα is nearest to v; zero for modes that are held.
  algebra::Vector amounts(const algebra::Vector& v) const;
  /// ẽ − G̃λ, what λ leaves of the load's resultants.
  algebra::Vector unbalanced(const algebra::Vector& lambda) const;
  /// ‖ẽ − G̃λ̄‖ / ‖ẽ‖: rounding, but where the load drives a motion that no row notices.
  double imbalance() const;
  /// G̃ with rows scaled to norm one and C of it, lower triangle.
  const algebra::SparseMatrix& scaled_G() const { return G_; }
  const algebra::SparseMatrix& C() const { return C_; }
  /// The modes that are held, ascending: as many as there are motions that no row notices.
  const std::vector<int>& held() const { return held_; }

 private:
  /// The least w with G̃w = `scaled` (rows scaled), corrected by what it leaves: where stiff pieces are held by
  /// soft ones, C is as ill conditioned as these are unlike.
  algebra::Vector balancing(const algebra::Vector& scaled) const;

  algebra::SparseMatrix G_;  ///< rows scaled to norm one; zero those that are rounding
  algebra::SparseMatrix C_;
  algebra::Vector scale_, e_, particular_;
  std::vector<int> held_;
  std::optional<HeldFactor> factor_;  ///< of C
};

/// The ends of the spectrum of PFP on the balanced multipliers im P, by at most 60 Lanczos steps there, one application
/// of F each (see algebra::lanczos): bound() is one of ‖PFP‖ from above, greatest/least with both ends asked for of
/// its condition number from below, which exceeds it by little where both have settled. Zeros where P is zero.
algebra::SpectrumEnds dual_spectrum(const DualProblem& dual, const CoarseSpace& coarse, algebra::Ends ends,
                                    Monitor& monitor);

}  // namespace dotyk::solver
