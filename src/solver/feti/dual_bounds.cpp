#include "solver/feti/dual_bounds.hpp"

#include <cmath>

#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

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
      if (!std::isfinite(bound)) continue;
      if (group.components == 1)
        interval(r, -bound, bound);
      else
        discs.push_back({r, r + 1, {-shift[r], -shift[r + 1]}, bound / scale[r]});
    }
  return SeparableSet(std::move(low), std::move(high), std::move(discs));
}

Vector first_bounds(const Problem& problem) {
  Vector bounds = friction_bounds(problem, Vector::Zero(problem.rows()));
  Eigen::Index point = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k, ++point)
      if (group.law->bound_slope(k) > 0) bounds[point] = INFINITY;
  return bounds;
}

}  // namespace dotyk::solver
