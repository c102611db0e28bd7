#include "problem/solvability.hpp"

#include <cmath>

#include "algebra/bounded_least_squares.hpp"

namespace dotyk::problem {

using algebra::Vector;

namespace {

/// Work below this part of the load's size counts as none: rounding of Rᵀf and of the modes.
constexpr double kRounding = 1e-10;
/// A load this close (as an angle) to the edge of what can be carried is a limit case.
constexpr double kLimit = 1e-6;

Vector unit(const Vector& v) { return v / v.lpNorm<Eigen::Infinity>(); }

/// What of the load e no admissible multipliers balance: the admissible motion it drives most.
Vector unbalanced(const RigidMotions& rigid, const Problem& problem, const Vector& e) {
  Vector low(problem.rows()), high(problem.rows());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const Interval bounds = group.law->multipliers(r - group.first);
      low[r] = bounds.low;
      high[r] = bounds.high;
    }
  // What no row notices, no row balances; rounding in N must not seem to.
  const auto noticed = algebra::bounded_least_squares((rigid.N * rigid.noticed).transpose(),
                                                      rigid.noticed.transpose() * e, low, high);
  return rigid.noticed * noticed.residual + rigid.unnoticed * (rigid.unnoticed.transpose() * e);
}

/// The middle of what unilateral rows can carry, unit length; zero where there are none.
Vector middle_load(const RigidMotions& rigid, const Problem& problem) {
  Vector sum = Vector::Zero(rigid.count());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (group.law->unilateral()) sum += rigid.N.row(r).transpose();
  return sum.norm() > 0 ? Vector(sum / sum.norm()) : sum;
}

}  // namespace

Solvability solvability(const RigidMotions& rigid, const Problem& problem) {
  Solvability s;
  if (rigid.count() == 0) return s;
  const double load = rigid.e.norm();
  const Vector residual = load > 0 ? unbalanced(rigid, problem, rigid.e) : Vector::Zero(rigid.count());
  if (residual.norm() > kRounding * load) {
    s.verdict = Solvability::Verdict::unsolvable;
    s.limit = residual.norm() < kLimit * load;
    s.motion = unit(residual);
    s.work = rigid.e.dot(s.motion);
    return s;
  }
  // Towards the edge: take a little of the middle load away and see whether the rest still balances.
  const Vector middle = middle_load(rigid, problem);
  const Vector turned = rigid.e - kLimit * (load > 0 ? load : 1) * middle;
  const Vector edge = middle.norm() > 0 ? unbalanced(rigid, problem, turned) : Vector::Zero(rigid.count());
  s.limit = edge.norm() > 1e-3 * kLimit * (load > 0 ? load : 1);
  if (rigid.unnoticed.cols() > 0) {
    s.verdict = Solvability::Verdict::up_to_motion;
    s.motion = unit(rigid.unnoticed.col(0));
  } else if (s.limit) {
    s.verdict = Solvability::Verdict::up_to_motion;
    s.motion = unit(edge);
    s.work = rigid.e.dot(s.motion);
  }
  return s;
}

}  // namespace dotyk::problem
