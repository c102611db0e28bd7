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

/// Given friction in space: a disc, which columns with bounds cannot tell.
bool is_disc(const FrictionGroup& group, int point) { return group.components > 1 && group.law->bound_slope(point) == 0; }

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

/// Calls visit(group, point) for every friction point, those that are discs or the others.
template <class Visit>
void for_each_point(const Problem& problem, bool discs, Visit&& visit) {
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      if (is_disc(group, k) == discs) visit(group, k);
}

/// The loads that all discs together carry, a convex set: its convex combinations of the extreme loads found so far.
class Discs {
 public:
  Discs(const DenseMatrix& N, const Problem& problem) : N_(N), problem_(problem) {
    for_each_point(problem, true, [&](auto&, int) { any_ = true; });
    if (any_) extremes_.push_back(Vector::Zero(N.cols()));
  }
  bool any() const { return any_; }

  /// The load with the greatest work on a motion.
  Vector extreme(const Vector& motion) const {
    Vector sum = Vector::Zero(N_.cols());
    for_each_point(problem_, true, [&](const FrictionGroup& group, int k) {
      const auto rows = N_.middleRows(group.row(k), group.components);
      const Vector rub = rows * motion;
      const double length = rub.norm();
      if (length > 0) sum += rows.transpose() * (group.law->bound(k, 0) / length * rub);
    });
    return sum;
  }
  void add(Vector extreme) { extremes_.push_back(std::move(extreme)); }
  /// Only extreme loads with an amount are kept: those in use are linearly independent.
  void keep(const Vector& amounts) {
    std::size_t kept = 0;
    for (std::size_t j = 0; j < extremes_.size(); ++j)
      if (amounts[static_cast<Eigen::Index>(j)] > 0) std::swap(extremes_[kept++], extremes_[j]);
    extremes_.resize(kept);
  }

  /// Columns whose amounts are not negative, below them a row that wants their sum to be 1: missed with the load, and
  /// met where that is balanced. `weight`: above the loads' size.
  DenseMatrix columns(double weight) const {
    DenseMatrix A(N_.cols() + 1, static_cast<Eigen::Index>(extremes_.size()));
    for (Eigen::Index j = 0; j < A.cols(); ++j) A.col(j) << extremes_[j], weight;
    return A;
  }

 private:
  const DenseMatrix& N_;
  const Problem& problem_;
  bool any_ = false;
  std::vector<Vector> extremes_;
};

/// The load that no admissible multipliers balance, found by columns as they are needed.
class Balance {
 public:
  Balance(const DenseMatrix& N, const Problem& problem, Vector e)
      : N_(N), problem_(problem), e_(std::move(e)), all_(carried_by_rows(N, problem)), discs_(N, problem) {
    for_each_point(problem, false, [&](const FrictionGroup& group, int k) {
      for (int i = 0; i < group.components; ++i)
        for (double sign : {1.0, -1.0}) add_direction(N, group, k, sign * Vector::Unit(group.components, i), all_);
    });
  }

  Vector unbalanced() {
    constexpr int kRounds = 60;
    for (int round = 0; round < kRounds; ++round) {
      fit();
      if (residual_.norm() <= kRounding * e_.norm() || all_.columns.size() > 20000) break;
      const bool rubs = add_rubbing(), further = discs_.any() && add_extreme();
      if (!rubs && !further) break;
    }
    // The motion proves that there is no balance where the load does more work on it than all that resists.
    const bool proved = !discs_.any() || residual_.squaredNorm() > gap_;
    return proved ? residual_ : Vector::Zero(e_.size());
  }

 private:
  void fit() {
    const auto rows = N_.cols(), count = static_cast<Eigen::Index>(all_.columns.size());
    const double weight = 10 * std::max(e_.norm(), size_);
    const DenseMatrix D = discs_.any() ? discs_.columns(weight) : DenseMatrix(rows, 0);
    DenseMatrix A = DenseMatrix::Zero(D.rows(), count + D.cols());
    for (Eigen::Index j = 0; j < count; ++j) A.col(j).head(rows) = all_.columns[j];
    A.rightCols(D.cols()) = D;
    Vector b = Vector::Constant(D.rows(), weight), low = Vector::Zero(A.cols()), high = Vector::Constant(A.cols(), Law::kUnbounded);
    b.head(rows) = e_;
    low.head(count) = Eigen::Map<const Vector>(all_.low.data(), count);
    high.head(count) = Eigen::Map<const Vector>(all_.high.data(), count);
    const auto fitted = algebra::bounded_least_squares(A, b, low, high);
    residual_ = fitted.residual.head(rows);
    carried_ = D.topRows(rows) * fitted.x.tail(D.cols());
    missed_ = discs_.any() ? weight * fitted.residual[rows] : 0;
    discs_.keep(fitted.x.tail(D.cols()));
  }

  /// Coulomb's points: directions where the motion found still rubs, off those that are there.
  bool add_rubbing() {
    const std::size_t before = all_.columns.size();
    for_each_point(problem_, false, [&](const FrictionGroup& group, int k) {
      if (group.components == 1) return;  // both directions are there
      const Vector rub = N_.middleRows(group.row(k), group.components) * residual_;
      if (rub.norm() > (1 + 1e-9) * rub.lpNorm<Eigen::Infinity>()) add_direction(N_, group, k, rub / rub.norm(), all_);
    });
    return all_.columns.size() > before;
  }

  bool add_extreme() {
    Vector extreme = discs_.extreme(residual_);
    gap_ = residual_.dot(extreme - carried_);
    if (residual_.dot(extreme) + missed_ <= 1e-6 * residual_.squaredNorm()) return false;  // the fit would not use it
    size_ = std::max(size_, extreme.norm());
    discs_.add(std::move(extreme));
    return true;
  }

  const DenseMatrix& N_;
  const Problem& problem_;
  const Vector e_;
  Carried all_;
  Discs discs_;
  Vector residual_, carried_;
  // Of the discs: work that they could do beyond what they do; the greatest load; what the sum of amounts pulls an amount by.
  double gap_ = 0, size_ = 0, missed_ = 0;
};

/// What of the load e no admissible multipliers balance: the admissible motion it drives most (TR965
/// (1.70), with friction (3.30)). Friction in space carries forces in every tangential direction:
/// directions are added where the motion found still rubs, given friction's by its discs' extreme points (Frank and Wolfe).
Vector unbalanced(const RigidMotions& rigid, const Problem& problem, const Vector& e) {
  // What no row notices, no row balances; rounding in N must not seem to.
  const Vector residual = Balance(rigid.noticed_N, problem, rigid.noticed.transpose() * e).unbalanced();
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
