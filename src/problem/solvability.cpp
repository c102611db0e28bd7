#include "problem/solvability.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra/bounded_least_squares.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Work below this part of the load's size counts as none: rounding of Rᵀf and of the modes.
constexpr double kRounding = 1e-10;
/// Work below this part of what its terms would do without cancelling is none: rounding of Rᵀf over many nodes.
constexpr double kCancelled = 1e-13;
/// A load this close (as an angle) to the edge of what can be carried is a limit case.
constexpr double kLimit = 1e-6;

Vector unit(const Vector& v) { return v / v.lpNorm<Eigen::Infinity>(); }

/// Loads on the rigid motions that the laws can carry, as columns with bounds on their amounts.
struct Carried {
  std::vector<Vector> columns;
  std::vector<double> low, high;
  void add(const Vector& column, double from, double to) {
    columns.push_back(column);
    low.push_back(from);
    high.push_back(to);
  }
};

Carried carried_by_rows(const DenseMatrix& N, const Problem& problem) {
  Carried all;
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const Interval bounds = group.law->multipliers(r - group.first);
      all.add(N.row(r), bounds.low, bounds.high);
    }
  return all;
}

/// Adds what a friction point can carry in the tangential direction d: an amount up to the bound
/// (given friction), or with the normal force, along the edge of the cone (Coulomb).
void add_direction(const DenseMatrix& N, const FrictionGroup& group, int point, const Vector& d, Carried& all) {
  const Vector tangential = N.middleRows(group.row(point), group.components).transpose() * d;
  const double slope = group.law->bound_slope(point);
  if (slope > 0)
    all.add(N.row(group.normal[point]).transpose() + slope * tangential, 0, Law::kUnbounded);
  else
    all.add(tangential, 0, group.law->bound(point, 0));
}

/// What of the load e no admissible multipliers balance: the admissible motion it drives most (TR965
/// (1.70), with friction (3.30)). Friction in space carries forces in every tangential direction:
/// directions are added where the motion found still rubs.
Vector unbalanced(const RigidMotions& rigid, const Problem& problem, const Vector& e) {
  // What no row notices, no row balances; rounding in N must not seem to.
  const DenseMatrix& N = rigid.noticed_N;
  Carried all = carried_by_rows(N, problem);
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      for (int i = 0; i < group.components; ++i)
        for (double sign : {1.0, -1.0}) add_direction(N, group, k, sign * Vector::Unit(group.components, i), all);
  Vector residual;
  for (int round = 0; round < 30; ++round) {
    const auto count = static_cast<Eigen::Index>(all.columns.size());
    DenseMatrix A(N.cols(), count);
    for (Eigen::Index j = 0; j < count; ++j) A.col(j) = all.columns[j];
    residual = algebra::bounded_least_squares(A, rigid.noticed.transpose() * e,
                                              Eigen::Map<const Vector>(all.low.data(), count),
                                              Eigen::Map<const Vector>(all.high.data(), count)).residual;
    if (residual.norm() <= kRounding * e.norm()) break;
    const std::size_t before = all.columns.size();
    for (const FrictionGroup& group : problem.friction) {
      if (group.components == 1) continue;  // both directions are there
      for (int k = 0; k < group.points(); ++k) {
        const Vector rub = N.middleRows(group.row(k), group.components) * residual;
        const double along_axes = rub.lpNorm<Eigen::Infinity>();
        if (rub.norm() > (1 + 1e-9) * along_axes) add_direction(N, group, k, rub / rub.norm(), all);
      }
    }
    if (all.columns.size() == before || all.columns.size() > 20000) break;
  }
  return rigid.noticed * residual + rigid.unnoticed * (rigid.unnoticed.transpose() * e);
}

/// From the load towards the middle of what rows with limits can carry, unit length; zero where there are none.
Vector inwards(const RigidMotions& rigid, const Problem& problem, double load) {
  Vector middle = Vector::Zero(rigid.count()), rays = middle;
  bool limits = false;
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const auto [low, high] = group.law->multipliers(r - group.first);
      const bool below = std::isfinite(low), above = std::isfinite(high);
      limits = limits || below || above;
      const double base = below && above ? (low + high) / 2 : below ? low : above ? high : 0;
      middle += base * rigid.N.row(r).transpose();
      if (below != above) rays += (below ? 1 : -1) * rigid.N.row(r).transpose();
    }
  if (!limits) return Vector::Zero(rigid.count());
  Vector in = middle - rigid.e;
  if (rays.norm() > 0) in += load * rays / rays.norm();
  return in.norm() > 0 ? Vector(in / in.norm()) : in;
}

/// What is left unbalanced of a load turned by kLimit towards the nearest edge of what can be carried; zero where that
/// is balanced. Ten times as much away from the middle shows the motion that this edge is the end of; the
/// shortest way to the edge is along that motion.
Vector beyond_edge(const RigidMotions& rigid, const Problem& problem, double load) {
  const Vector in = inwards(rigid, problem, load), none = Vector::Zero(rigid.count());
  if (in.norm() == 0) return none;
  const double least = 1e-3 * kLimit * load;
  const Vector motion = unbalanced(rigid, problem, rigid.e - 10 * kLimit * load * in);
  if (motion.norm() <= least) return none;
  const Vector left = unbalanced(rigid, problem, rigid.e + kLimit * load * motion / motion.norm());
  return left.norm() > least ? left : none;
}

/// The load's size on the rigid motions; zero where that is rounding of sums that cancel.
double net_load(const RigidMotions& rigid, const Problem& problem) {
  double gross = 0;
  for (const Block& block : problem.blocks)
    if (block.kernel.size() > 0)
      gross = std::max(gross, (block.kernel.cwiseAbs().transpose() * block.f.cwiseAbs()).maxCoeff());
  return rigid.e.lpNorm<Eigen::Infinity>() > kCancelled * gross ? rigid.e.norm() : 0;
}

}  // namespace

Solvability solvability(const RigidMotions& rigid, const Problem& problem) {
  Solvability s;
  if (rigid.count() == 0) return s;
  const double load = net_load(rigid, problem);
  const Vector residual = load > 0 ? unbalanced(rigid, problem, rigid.e) : Vector::Zero(rigid.count());
  if (residual.norm() > kRounding * load) {
    s.verdict = Solvability::Verdict::unsolvable;
    s.limit = residual.norm() < kLimit * load;
    s.motion = unit(residual);
    s.work = rigid.e.dot(s.motion);
    return s;
  }
  const Vector edge = beyond_edge(rigid, problem, load > 0 ? load : 1);
  s.limit = edge.norm() > 0;
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
