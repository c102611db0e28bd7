#pragma once

#include <limits>

#include "algebra/types.hpp"

namespace dotyk::solver {

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
