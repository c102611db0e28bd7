#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/types.hpp"

namespace dotyk::solver {

/// The greatest s ≥ 0 with ‖u + s p‖ ≤ radius, for ‖u‖ ≤ radius; infinite for p = 0.
template <class U, class P>
double room_in_disc(const Eigen::MatrixBase<U>& u, const Eigen::MatrixBase<P>& p, double radius) {
  const double a = p.squaredNorm(), b = u.dot(p), c = (u.norm() - radius) * (u.norm() + radius);
  if (a == 0) return std::numeric_limits<double>::infinity();
  // The root of as² + 2bs + c, in the form without cancellation.
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return std::max(0.0, b > 0 ? -c / (b + root) : (root - b) / a);
}

}  // namespace dotyk::solver
