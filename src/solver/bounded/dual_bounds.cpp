#include "solver/bounded/dual_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

namespace {

/// Steps in which the change must fall by a tenth.
constexpr int kBoundsPatience = 8;
constexpr double kLeastStep = 1.0 / 32;

}  // namespace

SeparableSet admissible(const Problem& problem, const Vector& scale, const Vector& bounds, const Vector& shift) {
  Vector low = Vector::Constant(shift.size(), -INFINITY), high = Vector::Constant(shift.size(), INFINITY);
  std::vector<SeparableSet::Disc> discs;
  const auto interval = [&](int r, double least, double greatest) {
    low[r] = least / scale[r] - shift[r];
    high[r] = greatest / scale[r] - shift[r];
  };
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const problem::Interval m = group.law->multipliers(r - group.first);
      interval(r, m.low, m.high);
    }
  Eigen::Index point = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k, ++point) {
      const int r = group.row(k);
      const double bound = bounds[point];
      if (!(bound < kNoSlip)) continue;
      if (group.components == 1)
        interval(r, -bound, bound);
      else
        discs.push_back({r, r + 1, {-shift[r], -shift[r + 1]}, bound / scale[r]});
    }
  return SeparableSet(std::move(low), std::move(high), std::move(discs));
}

Vector law_compliance(const Problem& problem) {
  Vector compliance = Vector::Zero(problem.rows());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (const double k = group.law->springs(r - group.first).value().above; k > 0) compliance[r] = 1 / k;
  return compliance;
}

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
