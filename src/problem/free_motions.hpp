#pragma once

#include "problem/measure.hpp"
#include "problem/rigid_motions.hpp"

namespace dotyk::problem {

/// The rigid motions r that lead from one solution to others with the same multipliers: K r = 0 and x + B r ∈ ∂φ*(λ), row by row.
/// Without Coulomb friction these are all solutions (the saddle points of a convex problem are a product of two sets), and Kr = 0
/// makes the stress unique. TR965's theorem 3.3 says so before solving where |S(w)| > j(w), (3.31); this says it after.
struct FreeMotions {
  int count = 0;  ///< of independent motions that rows which hold leave free and some row notices
  /// These, amounts of the modes, modes × count, greatest 1, and beside them those that no row notices; of more than kMostFree neither.
  algebra::SparseMatrix motions, unnoticed;
  /// Of up to kMostModes motions how far they may go together, β in units of them: limits β ≤ slack, with slack ≥ 0.
  algebra::SparseRows limits;
  algebra::Vector slack;
  /// How far the k-th may go alone from β: low ≤ 0 ≤ high, ±∞ where nothing stops it.
  Interval range(int k, const algebra::Vector& from) const;
  /// Where none is free, of up to kMostModes modes: the motion that rows which hold resist least, greatest amount 1, and the greatest
  /// jump that it makes on one of them. Modes have greatest displacement 1.
  algebra::Vector weakest;
  double grip = 0;
};
inline constexpr int kMostModes = 30, kMostFree = 600;

/// Which forces of a state are none.
class NoForce {
 public:
  /// `measure` must outlive the object.
  NoForce(const Problem& problem, const Measure& measure, const algebra::Vector& lambda, double tolerance);
  /// Is a force that is beyond what its row bears anyhow, while the row is open by `gap` there? If it is small(), or on an open row no more than
  /// what a method leaves.
  bool operator()(int row, double force, double gap) const;
  /// `tolerance` of the greatest |λ| on a body that the row touches, of two bodies the lesser, as forces on one body do not say what is small for
  /// another; at least rounding of F.
  double small(int row) const { return small_[row]; }

 private:
  const Measure& measure_;
  double tolerance_;
  algebra::Vector small_;
};

/// `tolerance`: of NoForce; multipliers so near to a bound are on it. `springs_hold`: do rows of linear springs hold what moves them?
FreeMotions free_motions(const Problem& problem, const State& state, double tolerance, bool springs_hold = true);

}  // namespace dotyk::problem
