#include "problem/free_motions.hpp"

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/null_space.hpp"
#include "problem/parts.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

double greatest_force(const Problem& problem, const Vector& lambda) {
  double most = lambda.lpNorm<Eigen::Infinity>();
  for (const Block& block : problem.blocks) most = std::max(most, block.f.lpNorm<Eigen::Infinity>());
  return most;
}

/// What the rows ask of a motion at these multipliers, as combinations of rows of B: held · r = 0, and limited · r ≤ slack.
class Conditions {
 public:
  Conditions(const Problem& problem, const State& state, double tolerance, bool springs_hold)
      : springs_hold_(springs_hold), x_(jumps(problem, state.u)), lambda_(state.lambda), small_(small_forces(problem, state.lambda, tolerance)),
        stiffness_(problem.row_stiffness()),
        left_(10 * tolerance * greatest_force(problem, state.lambda)) {
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
    // On a row that is open, or beyond its law's other end, a multiplier is what the method left.
    const auto open = [&](double force, double gap) { return force <= small_[row] || (force <= left_ && force <= kBesideGap * stiffness_[row] * gap); };
    if (open(lambda_[row] - low, following.low - x_[row]))
      limit(row, 1, following.low - x_[row]);
    else if (open(high - lambda_[row], x_[row] - following.high))
      limit(row, -1, x_[row] - following.high);
    else
      held_.emplace_back(held_count_++, row, 1.0);
  }

  void add(const FrictionGroup& group, int k) {
    const int first = group.row(k), d = group.components;
    const double bound = group.bound(k, lambda_), small = small_[first];
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
  Vector small_, stiffness_;  ///< by row: forces that are none; see Problem::row_stiffness()
  double left_;                ///< what a method may leave of a force
  algebra::Triplets held_, limited_;
  int held_count_ = 0;
  std::vector<double> slack_;
};

/// The greatest multiplier of each part; where nothing loads it, of all parts.
std::vector<double> greatest_of_loaded(const Problem& problem, const Parts& parts, const Vector& lambda) {
  std::vector<double> greatest = parts.greatest(lambda);
  std::vector<char> loaded(greatest.size(), 0);
  for (std::size_t b = 0; b < problem.blocks.size(); ++b)
    if (!problem.blocks[b].f.isZero(0)) loaded[parts.of_block[b]] = 1;
  for (std::size_t p = 0; p < greatest.size(); ++p)
    if (!loaded[p]) greatest[p] = lambda.lpNorm<Eigen::Infinity>();
  return greatest;
}

}  // namespace

Vector small_forces(const Problem& problem, const Vector& lambda, double tolerance) {
  constexpr double kOfAll = 1e-12;  // forces below this fraction of the greatest one are rounding of the solve
  if (lambda.size() == 0) return lambda;
  const Parts parts = problem::parts(problem);
  const std::vector<double> greatest = greatest_of_loaded(problem, parts, lambda);
  std::vector<double> of_body(problem.blocks.size(), 0);
  std::vector<double> of_rounding;  // by block: of its load, without one of the greatest force of its part
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const double load = problem.blocks[b].f.lpNorm<Eigen::Infinity>();
    of_rounding.push_back(kOfAll * (load > 0 ? load : greatest[parts.of_block[b]]));
  }
  const auto each = [&](const auto& visit) {
    for (int r = 0; r < problem.rows(); ++r)
      for (SparseRows::InnerIterator it(problem.B, r); it; ++it) visit(r, problem.block_of(it.col()));
  };
  each([&](int r, std::size_t b) { of_body[b] = std::max(of_body[b], std::abs(lambda[r])); });
  Vector least = Vector::Constant(lambda.size(), lambda.lpNorm<Eigen::Infinity>()), rounding = Vector::Zero(lambda.size());
  each([&](int r, std::size_t b) {
    if (of_body[b] > least[r]) return;
    least[r] = of_body[b];
    rounding[r] = of_rounding[b];
  });
  return (tolerance * least).cwiseMax(rounding);
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
