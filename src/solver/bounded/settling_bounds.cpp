#include "solver/bounded/settling_bounds.hpp"

#include <algorithm>

#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;

namespace {

/// Steps in which the change must fall by a tenth.
constexpr int kBoundsPatience = 8;
constexpr double kLeastStep = 1.0 / 32;

}  // namespace

bool SettlingBounds::follow(const Vector& next) {
  const double size = next.stableNorm();
  const bool bounded = (now_.array() < kNoSlip).all();
  change_ = bounded ? (next - now_).stableNorm() / (size > 0 ? size : 1) : 1;
  now_ = bounded ? Vector(now_ + step_ * (next - now_)) : next;
  since_best_ = change_ < 0.9 * best_ ? 0 : since_best_ + 1;
  best_ = std::min(best_, change_);
  if (since_best_ == 0 || since_best_ % kBoundsPatience != 0) return true;
  if (step_ <= kLeastStep) return false;
  step_ /= 2;
  return true;
}

}  // namespace dotyk::solver
