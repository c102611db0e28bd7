#include "contact/ball_gap.hpp"

#include <cmath>

namespace dotyk::contact {
namespace {

using mesh::Point;
using mesh::dot;
using mesh::minus;

constexpr double kSteep = 0.8 * 0.8;  ///< (ρ/R)² up to which s is the circle's

/// s(ρ²) of a unit ball, and its derivative.
struct Height {
  double s, ds;
};

Height height(double q) {
  if (q <= kSteep) {
    const double s = std::sqrt(1 - q);
    return {s, -0.5 / s};
  }
  const double decay = 0.5 / (1 - kSteep), s = std::sqrt(1 - kSteep) * std::exp(-decay * (q - kSteep));
  return {s, -decay * s};
}

/// What the formula is made of.
struct Parts {
  Parts(const RigidBall& ball, const Point& x, const Point& n) : w(minus(ball.center, x)), c(dot(w, n)), far(mesh::length(w)) {
    const Point off = minus(w, mesh::times(c, n));
    of_unit = height(dot(off, off) / (ball.radius * ball.radius));
    below = c + ball.radius * of_unit.s;
  }
  Point w;
  double c, far, below;
  Height of_unit;
};

}  // namespace

double ball_gap(const RigidBall& ball, const Point& x, const Point& n) {
  const Parts p(ball, x, n);
  return p.c > 0 ? (p.far - ball.radius) * (p.far + ball.radius) / p.below : p.far - ball.radius;
}

double ball_gap_derivative(const RigidBall& ball, const Point& x, const Point& n, const Point& v, const Point& dn) {
  const Parts p(ball, x, n);
  const double dsquare = -2 * dot(p.w, v), dc = dot(p.w, dn) - dot(v, n);
  if (!(p.c > 0)) return dsquare / (2 * p.far);
  const double gap = (p.far - ball.radius) * (p.far + ball.radius) / p.below;
  return (dsquare - gap * (dc + p.of_unit.ds / ball.radius * (dsquare - 2 * p.c * dc))) / p.below;
}

}  // namespace dotyk::contact
