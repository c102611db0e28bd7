#include "algebra/krylov/repeated_systems.hpp"

#include <algorithm>

#include "algebra/dense/decompositions.hpp"
#include "algebra/krylov/block_cg.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"

namespace dotyk::algebra {

using Method = RepeatedSettings::Method;

constexpr int kFewestPairs = 10, kMostPairs = 30;

int number_by_gap(const Vector& values) {
  const int n = static_cast<int>(values.size());
  int best = std::min(n, 1);
  double gap = 0;
  for (int i = n > kFewestPairs ? kFewestPairs : 1; i <= std::min(n - 1, kMostPairs); ++i)
    if (values[i] > gap * values[i - 1]) {
      gap = values[i] / values[i - 1];
      best = i;
    }
  return best;
}

CgResult Cglan::solve(const Vector& b, Monitor& monitor) {
  if (basis_.count() > 0)
    return conjugate_gradient(preconditioner_, b, settings_, monitor, {.basis = &basis_, .conjugate = deflate_});
  LanczosRecord record;
  CgResult result = conjugate_gradient(preconditioner_, b, settings_, monitor, {.record = &record});
  if (record.steps() > 0) keep_lowest(record);
  return result;
}

void Cglan::keep_lowest(const LanczosRecord& record) {
  const Eigenpairs lowest = lowest_eigenpairs(record.diagonal(), record.off_diagonal(), kMostPairs + 1);
  const int count = number_by_gap(lowest.values);
  values_ = lowest.values.head(count);
  const DenseMatrix ritz = record.vectors() * lowest.vectors.leftCols(count);
  for (int i = 0; i < count; ++i) {
    Vector y = ritz.col(i);
    if (!basis_.conjugate(y)) continue;
    const Vector w = preconditioner_.apply(y);
    if (y.dot(w) > 0) basis_.add(y, w);
  }
  loss_ = record.loss();
  bytes_ = record.bytes() + basis_.bytes();
}

RepeatedSystems::RepeatedSystems(const SparseMatrix& lower, const std::vector<int>& node, const RepeatedSettings& settings)
    : K_(lower), settings_(settings) {
  Stopwatch watch;
  if (settings.method == Method::cholesky) {
    cholesky_.emplace(lower, node, std::vector<int>{});
    if (!cholesky_->factor(lower))
      throw InputError(text("the matrix is not positive definite: the pivot of unknown ", cholesky_->failed_unknown() + 1, " is not positive"));
  } else {
    preconditioner_ = make_preconditioner(settings.preconditioning, lower, settings.omega);
  }
  setup_ = watch.seconds();
  if (settings.method == Method::scg) scg_.emplace(*preconditioner_, settings.cg, settings.extend);
  if (settings.method == Method::cglan) cglan_.emplace(*preconditioner_, settings.cg, settings.deflate);
}

DenseMatrix RepeatedSystems::in_turn(const DenseMatrix& B, Monitor& monitor) {
  DenseMatrix x = DenseMatrix::Zero(B.rows(), B.cols());
  for (Eigen::Index k = 0; k < B.cols(); ++k) {
    Stopwatch watch;
    const Vector b = B.col(k);
    const CgResult r = scg_     ? scg_->solve(b, monitor)
                       : cglan_ ? cglan_->solve(b, monitor)
                                : conjugate_gradient(*preconditioner_, b, settings_.cg, monitor);
    x.col(k) = r.x;
    results_.push_back({r.iterations, watch.seconds(), r.residual, r.converged, r.reason});
  }
  return x;
}

DenseMatrix RepeatedSystems::as_block(const DenseMatrix& B, Monitor& monitor) {
  Stopwatch watch;
  BlockCgResult r = block_cg(*preconditioner_, B, settings_.cg, monitor);
  const double share = watch.seconds() / std::max<double>(1, static_cast<double>(B.cols()));
  for (std::size_t k = 0; k < r.settled.size(); ++k)
    results_.push_back({r.settled[k] < 0 ? r.iterations : r.settled[k], share, r.residual[k],
                       r.residual[k] <= settings_.cg.tolerance, r.reason});
  return std::move(r.x);
}

DenseMatrix RepeatedSystems::directly(const DenseMatrix& B) {
  Stopwatch watch;
  DenseMatrix x = cholesky_->solve(B);
  const double share = watch.seconds() / std::max<double>(1, static_cast<double>(B.cols()));
  const DenseMatrix r = B - DenseMatrix(K_.selfadjointView<Eigen::Lower>() * x);
  for (Eigen::Index k = 0; k < B.cols(); ++k) {
    const double size = B.col(k).norm();
    results_.push_back({0, share, size > 0 ? r.col(k).norm() / size : 0, true, "direct"});
  }
  return x;
}

DenseMatrix RepeatedSystems::solve(const DenseMatrix& B, Monitor& monitor) {
  if (B.rows() != K_.rows()) throw InputError(text("the right-hand sides have ", B.rows(), " rows, the matrix ", K_.rows()));
  if (!B.allFinite()) throw InputError("a right-hand side is not finite");
  if (cholesky_) return directly(B);
  return settings_.method == Method::block_cg ? as_block(B, monitor) : in_turn(B, monitor);
}

double RepeatedSystems::bytes() const {
  if (cholesky_) return cholesky_->bytes();
  const double vectors = scg_ ? scg_->basis().bytes() : cglan_ ? cglan_->greatest_bytes() : 0;
  return preconditioner_->bytes() + vectors;
}

int RepeatedSystems::kept() const {
  if (scg_) return static_cast<int>(scg_->basis().count());
  return cglan_ ? static_cast<int>(cglan_->basis().count()) : 0;
}

}  // namespace dotyk::algebra
