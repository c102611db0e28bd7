#include "solver/bounded/face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/rows/disc.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

namespace {

/// A point this close to its circle (relative) is on it: projections end there up to rounding.
constexpr double kOnCircle = 1e-13;

/// Multipliers around λ on which φ* is one parabola.
problem::Interval parabola(const problem::Law& law, int row, double lambda) {
  problem::Interval interval = law.multipliers(row);
  if (!problem::kinked_at_zero(law, row)) return interval;
  if (lambda >= 0) interval.low = std::max(interval.low, 0.0);
  if (lambda <= 0) interval.high = std::min(interval.high, 0.0);
  return interval;
}

}  // namespace

Face::Face(const Problem& problem, const Vector& lambda, const Vector& x, const Vector& rho, const Vector& bounds)
    : problem_(problem), lambda_(lambda), gradient_(Vector::Zero(lambda.size())), added_(Vector::Zero(lambda.size())),
      free_(lambda.size(), 0) {
  add_rows(x, rho);
  add_discs(x, bounds);
}

void Face::add_rows(const Vector& x, const Vector& rho) {
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const problem::Interval interval = parabola(*group.law, r - group.first, lambda_[r]);
      if (!(lambda_[r] > interval.low && lambda_[r] < interval.high)) continue;
      // φ* is a parabola within the interval: P(λ) = s (λ + const) has its second derivative, and its first.
      const problem::Projection p = group.law->project(r - group.first, lambda_[r], rho[r]);
      if (!(p.slope > 0)) continue;
      free_[r] = 1;
      added_[r] = (1 - p.slope) / (p.slope * rho[r]);
      gradient_[r] = x[r] - added_[r] * lambda_[r] - (p.slope * lambda_[r] - p.lambda) / (p.slope * rho[r]);
    }
}

void Face::add_discs(const Vector& x, const Vector& bounds) {
  Eigen::Index point = 0;
  for (const FrictionGroup& group : problem_.friction)
    for (int k = 0; k < group.points(); ++k, ++point) {
      const int first = group.row(k), d = group.components;
      const double bound = bounds[point];
      const auto own = lambda_.segment(first, d);
      if (!(bound > 0)) continue;
      const bool circle = own.norm() >= (1 - kOnCircle) * bound;
      Vector gradient = x.segment(first, d);
      if (circle) {
        const Vector outward = own / own.norm();
        const double push = gradient.dot(outward);
        if (push < 0) continue;
        gradient -= push * outward;
        if (d == 1) continue;  // no way along
        added_.segment(first, d).setConstant(push / bound);
      }
      gradient_.segment(first, d) = gradient;
      std::fill_n(free_.begin() + first, d, circle ? 2 : 1);
      discs_.push_back({first, d, bound, circle});
    }
}

Vector Face::tangential(Vector v) const {
  for (Eigen::Index r = 0; r < v.size(); ++r)
    if (!free_[r]) v[r] = 0;
  for (const Disc& disc : discs_) {
    if (!disc.circle) continue;
    const auto own = lambda_.segment(disc.first, disc.count);
    auto part = v.segment(disc.first, disc.count);
    part -= part.dot(own) / own.squaredNorm() * own;
  }
  return v;
}

double Face::room(const Vector& p) const {
  double room = std::numeric_limits<double>::infinity();
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      if (!free_[r] || p[r] == 0) continue;
      const problem::Interval interval = parabola(*group.law, r - group.first, lambda_[r]);
      room = std::min(room, ((p[r] > 0 ? interval.high : interval.low) - lambda_[r]) / p[r]);
    }
  for (const Disc& disc : discs_) {
    const auto own = lambda_.segment(disc.first, disc.count), step = p.segment(disc.first, disc.count);
    if (disc.circle && !step.isZero(0)) room = std::min(room, disc.bound / step.norm());
    if (!disc.circle) room = std::min(room, room_in_disc(own, step, disc.bound));
  }
  return room;
}

Vector Face::along(double step, const Vector& p) const {
  Vector lambda = lambda_ + step * p;
  for (const Disc& disc : discs_) {
    auto own = lambda.segment(disc.first, disc.count);
    const double length = own.norm();
    if (disc.circle || length > disc.bound) own *= disc.bound / length;
  }
  return lambda;
}

}  // namespace dotyk::solver
