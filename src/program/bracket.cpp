#include "program/bracket.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::program {
namespace {

using Long = long double;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

LongVector times_long(const SparseMatrix& lower, const LongVector& x) {
  LongVector result = LongVector::Zero(x.size());
  for (int j = 0; j < lower.cols(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      result[it.row()] += Long(it.value()) * x[j];
      if (it.row() != j) result[j] += Long(it.value()) * x[it.row()];
    }
  return result;
}

/// What the rows of a single entry allow to each unknown; infinite where there are none.
struct Box {
  LongVector low, high;
  explicit Box(const QuadraticProgram& p)
      : low(LongVector::Constant(p.unknowns(), -INFINITY)), high(LongVector::Constant(p.unknowns(), INFINITY)) {
    for (int r = 0; r < p.rows(); ++r) {
      SparseRows::InnerIterator it(p.A, r);
      if (!it || it.value() == 0) continue;
      const int j = static_cast<int>(it.col());
      const Long a = it.value();
      if (++it) continue;
      const Long from = (a > 0 ? p.low[r] : p.high[r]) / a, to = (a > 0 ? p.high[r] : p.low[r]) / a;
      low[j] = std::max(low[j], from);
      high[j] = std::min(high[j], to);
    }
  }
};

}  // namespace

Bracket bracket(const QuadraticProgram& p, const Vector& x, const Vector& y) {
  const LongVector X = x.cast<Long>(), Px = times_long(p.P, X);
  const Long quadratic = X.dot(Px), linear = p.q.cast<Long>().dot(X);
  const Long primal = quadratic / 2 + linear + p.r;
  LongVector s = Px + p.q.cast<Long>();
  Long lagrangian = primal, slack = 0;
  for (int r = 0; r < p.rows(); ++r) {
    Long activity = 0;
    for (SparseRows::InnerIterator it(p.A, r); it; ++it) activity += Long(it.value()) * X[it.col()];
    slack += std::abs(Long(y[r])) * std::max({Long(p.low[r]) - activity, activity - Long(p.high[r]), Long(0)});
    const double limit = y[r] > 0 ? p.high[r] : p.low[r];
    if (y[r] == 0 || !std::isfinite(limit)) continue;  // a multiplier that no limit answers to proves nothing
    lagrangian += Long(y[r]) * (activity - limit);
    for (SparseRows::InnerIterator it(p.A, r); it; ++it) s[it.col()] += Long(it.value()) * y[r];
  }
  const Box box(p);
  const Long reach = 10 * (1 + (x.size() ? Long(x.lpNorm<Eigen::Infinity>()) : 0));
  Long dual = lagrangian;
  for (int j = 0; j < p.unknowns(); ++j) {
    const Long to = s[j] > 0 ? box.low[j] : box.high[j];
    dual += s[j] * (std::isfinite(to) ? to - X[j] : s[j] > 0 ? -reach : reach);
  }
  Bracket out;
  out.primal = static_cast<double>(primal);
  out.dual = static_cast<double>(dual);
  out.gap = static_cast<double>((primal - dual) / (1 + std::abs(primal)));
  out.violation = residuals(p, x, y).feasibility;
  out.slack = static_cast<double>(slack / (1 + std::abs(primal)));
  return out;
}

}  // namespace dotyk::program
