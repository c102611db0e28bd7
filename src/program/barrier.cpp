#include "program/barrier.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::program {
namespace {

/// How much of its last value stays or falls in a step.
constexpr double kStays = 0.7, kFalls = 0.3;

}  // namespace

Barrier::Barrier(Vector low, Vector high) : low_(std::move(low)), high_(std::move(high)) {
  for (int r = 0; r < rows(); ++r) {
    has_low_.push_back(std::isfinite(low_[r]) && low_[r] < high_[r]);
    has_high_.push_back(std::isfinite(high_[r]) && low_[r] < high_[r]);
    limits_ += has_low_[r] + has_high_[r];
  }
  at_.w = at_.y = at_.sl = at_.su = at_.zl = at_.zu = Vector::Zero(rows());
}

void Barrier::place(const Vector& towards, double room, double unit) {
  unit_ = unit;
  for (int r = 0; r < rows(); ++r) {
    const double margin = std::min(room, 0.25 * (high_[r] - low_[r]));
    at_.w[r] = towards[r];
    if (has_low_[r]) at_.w[r] = std::max(at_.w[r], low_[r] + margin);
    if (has_high_[r]) at_.w[r] = std::min(at_.w[r], high_[r] - margin);
    if (has_low_[r]) at_.sl[r] = at_.w[r] - low_[r], at_.zl[r] = unit / at_.sl[r];
    if (has_high_[r]) at_.su[r] = high_[r] - at_.w[r], at_.zu[r] = unit / at_.su[r];
    at_.y[r] = at_.zu[r] - at_.zl[r];
  }
  before_ = at_;
}

void Barrier::evaluate() {
  complementary_ = 0;
  rl_ = ru_ = Vector::Zero(rows());
  for (int r = 0; r < rows(); ++r) {
    if (has_low_[r]) rl_[r] = at_.w[r] - low_[r] - at_.sl[r];
    if (has_high_[r]) ru_[r] = high_[r] - at_.w[r] - at_.su[r];
    if (has_low_[r]) complementary_ += at_.sl[r] * at_.zl[r];
    if (has_high_[r]) complementary_ += at_.su[r] * at_.zu[r];
  }
  mu_ = limits_ ? complementary_ / limits_ : 0;
}

/// Direction for given right-hand sides of s_l z_l and s_u z_u.
Barrier::Point Barrier::direction(Vector cl, Vector cu) {
  cl -= at_.zl.cwiseProduct(rl_);
  cu -= at_.zu.cwiseProduct(ru_);
  Vector kappa = Vector::Zero(rows());
  for (int r = 0; r < rows(); ++r) {
    if (has_high_[r]) kappa[r] += cu[r] / at_.su[r];
    if (has_low_[r]) kappa[r] -= cl[r] / at_.sl[r];
  }
  Point d;
  d.w = d.y = d.sl = d.su = d.zl = d.zu = Vector::Zero(rows());
  solve(kappa, d);
  for (int r = 0; r < rows(); ++r) {
    if (!limited(r)) continue;
    if (has_low_[r]) d.sl[r] = d.w[r] + rl_[r], d.zl[r] = (cl[r] - at_.zl[r] * d.w[r]) / at_.sl[r];
    if (has_high_[r]) d.su[r] = ru_[r] - d.w[r], d.zu[r] = (cu[r] + at_.zu[r] * d.w[r]) / at_.su[r];
    d.y[r] = d.zu[r] - d.zl[r];
  }
  return d;
}

/// The longest step (at most 1) that keeps slacks and multipliers non-negative.
double Barrier::longest(const Point& d) const {
  double most = 1;
  const auto limit = [&](double value, double change) {
    if (change < 0) most = std::min(most, -value / change);
  };
  for (int r = 0; r < rows(); ++r) {
    if (has_low_[r]) limit(at_.sl[r], d.sl[r]), limit(at_.zl[r], d.zl[r]);
    if (has_high_[r]) limit(at_.su[r], d.su[r]), limit(at_.zu[r], d.zu[r]);
  }
  return most;
}

/// The sum of s z after a step of this length.
double Barrier::complementary(const Point& d, double length) const {
  double after = 0;
  for (int r = 0; r < rows(); ++r) {
    if (has_low_[r]) after += (at_.sl[r] + length * d.sl[r]) * (at_.zl[r] + length * d.zl[r]);
    if (has_high_[r]) after += (at_.su[r] + length * d.su[r]) * (at_.zu[r] + length * d.zu[r]);
  }
  return after;
}

/// Gondzio's correction (1996): products s z that a step of length `reach` would leave far from `aim`
/// are called back into [aim/10, 10 aim].
void Barrier::centre(const Point& d, double reach, double aim, Vector& cl, Vector& cu) const {
  const auto call_back = [&](double s, double ds, double z, double dz) {
    const double product = (s + reach * ds) * (z + reach * dz);
    return std::clamp(std::clamp(product, 0.1 * aim, 10 * aim) - product, -10 * aim, 10 * aim);
  };
  for (int r = 0; r < rows(); ++r) {
    if (has_low_[r]) cl[r] += call_back(at_.sl[r], d.sl[r], at_.zl[r], d.zl[r]);
    if (has_high_[r]) cu[r] += call_back(at_.su[r], d.su[r], at_.zu[r], d.zu[r]);
  }
}

bool Barrier::step() {
  Vector theta = Vector::Zero(rows()), cl = theta, cu = theta;
  for (int r = 0; r < rows(); ++r) {
    if (has_low_[r]) theta[r] += at_.zl[r] / at_.sl[r], cl[r] = -at_.sl[r] * at_.zl[r];
    if (has_high_[r]) theta[r] += at_.zu[r] / at_.su[r], cu[r] = -at_.su[r] * at_.zu[r];
  }
  if (!factor(theta)) return false;
  const Point affine = direction(cl, cu);
  Point d = affine;
  double alpha = longest(affine);
  if (mu_ > 0) {
    const double target = std::pow(complementary(affine, alpha) / limits_ / mu_, 3) * mu_;
    // The second-order correction is capped: where the predictor is cut short it misleads.
    const auto capped = [&](double c) { return std::clamp(c, -10 * mu_, 10 * mu_); };
    for (int r = 0; r < rows(); ++r) {
      if (has_low_[r]) cl[r] += target - capped(affine.sl[r] * affine.zl[r]);
      if (has_high_[r]) cu[r] += target - capped(affine.su[r] * affine.zu[r]);
    }
    d = direction(cl, cu);
    alpha = longest(d);
    for (int round = 0; round < 3 && alpha < 0.9; ++round) {
      const double aim = std::max(target, 1e-3 * mu_);
      const double reach = std::min(1.0, 1.5 * alpha + 0.1);
      centre(d, reach, aim, cl, cu);
      const Point better = direction(cl, cu);
      const double longer = longest(better);
      if (longer < alpha + 0.1 * (reach - alpha)) break;
      d = better, alpha = longer;
    }
  }
  if (alpha < 1) alpha *= std::clamp(1 - 10 * mu_ / unit_, 0.9, 0.995);
  last_ = d;
  before_ = at_;
  for (Vector Point::*part : {&Point::x, &Point::w, &Point::y, &Point::sl, &Point::su, &Point::zl, &Point::zu}) at_.*part += alpha * d.*part;
  return at_.x.allFinite() && at_.y.allFinite() && at_.w.allFinite();
}

bool Barrier::decided() const {
  const auto clear = [](double a, double b) { return std::min(a, b) < kFalls * std::max(a, b) && std::max(a, b) > kStays; };
  for (int r = 0; r < rows(); ++r) {
    if (has_low_[r] && !clear(at_.sl[r] / before_.sl[r], at_.zl[r] / before_.zl[r])) return false;
    if (has_high_[r] && !clear(at_.su[r] / before_.su[r], at_.zu[r] / before_.zu[r])) return false;
  }
  return true;
}

Side Barrier::end(int r) const {
  if (has_low_[r] && at_.zl[r] * before_.sl[r] > at_.sl[r] * before_.zl[r]) return Side::low;
  if (has_high_[r] && at_.zu[r] * before_.su[r] > at_.su[r] * before_.zu[r]) return Side::high;
  return Side::free;
}

}  // namespace dotyk::program
