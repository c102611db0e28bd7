#include "program/certificate.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::program {
namespace {

using Long = long double;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

/// What the rows of a single entry allow to each unknown; infinite where there are none.
struct Box {
  LongVector low, high;
  explicit Box(const QuadraticProgram& p)
      : low(LongVector::Constant(p.unknowns(), -INFINITY)), high(LongVector::Constant(p.unknowns(), INFINITY)) {
    for (int r = 0; r < p.rows(); ++r) {
      SparseRows::InnerIterator it(p.A, r);
      if (!it || it.value() == 0) continue;
      const auto j = it.col();
      const Long a = it.value();
      if (++it) continue;
      low[j] = std::max(low[j], (a > 0 ? p.low[r] : p.high[r]) / a);
      high[j] = std::min(high[j], (a > 0 ? p.high[r] : p.low[r]) / a);
    }
  }
};

}  // namespace

bool proves_infeasible(const QuadraticProgram& p, const Vector& y, double far) {
  Vector weight = y;
  double support = 0, limits = 1;
  for (int r = 0; r < p.rows(); ++r) {
    const double limit = y[r] > 0 ? p.high[r] : p.low[r];
    if (y[r] == 0 || !std::isfinite(limit)) {
      weight[r] = 0;
      continue;
    }
    support += limit * y[r];
    limits = std::max(limits, std::abs(limit));
  }
  if (!(support < 0)) return false;
  const Vector e = p.A.transpose() * weight;
  return -support >= far * limits * e.lpNorm<Eigen::Infinity>() && -support > 1e-9 * limits * weight.lpNorm<1>();
}

bool proves_unbounded(const QuadraticProgram& p, const Vector& d, double tolerance) {
  constexpr double kCancelled = 1e-4;
  const double fall = -p.q.dot(d);
  if (!(fall > 1e-9 * p.q.lpNorm<Eigen::Infinity>() * d.lpNorm<1>())) return false;
  const Vector resists = times(p.P, d).cwiseAbs(), terms = times(p.P.cwiseAbs(), d.cwiseAbs());
  if (!(resists.lpNorm<Eigen::Infinity>() <= tolerance * fall)) return false;
  // Little curvature beside others' is no rounding: the fall must be of unknowns whose own terms cancel.
  const double free_fall = -(resists.array() <= kCancelled * terms.array()).select(p.q.cwiseProduct(d), 0.0).sum();
  if (!(free_fall > fall / 2)) return false;
  const Vector a = p.A * d;
  for (int r = 0; r < p.rows(); ++r)
    if ((std::isfinite(p.high[r]) && a[r] > tolerance * fall) || (std::isfinite(p.low[r]) && a[r] < -tolerance * fall))
      return false;
  return true;
}

QuadraticProgram nearest_point(const QuadraticProgram& p) {
  QuadraticProgram out = p;
  out.P.setIdentity();
  out.q.setZero();
  return out;
}

Bracket bracket(const QuadraticProgram& p, const Vector& x, const Vector& y) {
  const Eigen::SparseMatrix<Long> P = p.P.cast<Long>();
  const Eigen::SparseMatrix<Long, Eigen::RowMajor> A = p.A.cast<Long>();
  const LongVector X = x.cast<Long>(), Px = P.selfadjointView<Eigen::Lower>() * X, activity = A * X;
  const Long primal = X.dot(Px) / 2 + p.q.cast<Long>().dot(X) + p.r;
  LongVector proving = y.cast<Long>();
  Long dual = primal, slack = 0;
  for (int r = 0; r < p.rows(); ++r) {
    slack += std::abs(proving[r]) * std::max({p.low[r] - activity[r], activity[r] - p.high[r], Long(0)});
    const double limit = y[r] > 0 ? p.high[r] : p.low[r];
    if (!std::isfinite(limit)) proving[r] = 0;  // a multiplier that no limit answers to proves nothing
    else dual += proving[r] * (activity[r] - limit);
  }
  const LongVector s = Px + p.q.cast<Long>() + A.transpose() * proving;
  const Box box(p);
  const Long reach = 10 * (1 + (x.size() ? Long(x.lpNorm<Eigen::Infinity>()) : 0));
  for (int j = 0; j < p.unknowns(); ++j) {
    const Long to = s[j] > 0 ? box.low[j] : box.high[j];
    dual += s[j] * (std::isfinite(to) ? to - X[j] : s[j] > 0 ? -reach : reach);
  }
  const Long size = 1 + std::abs(primal);
  return {static_cast<double>(primal), static_cast<double>(dual), static_cast<double>((primal - dual) / size),
          residuals(p, x, y).feasibility, static_cast<double>(slack / size)};
}

}  // namespace dotyk::program
