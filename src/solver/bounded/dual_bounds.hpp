#pragma once

#include <limits>

#include "problem/problem.hpp"
#include "solver/bounded/separable_set.hpp"

namespace dotyk::solver {

/// What the laws let the multipliers be, as a set for the scaled and shifted ones x = λ/D − λ̄ of a dual problem:
/// its first rows are those of `problem`, the others (gluing, supports) are free. `scale`: D, one a row of
/// `problem`, the same throughout a friction point; `bounds`: of every friction point (friction_bounds); kNoSlip does not bound.
SeparableSet admissible(const problem::Problem& problem, const algebra::Vector& scale, const algebra::Vector& bounds,
                        const algebra::Vector& shift);

/// Of every row, 1/k of a law of one spring; 0 for rigid rows and those that carry nothing.
algebra::Vector law_compliance(const problem::Problem& problem);

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
