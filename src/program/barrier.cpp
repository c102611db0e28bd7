#include "program/barrier.hpp"

#include <algorithm>
#include <cmath>

#include "program/refine.hpp"

namespace dotyk::program {
namespace {

/// Least regularisation of the KKT matrix, in units of a scaled program.
constexpr double kBarrierRegularisation = 1e-12;

}  // namespace

Barrier::Barrier(const QuadraticProgram& p) : p_(p), n_(p.unknowns()), m_(p.rows()), kkt_(p), taken_(m_, 0), D_(m_) {
  for (int r = 0; r < m_; ++r) {
    has_low_.push_back(std::isfinite(p.low[r]) && !p.equality(r));
    has_high_.push_back(std::isfinite(p.high[r]) && !p.equality(r));
    taken_[r] = std::isfinite(p.low[r]) || std::isfinite(p.high[r]);
    limits_ += has_low_[r] + has_high_[r];
    if (p.equality(r)) size_b_ = std::max(size_b_, std::abs(p.low[r]));
  }
}

/// Regularised no more than the pivots ask for: as many of them must be negative as there are rows.
bool Barrier::factor(const Vector& theta_inverse, double least) {
  for (regular_ = least; regular_ <= 1; regular_ *= 10) {
    ++factorisations_;
    for (int r = 0; r < m_; ++r) D_[r] = regular_ + theta_inverse[r];
    if (kkt_.factor(regular_, D_, taken_)) return true;
  }
  return false;
}

/// Solves [P Aᵀ; A −Θ⁻¹] (dx, dy) = (f, h), refined.
Vector Barrier::solve(const Vector& f, const Vector& h, const Vector& theta_inverse) const {
  Vector b(n_ + m_);
  b << f, h;
  for (int r = 0; r < m_; ++r)
    if (!taken_[r]) b[n_ + r] = 0;
  const auto K = [&](const Vector& z) {
    Vector out = kkt_times(p_, taken_, z);
    for (int r = 0; r < m_; ++r) out[n_ + r] = taken_[r] ? out[n_ + r] - theta_inverse[r] * z[n_ + r] : -z[n_ + r];
    return out;
  };
  return refine(K, [&](const Vector& v) { return kkt_.solve(v); }, b, 1e-12 * peak(b), 4).z;
}

void Barrier::start(double far) {
  Vector theta_inverse = Vector::Ones(m_), h = Vector::Zero(m_);
  for (int r = 0; r < m_; ++r) {
    if (p_.equality(r)) theta_inverse[r] = 0;
    if (taken_[r]) h[r] = std::clamp(0.0, p_.low[r], p_.high[r]);
  }
  at_ = last_ = zero();
  if (factor(theta_inverse, 1)) {
    regular_ = kBarrierRegularisation;
    Vector b(n_ + m_);
    b << -p_.q, h;
    const Vector z = kkt_.solve(b);
    at_.x = z.head(n_), at_.y = z.tail(m_);
  }
  const Vector Ax = p_.A * at_.x;
  double out = 0, force = 0;
  for (int r = 0; r < m_; ++r) {
    if (has_low_[r]) out = std::max(out, p_.low[r] - Ax[r]);
    if (has_high_[r]) out = std::max(out, Ax[r] - p_.high[r]);
    if (has_low_[r] || has_high_[r]) force = std::max(force, std::abs(at_.y[r]));
  }
  const double room = std::max(1.0, 1.5 * out), push = far * std::max(1.0, 0.5 * force);
  for (int r = 0; r < m_; ++r) {
    at_.w[r] = Ax[r];
    if (has_low_[r] && has_high_[r]) {
      const double margin = std::min(room, 0.25 * (p_.high[r] - p_.low[r]));
      at_.w[r] = std::clamp(Ax[r], p_.low[r] + margin, p_.high[r] - margin);
    } else if (has_low_[r]) {
      at_.w[r] = std::max(Ax[r], p_.low[r] + room);
    } else if (has_high_[r]) {
      at_.w[r] = std::min(Ax[r], p_.high[r] - room);
    }
    if (has_low_[r]) at_.sl[r] = at_.w[r] - p_.low[r];
    if (has_high_[r]) at_.su[r] = p_.high[r] - at_.w[r];
    if (has_low_[r]) at_.zl[r] = push + std::max(0.0, -at_.y[r]);
    if (has_high_[r]) at_.zu[r] = push + std::max(0.0, at_.y[r]);
    if (has_low_[r] || has_high_[r]) at_.y[r] = at_.zu[r] - at_.zl[r];
    if (!taken_[r]) at_.y[r] = 0;
  }
}

Barrier::Point Barrier::zero() const {
  const Vector none = Vector::Zero(m_);
  return {Vector::Zero(n_), none, none, none, none, none, none};
}

void Barrier::evaluate() {
  const Vector Px = times(p_.P, at_.x);
  rd_ = Px + p_.q + p_.A.transpose() * at_.y;
  rp_ = p_.A * at_.x;
  double complementary = 0;
  rl_ = ru_ = Vector::Zero(m_);
  for (int r = 0; r < m_; ++r) {
    if (has_low_[r]) rl_[r] = at_.w[r] - p_.low[r] - at_.sl[r];
    if (has_high_[r]) ru_[r] = p_.high[r] - at_.w[r] - at_.su[r];
    rp_[r] = !taken_[r] ? 0 : rp_[r] - (p_.equality(r) ? p_.low[r] : at_.w[r]);
    if (has_low_[r]) complementary += at_.sl[r] * at_.zl[r];
    if (has_high_[r]) complementary += at_.su[r] * at_.zu[r];
  }
  mu_ = limits_ ? complementary / limits_ : 0;
  primal_ = std::max({peak(rp_), peak(rl_), peak(ru_)});
  dual_ = peak(rd_);
  // Residuals count by what they may change of the objective, too: multipliers can be huge.
  gap_ = complementary + std::abs(rd_.dot(at_.x)) + rp_.cwiseAbs().dot(at_.y.cwiseAbs()) +
         rl_.cwiseAbs().dot(at_.zl) + ru_.cwiseAbs().dot(at_.zu);
  gap_ /= 1 + std::abs(0.5 * at_.x.dot(Px) + p_.q.dot(at_.x));
}

/// Direction for given right-hand sides of s_l z_l and s_u z_u.
Barrier::Point Barrier::direction(const Vector& theta_inverse, Vector cl, Vector cu) const {
  cl -= at_.zl.cwiseProduct(rl_);
  cu -= at_.zu.cwiseProduct(ru_);
  Vector kappa = Vector::Zero(m_), h = -rp_;
  for (int r = 0; r < m_; ++r) {
    if (has_high_[r]) kappa[r] += cu[r] / at_.su[r];
    if (has_low_[r]) kappa[r] -= cl[r] / at_.sl[r];
    h[r] -= kappa[r] * theta_inverse[r];
  }
  const Vector z = solve(-rd_, h, theta_inverse);
  Point d = zero();
  d.x = z.head(n_), d.y = z.tail(m_);
  for (int r = 0; r < m_; ++r) {
    if (!has_low_[r] && !has_high_[r]) continue;
    d.w[r] = (d.y[r] - kappa[r]) * theta_inverse[r];
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
  for (int r = 0; r < m_; ++r) {
    if (has_low_[r]) limit(at_.sl[r], d.sl[r]), limit(at_.zl[r], d.zl[r]);
    if (has_high_[r]) limit(at_.su[r], d.su[r]), limit(at_.zu[r], d.zu[r]);
  }
  return most;
}

/// Gondzio's correction (1996): products s z that a step of length `reach` would leave far from `aim`
/// are called back into [aim/10, 10 aim].
void Barrier::centre(const Point& d, double reach, double aim, Vector& cl, Vector& cu) const {
  const auto call_back = [&](double s, double ds, double z, double dz) {
    const double product = (s + reach * ds) * (z + reach * dz);
    return std::clamp(std::clamp(product, 0.1 * aim, 10 * aim) - product, -10 * aim, 10 * aim);
  };
  for (int r = 0; r < m_; ++r) {
    if (has_low_[r]) cl[r] += call_back(at_.sl[r], d.sl[r], at_.zl[r], d.zl[r]);
    if (has_high_[r]) cu[r] += call_back(at_.su[r], d.su[r], at_.zu[r], d.zu[r]);
  }
}

bool Barrier::step() {
  Vector theta_inverse = Vector::Zero(m_), cl = Vector::Zero(m_), cu = Vector::Zero(m_);
  for (int r = 0; r < m_; ++r) {
    double theta = 0;
    if (has_low_[r]) theta += at_.zl[r] / at_.sl[r], cl[r] = -at_.sl[r] * at_.zl[r];
    if (has_high_[r]) theta += at_.zu[r] / at_.su[r], cu[r] = -at_.su[r] * at_.zu[r];
    if (has_low_[r] || has_high_[r]) theta_inverse[r] = 1 / theta;
  }
  if (!factor(theta_inverse, std::max(kBarrierRegularisation, 0.1 * regular_))) return false;
  const Point affine = direction(theta_inverse, cl, cu);
  Point d = affine;
  double alpha = longest(affine);
  if (limits_ > 0) {
    double after = 0;
    for (int r = 0; r < m_; ++r) {
      if (has_low_[r]) after += (at_.sl[r] + alpha * affine.sl[r]) * (at_.zl[r] + alpha * affine.zl[r]);
      if (has_high_[r]) after += (at_.su[r] + alpha * affine.su[r]) * (at_.zu[r] + alpha * affine.zu[r]);
    }
    const double target = std::pow(after / limits_ / mu_, 3) * mu_;
    // The second-order correction is capped: where the predictor is cut short it misleads.
    const auto capped = [&](double c) { return std::clamp(c, -10 * mu_, 10 * mu_); };
    for (int r = 0; r < m_; ++r) {
      if (has_low_[r]) cl[r] += target - capped(affine.sl[r] * affine.zl[r]);
      if (has_high_[r]) cu[r] += target - capped(affine.su[r] * affine.zu[r]);
    }
    d = direction(theta_inverse, cl, cu);
    alpha = longest(d);
    for (int round = 0; round < 3 && alpha < 0.9; ++round) {
      const double aim = std::max(target, 1e-3 * mu_);
      const double reach = std::min(1.0, 1.5 * alpha + 0.1);
      centre(d, reach, aim, cl, cu);
      const Point better = direction(theta_inverse, cl, cu);
      const double longer = longest(better);
      if (longer < alpha + 0.1 * (reach - alpha)) break;
      d = better, alpha = longer;
    }
  }
  if (alpha < 1) alpha *= std::max(0.9, 1 - 10 * mu_ > 0.995 ? 0.995 : 1 - 10 * mu_);
  last_ = d;
  at_.x += alpha * d.x;
  at_.y += alpha * d.y;
  at_.w += alpha * d.w;
  at_.sl += alpha * d.sl;
  at_.su += alpha * d.su;
  at_.zl += alpha * d.zl;
  at_.zu += alpha * d.zu;
  return at_.x.allFinite() && at_.y.allFinite();
}

double Barrier::merit() const { return std::max({primal_ / (1 + size_b_), dual_ / (1 + peak(p_.q)), gap_}); }

std::vector<Side> Barrier::active(const Point& at) const {
  std::vector<Side> side(m_, Side::free);
  for (int r = 0; r < m_; ++r) {
    if (p_.equality(r)) side[r] = Side::equal;
    else if (has_low_[r] && at.zl[r] > at.sl[r]) side[r] = Side::low;
    else if (has_high_[r] && at.zu[r] > at.su[r]) side[r] = Side::high;
  }
  return side;
}

}  // namespace dotyk::program
