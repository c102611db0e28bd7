#include "algebra/krylov/block_cg.hpp"

#include <algorithm>
#include <limits>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"

namespace dotyk::algebra {
namespace {

/// An orthonormal basis of the span of the columns, dependent ones left out; none for zero columns.
DenseMatrix orth(const DenseMatrix& columns) {
  constexpr double kDependent = 1e-10;
  if (columns.size() == 0 || !(columns.cwiseAbs().maxCoeff() > 0)) return DenseMatrix(columns.rows(), 0);
  return span(columns, kDependent);
}

class BlockRun {
 public:
  BlockRun(const Preconditioner& C, const CgSettings& settings, Monitor& monitor, const Vector& size, BlockCgResult& result)
      : C_(C), settings_(settings), monitor_(monitor), size_(size), result_(result) {}

  /// Adds to `x` the solution for the residuals b; false where it was stopped or has used all its steps.
  bool solve(const DenseMatrix& b, DenseMatrix& x) {
    floor_ = kCgRounding * b.colwise().norm().transpose();
    DenseMatrix r = C_.forward(b), y = DenseMatrix::Zero(r.rows(), r.cols()), p = orth(r);
    bool going = true;
    while (note(r) && p.cols() > 0) {
      going = result_.iterations < settings_.limit(C_.size()) && !monitor_.stop();
      if (!going) break;
      step(p, y, r);
    }
    x += C_.backward(y);
    return going;
  }

 private:
  void step(DenseMatrix& p, DenseMatrix& y, DenseMatrix& r) {
    const DenseMatrix w = C_.apply(p);
    DenseMatrix curvature = p.transpose() * w;
    if (!cholesky(curvature)) throw InputError("block conjugate gradients: the matrix is not positive definite");
    const auto by_curvature = [&](DenseMatrix b) {
      solve_lower(curvature, b);
      solve_lower_transposed(curvature, b);
      return b;
    };
    const DenseMatrix alpha = by_curvature(p.transpose() * r);
    y += p * alpha;
    r -= w * alpha;
    ++result_.iterations;
    result_.products += p.cols();
    result_.least_rank = result_.iterations == 1 ? static_cast<int>(p.cols()) : std::min(result_.least_rank, static_cast<int>(p.cols()));
    p = orth(r - p * by_curvature(w.transpose() * r));
  }

  /// Notes which columns have met the goal, or are as near as rounding lets a run come; false where all are.
  bool note(const DenseMatrix& r) {
    const DenseMatrix lifted = C_.lift(r);
    double worst = 0;
    bool open = false;
    for (Eigen::Index k = 0; k < r.cols(); ++k) {
      const double distance = lifted.col(k).stableNorm(), residual = size_[k] > 0 ? distance / size_[k] : 0;
      const bool met = residual <= settings_.tolerance || distance <= floor_[k];
      int& settled = result_.settled[static_cast<std::size_t>(k)];
      if (!met) settled = -1;
      else if (settled < 0) settled = result_.iterations;
      worst = std::max(worst, residual);
      open = open || !met;
    }
    IterationInfo info;
    info.iteration = result_.iterations;
    info.residual = worst;
    info.seconds = watch_.seconds();
    monitor_.iteration(info);
    return open;
  }

  const Preconditioner& C_;
  const CgSettings& settings_;
  Monitor& monitor_;
  const Vector& size_;
  BlockCgResult& result_;
  Stopwatch watch_;
  Vector floor_;
};

/// The columns' norms, also of numbers whose squares vanish or overflow.
Vector sizes(const DenseMatrix& B) {
  Vector size(B.cols());
  for (Eigen::Index k = 0; k < B.cols(); ++k) size[k] = B.col(k).stableNorm();
  return size;
}

/// ‖r‖ / ‖b‖ of every column, 0 for b = 0.
Vector relative(const DenseMatrix& r, const Vector& size) {
  return sizes(r).cwiseQuotient(size.unaryExpr([](double s) { return s > 0 ? s : 1; }));
}

}  // namespace

BlockCgResult block_cg(const Preconditioner& C, const DenseMatrix& B, const CgSettings& settings, Monitor& monitor) {
  if (!B.allFinite()) throw InputError("block conjugate gradients: a right-hand side is not finite");
  BlockCgResult result;
  Vector size = sizes(B);
  const double unit = size.size() > 0 && size.maxCoeff() > 0 ? size.maxCoeff() : 1;
  const DenseMatrix scaled = B / unit;
  size /= unit;
  result.x = DenseMatrix::Zero(B.rows(), B.cols());
  result.settled.assign(static_cast<std::size_t>(B.cols()), -1);
  result.residual.assign(static_cast<std::size_t>(B.cols()), 0);
  DenseMatrix r = scaled;
  for (double before = std::numeric_limits<double>::infinity();;) {
    DenseMatrix x = result.x;
    const bool finished = BlockRun(C, settings, monitor, size, result).solve(r, x);
    r = scaled - C.times(x);
    const Vector norms = relative(r, size);
    const double worst = norms.size() > 0 ? norms.maxCoeff() : 0;
    if (worst < before) {
      result.x = x;
      std::copy(norms.begin(), norms.end(), result.residual.begin());
    }
    const double least = std::min(worst, before);
    result.converged = least <= settings.tolerance;
    if (result.converged) result.reason = text("residuals at most ", least, " after ", result.iterations, " block steps");
    else if (!finished) result.reason = text("ended after ", result.iterations, " block steps, greatest residual ", least);
    else if (!(worst <= before / 2)) result.reason = text("rounding: a residual stays at ", least);
    else {
      before = worst;
      continue;
    }
    result.x *= unit;
    return result;
  }
}

}  // namespace dotyk::algebra
