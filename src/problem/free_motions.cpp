#include "problem/free_motions.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SVD>
#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// Modes have greatest displacement 1: 1e-9 of that is "not at all".
constexpr double kNotAtAll = 1e-9;

/// B R, rows × modes.
SparseMatrix jumps_of_modes(const Problem& problem) {
  std::vector<Eigen::Triplet<double>> entries;
  int first = 0;
  for (const Block& block : problem.blocks) {
    const DenseMatrix N = block.kernel.cols() > 0 ? DenseMatrix(problem.rows_of(block) * block.kernel) : DenseMatrix(0, 0);
    for (Eigen::Index j = 0; j < N.cols(); ++j)
      for (Eigen::Index i = 0; i < N.rows(); ++i)
        if (N(i, j) != 0) entries.emplace_back(i, first + j, N(i, j));
    first += static_cast<int>(block.kernel.cols());
  }
  SparseMatrix all(problem.rows(), first);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

/// What the rows ask of a motion at these multipliers, as combinations of rows of B: held · r = 0, and limited · r ≤ slack.
class Conditions {
 public:
  Conditions(const Problem& problem, const State& state, double tolerance)
      : x_(problem.B * state.u - problem.c), lambda_(state.lambda),
        small_(lambda_.size() ? tolerance * lambda_.lpNorm<Eigen::Infinity>() : 0) {
    for (const RowGroup& group : problem.groups)
      for (int k = 0; k < group.count; ++k) add(*group.law, group.first + k, k);
    for (const FrictionGroup& group : problem.friction)
      for (int k = 0; k < group.points(); ++k) add(group, k);
  }
  SparseMatrix held(const SparseMatrix& N) const { return combined(held_, held_count_, N); }
  SparseMatrix limited(const SparseMatrix& N) const { return combined(limited_, static_cast<int>(slack_.size()), N); }
  double slack(Eigen::Index k) const { return slack_[static_cast<std::size_t>(k)]; }

 private:
  using Triplets = std::vector<Eigen::Triplet<double>>;

  void add(const Law& law, int row, int k) {
    const auto [low, high] = law.multipliers(k);
    if (low == high) return;  // it bears the same wherever it is
    if (!law.springs(k)) {  // where it might give way is not known
      held_.emplace_back(held_count_++, row, 1.0);
      return;
    }
    const Interval following = problem::following(law, k);
    if (lambda_[row] - low <= small_)
      limit(row, 1, following.low - x_[row]);
    else if (high - lambda_[row] <= small_)
      limit(row, -1, x_[row] - following.high);
    else
      held_.emplace_back(held_count_++, row, 1.0);
  }

  void add(const FrictionGroup& group, int k) {
    const double bound = group.bound(k, lambda_);
    if (bound <= small_) return;
    const int first = group.row(k), d = group.components;
    const Vector own = lambda_.segment(first, d);
    if (own.norm() < bound - small_) {
      for (int i = 0; i < d; ++i) held_.emplace_back(held_count_++, first + i, 1.0);
      return;
    }
    const Vector along = own.normalized();  // slips this way, or sticks at the bound
    double slip = 0;
    for (int i = 0; i < d; ++i) slip += along[i] * x_[first + i];
    for (int i = 0; i < d; ++i) limited_.emplace_back(static_cast<int>(slack_.size()), first + i, -along[i]);
    slack_.push_back(std::max(slip, 0.0));
    if (d < 2) return;
    held_.emplace_back(held_count_, first, -along[1]);
    held_.emplace_back(held_count_++, first + 1, along[0]);
  }

  void limit(int row, double sign, double slack) {
    if (!std::isfinite(slack)) return;
    limited_.emplace_back(static_cast<int>(slack_.size()), row, sign);
    slack_.push_back(std::max(slack, 0.0));
  }

  static SparseMatrix combined(const Triplets& entries, int count, const SparseMatrix& N) {
    SparseMatrix C(count, N.rows());
    C.setFromTriplets(entries.begin(), entries.end());
    return C * N;
  }

  Vector x_;
  const Vector& lambda_;
  double small_;
  Triplets held_, limited_;
  int held_count_ = 0;
  std::vector<double> slack_;
};

using SparseQr = Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>>;

/// Of a matrix with at least one entry; rows of zeros below make it as high as wide.
void factor(SparseQr& qr, SparseMatrix A) {
  A.conservativeResize(std::max(A.rows(), A.cols()), A.cols());
  A.makeCompressed();
  qr.setPivotThreshold(kNotAtAll);
  qr.compute(A);
}

int rank_of(const SparseMatrix& A) {
  if (A.nonZeros() == 0) return 0;
  SparseQr qr;
  factor(qr, A);
  return static_cast<int>(qr.rank());
}

/// A basis of the null space: columns.
DenseMatrix null_space(const SparseMatrix& held) {
  const Eigen::Index n = held.cols();
  if (held.nonZeros() == 0) return DenseMatrix::Identity(n, n);
  SparseQr qr;
  factor(qr, held);
  const Eigen::Index rank = qr.rank();
  DenseMatrix basis = DenseMatrix::Zero(n, n - rank);
  const DenseMatrix R = DenseMatrix(SparseMatrix(qr.matrixR())).topRows(rank);
  basis.bottomRows(n - rank).setIdentity();
  basis.topRows(rank) = -R.leftCols(rank).triangularView<Eigen::Upper>().solve(R.rightCols(n - rank));
  return qr.colsPermutation() * basis;
}

/// Greatest amount 1.
void normalise(DenseMatrix& motions) {
  for (Eigen::Index k = 0; k < motions.cols(); ++k) motions.col(k) /= motions.col(k).lpNorm<Eigen::Infinity>();
}

}  // namespace

FreeMotions free_motions(const Problem& problem, const State& state, double tolerance) {
  FreeMotions free;
  const SparseMatrix N = jumps_of_modes(problem);
  free.motions = free.unnoticed = DenseMatrix(N.cols(), 0);
  if (N.cols() == 0) return free;
  const Conditions conditions(problem, state, tolerance);
  const SparseMatrix held = conditions.held(N);
  const int holds = rank_of(held);
  if (holds == N.cols()) {
    if (N.cols() > kMostModes) return free;
    free.weakest = Eigen::JacobiSVD<DenseMatrix>(DenseMatrix(held), Eigen::ComputeThinV).matrixV().col(N.cols() - 1);
    free.weakest /= free.weakest.lpNorm<Eigen::Infinity>();
    free.grip = (held * free.weakest).lpNorm<Eigen::Infinity>();
    return free;
  }
  free.count = rank_of(N) - holds;
  if (free.count <= 0 || N.cols() > kMostFree) return free;
  const DenseMatrix basis = null_space(held);
  DenseMatrix jumps = DenseMatrix::Zero(std::max(N.rows(), basis.cols()), basis.cols());
  jumps.topRows(N.rows()) = N * basis;
  const Eigen::JacobiSVD<DenseMatrix> svd(jumps, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < basis.cols() && svd.singularValues()[rank] > kNotAtAll * std::max(1.0, svd.singularValues()[0])) ++rank;
  free.motions = basis * svd.matrixV().leftCols(rank);
  free.unnoticed = basis * svd.matrixV().rightCols(basis.cols() - rank);
  free.count = static_cast<int>(rank);
  if (rank == 0) return free;
  normalise(free.motions);
  if (rank > 1) return free;
  free.range = {-INFINITY, INFINITY};
  const Vector approach = conditions.limited(N) * free.motions.col(0);
  for (Eigen::Index k = 0; k < approach.size(); ++k) {
    if (approach[k] > kNotAtAll) free.range.high = std::min(free.range.high, conditions.slack(k) / approach[k]);
    if (approach[k] < -kNotAtAll) free.range.low = std::max(free.range.low, conditions.slack(k) / approach[k]);
  }
  return free;
}

}  // namespace dotyk::problem
