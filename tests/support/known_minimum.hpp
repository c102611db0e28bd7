#pragma once

// Quadratic programs over separable sets whose solution is known, since it is chosen first: x, the face it
// lies on and the gradient g there; then b = Ax − g.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "algebra/dense/dense.hpp"
#include "random.hpp"
#include "solver/bounded/mprgp.hpp"

namespace dotyk::test {

using algebra::DenseMatrix;
using algebra::Vector;

inline constexpr double kNoEnd = std::numeric_limits<double>::infinity();

/// Columns that are orthonormal, n × k.
inline DenseMatrix orthonormal(Random& random, int n, int k) {
  return algebra::orthonormal(random.matrix(n, k));
}

/// Eigenvalues from `least` to 1, evenly in their logarithm, in random directions; `kernel` zeros besides.
inline DenseMatrix random_matrix(Random& random, int n, double least, int kernel = 0) {
  const DenseMatrix V = orthonormal(random, n, n);
  Vector values = Vector::Zero(n);
  for (int i = kernel; i < n; ++i) values[i] = std::pow(least, double(n - 1 - i) / double(std::max(1, n - 1 - kernel)));
  return V * values.asDiagonal() * V.transpose();
}

inline solver::LinearMap map(const DenseMatrix& A) {
  return [&A](const Vector& v) -> Vector { return A * v; };
}

enum class Shape { none, low, box, discs, mixed };
inline constexpr Shape kShapes[] = {Shape::none, Shape::low, Shape::box, Shape::discs, Shape::mixed};

/// Ends minimise() where ‖g^P‖ ≤ tol, or after `most` steps.
inline std::function<bool(const solver::Mprgp&)> below(double tol, int most = 10000) {
  return [=](const solver::Mprgp& method) { return method.projected_gradient_norm() <= tol || method.steps() >= most; };
}

/// Steps until until(method), confirmed with g computed anew, or a halt.
inline void minimise(solver::Mprgp& method, const std::function<bool(const solver::Mprgp&)>& until) {
  for (;;) {
    if (until(method)) {
      method.refresh();
      if (until(method)) return;
    }
    if (method.step() == solver::Mprgp::Step::none) return;
  }
}

struct KnownMinimum {
  solver::SeparableSet set;
  Vector x, g;  ///< the solution and the gradient there
};

/// Of every three components or pairs one is free, one active with g ≠ 0 and one active; of the latter a
/// part `degenerate` with g = 0.
inline KnownMinimum known_minimum(Random& random, int n, Shape shape, double degenerate = 0) {
  Vector low = Vector::Constant(n, -kNoEnd), high = Vector::Constant(n, kNoEnd), x = random.vector(n), g = Vector::Zero(n);
  std::vector<solver::SeparableSet::Disc> discs;
  const int first_of_discs = shape == Shape::discs ? 0 : shape == Shape::mixed ? n / 2 : n;
  for (int i = 0; i < first_of_discs && shape != Shape::none; ++i) {
    const bool free = i % 3 == 0, at_high = i % 3 == 2 && shape != Shape::low;
    low[i] = x[i] - (free || at_high ? random.between(0.1, 2) : 0);
    if (shape != Shape::low) high[i] = x[i] + (at_high ? 0 : random.between(0.1, 2));
    if (!free && random.between(0, 1) >= degenerate) g[i] = (at_high ? -1 : 1) * random.between(0.01, 1);
  }
  for (int i = first_of_discs; i + 1 < n; i += 2) {
    const double turn = random.between(0, 6.28), radius = random.between(0.2, 2);
    const Eigen::Vector2d outward(std::cos(turn), std::sin(turn));
    const bool free = i / 2 % 3 == 0;
    const Eigen::Vector2d centre = x.segment<2>(i) - (free ? 0.5 : 1) * radius * outward;
    discs.push_back({i, i + 1, centre, radius});
    if (!free && random.between(0, 1) >= degenerate) g.segment<2>(i) = -random.between(0.01, 1) * outward;
  }
  return {solver::SeparableSet(low, high, discs), x, g};
}

}  // namespace dotyk::test
