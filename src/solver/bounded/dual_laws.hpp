#pragma once

#include <limits>

#include "solver/bounded/separable_set.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// What the laws let the multipliers be, as a set for the scaled and shifted ones x = λ/D − λ̄ of a dual problem:
/// its first rows are those of `problem`, the others (gluing, supports) are free. `scale`: D, one a row of
/// `problem`, the same throughout a friction point; `bounds`: of every friction point (friction_bounds); kNoSlip does not bound.
SeparableSet admissible(const problem::Problem& problem, const algebra::Vector& scale, const algebra::Vector& bounds,
                        const algebra::Vector& shift);

/// Of every row, 1/k of a law of one spring; 0 for rigid rows and those that carry nothing.
algebra::Vector law_compliance(const problem::Problem& problem);

/// Has a row of the problem a law of two springs (problem::kinked_at_zero)?
bool has_two_springs(const problem::Problem& problem);

/// The same problem with two opposed one-sided springs for each such row, the one for x > 0 in its place and the one for
/// x < 0 behind all rows (P4, remark 7): for methods that want φ* of one parabola.
struct OpposedSprings {
  problem::Problem problem;
  std::vector<int> from;  ///< of each row, the one that it is or was split from
};
OpposedSprings opposed_springs(const problem::Problem& whole);

/// A result of a split problem as one of the problem of so many rows: both multipliers of a row, active where one of its springs is.
Result joined(Result result, const std::vector<int>& from, int rows);

/// The bounds b of Coulomb's friction in a loop over given friction: b ← b + s(b' − b), b' what the normal multipliers of
/// the solution with b make of them. s is halved where the change has not fallen by a tenth for some steps.
class SettlingBounds {
 public:
  /// They may be kNoSlip: then b ← b' the first time.
  explicit SettlingBounds(algebra::Vector first = {}) : now_(std::move(first)) {}
  const algebra::Vector& now() const { return now_; }
  /// False where they have not settled with the least s.
  bool follow(const algebra::Vector& next);
  /// ‖b' − b‖/‖b'‖ of the last step, 1 before.
  double change() const { return change_; }

 private:
  algebra::Vector now_;
  double change_ = 1, best_ = std::numeric_limits<double>::infinity(), step_ = 1;
  int since_best_ = 0;
};

}  // namespace dotyk::solver
