#include "problem/solvability.hpp"

#include "algebra/dense/bounded_least_squares.hpp"
#include "algebra/dense/cone_least_squares.hpp"
#include "problem/measure.hpp"

namespace dotyk::problem {

using algebra::SparseRows;
using algebra::Vector;

namespace {

/// Work below this part of the load's size counts as none: rounding of Rᵀf and of the modes.
constexpr double kRounding = 1e-10;
/// A load this close (as an angle) to the edge of what can be carried is a limit case.
constexpr double kLimit = 1e-6;

Vector greatest_one(const Vector& v) { return v / v.lpNorm<Eigen::Infinity>(); }

/// The part of the problem that each rigid motion belongs to.
std::vector<int> part_of_modes(const Problem& problem, const Parts& parts) {
  std::vector<int> part;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) part.insert(part.end(), static_cast<std::size_t>(problem.blocks[b].kernel.cols()), parts.of_block[b]);
  return part;
}

/// What the laws can carry: multipliers in a convex set, and the rows of N that they act on, one a multiplier.
struct Carrying {
  SparseRows rows;
  algebra::ConvexSet set;
};

/// Coulomb's friction stands for forces in the cone at a point, normal ones included, beside those that the normal row's own law gives.
Carrying carrying(const RigidMotions& rigid, const Problem& problem, const Measure& unit) {
  Carrying all;
  std::vector<int> row;
  for (const RowGroup& group : problem.groups)
    for (int k = 0; k < group.count; ++k) {
      const Interval bounds = group.law->multipliers(k);
      const int r = group.first + k;
      row.push_back(r), all.set.low.push_back(bounds.low / unit.load_of_row(r)), all.set.high.push_back(bounds.high / unit.load_of_row(r));
    }
  const std::vector<const RowGroup*> law_of = problem.group_of_rows();
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      const int n = group.normal[k];
      const double slope = group.law->bound_slope(k), most = slope > 0 ? law_of[n]->law->multipliers(n - law_of[n]->first).high : INFINITY;
      const bool limited = slope > 0 && std::isfinite(most);  // then no force beyond the greatest bound, and none of its own along the normal
      all.set.rounds.push_back({group.components, group.law->bound(k, limited ? most : 0) / unit.load_of_row(group.row(k)), limited ? 0 : slope});
      if (slope > 0 && !limited) row.push_back(n);
      for (int i = 0; i < group.components; ++i) row.push_back(group.row(k) + i);
    }
  all.rows = algebra::pick_rows(rigid.N, row);
  return all;
}

/// What of a load multipliers leave, by dense active sets: for few of them, and friction in the plane. Nothing for others, or where
/// these do not end either.
std::optional<Vector> by_active_sets(const Carrying& carrying, const Vector& load) {
  constexpr Eigen::Index kFew = 400;
  const Eigen::Index count = carrying.rows.rows();
  for (const auto& round : carrying.set.rounds)
    if (round.components > 1) return std::nullopt;
  if (count > kFew || carrying.rows.cols() > kFew) return std::nullopt;
  algebra::DenseMatrix columns = algebra::DenseMatrix(carrying.rows).transpose();
  Vector low = Vector::Zero(count), high = Vector::Constant(count, Law::kUnbounded);
  const auto intervals = static_cast<Eigen::Index>(carrying.set.low.size());
  low.head(intervals) = Eigen::Map<const Vector>(carrying.set.low.data(), intervals);
  high.head(intervals) = Eigen::Map<const Vector>(carrying.set.high.data(), intervals);
  Eigen::Index first = intervals;
  for (const auto& round : carrying.set.rounds) {
    if (round.slope > 0) {  // the edges of the cone
      const Vector normal = columns.col(first), tangential = round.slope * columns.col(first + 1);
      columns.col(first) = normal + tangential, columns.col(first + 1) = normal - tangential;
    } else {
      low[first] = -round.radius, high[first] = round.radius;
    }
    first += round.variables();
  }
  try {
    return algebra::bounded_least_squares(columns, load, low, high).residual;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

/// What of the load e no admissible multipliers balance: the admissible motion it drives most (TR965 (1.70), with friction (3.30)).
/// Nothing where that is not known: where the iteration ended too early.
std::optional<Vector> unbalanced(const RigidMotions& rigid, const Carrying& carrying, const Vector& e) {
  // What no row notices, no row balances; rounding in N must not seem to.
  const Vector unnoticed = rigid.unnoticed * Vector(rigid.unnoticed.transpose() * e);
  const auto fitted = algebra::cone_least_squares(carrying.rows, e - unnoticed, carrying.set, 0.5 * kRounding);
  std::optional<Vector> residual = fitted.residual;
  if (!fitted.converged) residual = by_active_sets(carrying, e - unnoticed);
  if (residual) *residual += unnoticed;
  return residual;
}

/// From the load towards the middle of what rows with limits can carry, unit length; zero where there are none.
Vector inwards(const RigidMotions& rigid, const Problem& problem, const Measure& unit, double load) {
  Vector middle = Vector::Zero(problem.rows()), rays = middle;  // multipliers
  bool limits = false;
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const auto [low, high] = group.law->multipliers(r - group.first);
      const bool below = std::isfinite(low), above = std::isfinite(high);
      limits = limits || below || above;
      middle[r] = (below && above ? (low + high) / 2 : below ? low : above ? high : 0) / unit.load_of_row(r);
      if (below != above) rays[r] = below ? 1 : -1;
    }
  if (!limits) return Vector::Zero(rigid.count());
  Vector in = rigid.N.transpose() * middle - rigid.e;
  const Vector towards = rigid.N.transpose() * rays;
  if (towards.norm() > 0) in += load * towards / towards.norm();
  return in.norm() > 0 ? Vector(in / in.norm()) : in;
}

/// What is left unbalanced of a load turned by kLimit towards the nearest edge of what can be carried; zero where that
/// is balanced, nothing where that is not known. Ten times as much away from the middle shows the motion that this edge
/// is the end of; the shortest way to the edge is along that motion.
std::optional<Vector> beyond_edge(const RigidMotions& rigid, const Problem& problem, const Carrying& all, const Measure& unit, double load) {
  const Vector in = inwards(rigid, problem, unit, load), none = Vector::Zero(rigid.count());
  if (in.norm() == 0) return none;
  const double least = 1e-3 * kLimit * load;
  const auto motion = unbalanced(rigid, all, rigid.e - 10 * kLimit * load * in);
  if (!motion) return std::nullopt;
  if (motion->norm() <= least) return none;
  const auto left = unbalanced(rigid, all, rigid.e + kLimit * load * *motion / motion->norm());
  return !left || left->norm() > least ? left : none;
}

}  // namespace

Solvability solvability(const RigidMotions& given, const Problem& problem) {
  Solvability s;
  if (given.count() == 0) return s;
  const Measure unit(problem);  // in units of its load no part is small beside another
  const std::vector<int> part = part_of_modes(problem, unit.parts());
  Vector of_mode(given.count());
  for (int k = 0; k < given.count(); ++k) of_mode[k] = unit.load(static_cast<std::size_t>(part[k]));
  RigidMotions rigid = given;
  rigid.e = given.e.cwiseQuotient(of_mode);
  const Carrying all = carrying(rigid, problem, unit);
  const double load = rigid.e.norm();
  const auto residual = load > 0 ? unbalanced(rigid, all, rigid.e) : std::optional<Vector>(Vector::Zero(rigid.count()));
  s.carried = residual && residual->norm() <= kRounding * load;
  if (!residual) {
    s.verdict = Solvability::Verdict::unknown;
    return s;
  }
  if (!s.carried) {
    s.verdict = Solvability::Verdict::unsolvable;
    s.limit = residual->norm() < kLimit * load;
    s.motion = greatest_one(residual->unaryExpr([](double r) { return std::abs(r) > kRounding ? r : 0; }).cwiseProduct(of_mode));
    s.work = given.e.dot(s.motion);
    return s;
  }
  const auto edge = beyond_edge(rigid, problem, all, unit, load > 0 ? load : 1);
  Eigen::Index most = 0;
  const bool moves = edge && edge->cwiseAbs().maxCoeff(&most) > 0;
  for (int k = 0; moves && k < given.count(); ++k) s.limit = s.limit || (part[k] == part[most] && given.e[k] != 0);  // without a load there is none that could turn
  if (rigid.unnoticed.cols() > 0) {
    s.verdict = Solvability::Verdict::up_to_motion;
    s.motion = greatest_one(Vector(rigid.unnoticed.col(0)));
  } else if (moves) {
    s.verdict = Solvability::Verdict::up_to_motion;
    s.motion = greatest_one(*edge);
    s.work = given.e.dot(s.motion);
  } else if (!edge) {
    s.verdict = Solvability::Verdict::unknown;
  }
  return s;
}

}  // namespace dotyk::problem
