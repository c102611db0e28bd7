#include "problem/free_motions.hpp"

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/null_space.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

/// What the rows ask of a motion at these multipliers, as combinations of rows of B: held · r = 0, and limited · r ≤ slack.
class Conditions {
 public:
  Conditions(const Problem& problem, const State& state, double tolerance, bool springs_hold)
      : springs_hold_(springs_hold), x_(jumps(problem, state.u)), lambda_(state.lambda), measure_(problem, state),
        none_(problem, measure_, state.lambda, tolerance) {
    for (const RowGroup& group : problem.groups)
      for (int k = 0; k < group.count; ++k) add(*group.law, group.first + k, k);
    for (const FrictionGroup& group : problem.friction)
      for (int k = 0; k < group.points(); ++k) add(group, k);
  }
  SparseMatrix held(const SparseMatrix& N) const { return algebra::from_triplets(held_count_, N.rows(), held_) * N; }
  SparseMatrix limited(const SparseMatrix& N) const { return algebra::from_triplets(slack().size(), N.rows(), limited_) * N; }
  Eigen::Map<const Vector> slack() const { return {slack_.data(), static_cast<Eigen::Index>(slack_.size())}; }

 private:
  void add(const Law& law, int row, int k) {
    const auto [low, high] = law.multipliers(k);
    if (low == high) return;  // it bears the same wherever it is
    if (const auto k_linear = law.linear_stiffness(k); k_linear && std::isfinite(*k_linear) && !springs_hold_) return;
    if (!law.springs(k)) {  // where it might give way is not known
      held_.emplace_back(held_count_++, row, 1.0);
      return;
    }
    const Interval following = problem::following(law, k);
    if (none_(row, lambda_[row] - low, following.low - x_[row]))
      limit(row, 1, following.low - x_[row]);
    else if (none_(row, high - lambda_[row], x_[row] - following.high))
      limit(row, -1, x_[row] - following.high);
    else
      held_.emplace_back(held_count_++, row, 1.0);
  }

  void add(const FrictionGroup& group, int k) {
    const int first = group.row(k), d = group.components;
    const double bound = group.bound(k, lambda_), small = none_.small(first);
    if (bound <= small) return;
    const Vector own = lambda_.segment(first, d);
    if (own.norm() < bound - small) {
      for (int i = 0; i < d; ++i) held_.emplace_back(held_count_++, first + i, 1.0);
      return;
    }
    const Vector along = own.normalized();  // slips this way, or sticks at the bound
    for (int i = 0; i < d; ++i) limited_.emplace_back(static_cast<int>(slack_.size()), first + i, -along[i]);
    slack_.push_back(std::max(along.dot(x_.segment(first, d)), 0.0));
    if (d < 2) return;
    held_.emplace_back(held_count_, first, -along[1]);
    held_.emplace_back(held_count_++, first + 1, along[0]);
  }

  void limit(int row, double sign, double slack) {
    if (!std::isfinite(slack)) return;
    limited_.emplace_back(static_cast<int>(slack_.size()), row, sign);
    slack_.push_back(std::max(slack, 0.0));
  }

  bool springs_hold_;
  Vector x_;
  const Vector& lambda_;
  Measure measure_;
  NoForce none_;
  algebra::Triplets held_, limited_;
  int held_count_ = 0;
  std::vector<double> slack_;
};

}  // namespace

NoForce::NoForce(const Problem& problem, const Measure& measure, const Vector& lambda, double tolerance)
    : measure_(measure), tolerance_(tolerance), small_(Vector::Constant(lambda.size(), INFINITY)) {
  constexpr double kRounding = 1e-12;
  std::vector<double> on_block(problem.blocks.size(), 0);
  const auto each = [&](const auto& visit) {
    for (int r = 0; r < problem.rows(); ++r)
      for (SparseRows::InnerIterator it(problem.B, r); it; ++it) visit(r, on_block[problem.block_of(it.col())]);
  };
  each([&](int r, double& most) { most = std::max(most, std::abs(lambda[r])); });
  each([&](int r, double most) { small_[r] = std::min(small_[r], most); });
  for (int r = 0; r < problem.rows(); ++r) {
    const double force = measure.force_of_row(r);
    small_[r] = std::max(tolerance * (std::isfinite(small_[r]) ? small_[r] : force), kRounding * force);
  }
}

bool NoForce::operator()(int row, double force, double gap) const {
  constexpr double kLeft = 10, kBesideGap = 1e-3;  // tolerances of F that a method may leave of a force; a force that yields less than this of the gap
  return force <= small_[row] || (force <= kLeft * tolerance_ * measure_.force_of_row(row) && force <= kBesideGap * measure_.stiffness()[row] * gap);
}

FreeMotions free_motions(const Problem& problem, const State& state, double tolerance, bool springs_hold) {
  FreeMotions free;
  const SparseMatrix N = jumps_of_modes(problem);
  const Eigen::Index modes = N.cols();
  free.motions = free.unnoticed = SparseMatrix(modes, 0);
  if (modes == 0) return free;
  const Conditions conditions(problem, state, tolerance, springs_hold);
  const SparseMatrix held = conditions.held(N);
  const int holds = algebra::rank(held, kNotAtAll);
  if (holds == modes) {
    if (modes > kMostModes) return free;
    free.weakest = algebra::singular_factors(DenseMatrix(held)).V.col(modes - 1);
    free.weakest /= free.weakest.lpNorm<Eigen::Infinity>();
    free.grip = (held * free.weakest).lpNorm<Eigen::Infinity>();
    return free;
  }
  free.count = algebra::rank(N, kNotAtAll) - holds;
  if (free.count <= 0 || free.count > kMostFree) return free;
  const SparseMatrix basis = algebra::range_and_null(held, kNotAtAll).unseen;
  const algebra::RangeAndNull jumps = algebra::range_and_null(N * basis, kNotAtAll);
  free.motions = basis * jumps.seen;
  free.unnoticed = basis * jumps.unseen;
  free.count = static_cast<int>(free.motions.cols());
  if (free.count == 0) return free;
  for (int k = 0; k < free.count; ++k) free.motions.col(k) /= Vector(free.motions.col(k)).lpNorm<Eigen::Infinity>();
  if (free.count > kMostModes) return free;
  free.limits = algebra::SparseRows(conditions.limited(N) * free.motions).pruned(1, kNotAtAll);
  free.slack = conditions.slack();
  return free;
}

Interval FreeMotions::range(int k, const Vector& from) const {
  Interval range{-INFINITY, INFINITY};
  const Vector left = (slack - limits * from).cwiseMax(0);
  for (Eigen::Index row = 0; row < limits.rows(); ++row)
    if (const double approach = limits.coeff(row, k); approach > 0) range.high = std::min(range.high, left[row] / approach);
    else if (approach < 0) range.low = std::max(range.low, left[row] / approach);
  return range;
}

}  // namespace dotyk::problem
