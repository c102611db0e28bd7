#include "program/certificate.hpp"

#include <cmath>

namespace dotyk::program {

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
  const double fall = -p.q.dot(d);
  if (!(fall > 1e-9 * p.q.lpNorm<Eigen::Infinity>() * d.lpNorm<1>())) return false;
  if (!(times(p.P, d).lpNorm<Eigen::Infinity>() <= tolerance * fall)) return false;
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

}  // namespace dotyk::program
