#include "program/barrier.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dotyk::program {
namespace {

/// How much of its last value stays or falls in a step.
constexpr double kStays = 0.7, kFalls = 0.3;

/// aᵀb, term after term.
double sum_of_products(const Vector& a, const Vector& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

}  // namespace

Barrier::Barrier(Vector low, Vector high) : low_(std::move(low)), high_(std::move(high)), limited_(rows(), 0) {
  std::vector<double> sign, limit;
  for (int r = 0; r < rows(); ++r)
    for (const double s : {1.0, -1.0}) {
      const double end = s > 0 ? low_[r] : high_[r];
      if (!std::isfinite(end) || !(low_[r] < high_[r])) continue;
      row_.push_back(r), sign.push_back(s), limit.push_back(end);
      limited_[r] = 1;
    }
  const auto limits = static_cast<Eigen::Index>(row_.size());
  sign_ = Eigen::Map<Vector>(sign.data(), limits), limit_ = Eigen::Map<Vector>(limit.data(), limits);
  at_.w = at_.y = Vector::Zero(rows());
  at_.s = at_.z = Vector::Zero(limits);
}

void Barrier::place(const Vector& towards, double room, double unit) {
  unit_ = unit;
  at_.w = towards;
  for (std::size_t k = 0; k < row_.size(); ++k) {
    double& w = at_.w[row_[k]];
    const double margin = std::min(room, 0.25 * (high_[row_[k]] - low_[row_[k]]));
    w = sign_[k] > 0 ? std::max(w, limit_[k] + margin) : std::min(w, limit_[k] - margin);
  }
  at_.s = sign_.cwiseProduct(at_.w(row_) - limit_);
  at_.z = unit / at_.s.array();
  at_.y.setZero();
  take_multipliers(at_);
  before_ = at_;
}

void Barrier::take_multipliers(Point& at) const {
  for (int r : row_) at.y[r] = 0;
  for (std::size_t k = 0; k < row_.size(); ++k) at.y[row_[k]] -= sign_[k] * at.z[k];
}

void Barrier::evaluate() {
  rs_ = sign_.cwiseProduct(at_.w(row_) - limit_) - at_.s;
  complementary_ = sum_of_products(at_.s, at_.z);
  mu_ = row_.empty() ? 0 : complementary_ / static_cast<double>(row_.size());
}

/// Direction for a given right-hand side of s z.
Barrier::Point Barrier::direction(Vector c) {
  c -= at_.z.cwiseProduct(rs_);
  Vector kappa = Vector::Zero(rows());
  for (std::size_t k = 0; k < row_.size(); ++k) kappa[row_[k]] -= sign_[k] * c[k] / at_.s[k];
  Point d;
  d.w = d.y = Vector::Zero(rows());
  solve(kappa, d);
  const Vector ds = sign_.cwiseProduct(d.w(row_));
  d.s = ds + rs_;
  d.z = (c - at_.z.cwiseProduct(ds)).cwiseQuotient(at_.s);
  take_multipliers(d);
  return d;
}

/// The longest step (at most 1) that keeps slacks and multipliers non-negative.
double Barrier::longest(const Point& d) const {
  double most = 1;
  for (Vector Point::*part : {&Point::s, &Point::z})
    for (std::size_t k = 0; k < row_.size(); ++k)
      if (const double change = (d.*part)[k]; change < 0) most = std::min(most, -(at_.*part)[k] / change);
  return most;
}

bool Barrier::step() {
  Vector theta = Vector::Zero(rows()), c = -at_.s.cwiseProduct(at_.z);
  for (std::size_t k = 0; k < row_.size(); ++k) theta[row_[k]] += at_.z[k] / at_.s[k];
  if (!factor(theta)) return false;
  const Point affine = direction(c);
  Point d = affine;
  double alpha = longest(affine);
  if (mu_ > 0) {
    const double after = sum_of_products(at_.s + alpha * affine.s, at_.z + alpha * affine.z);
    const double target = std::pow(after / static_cast<double>(row_.size()) / mu_, 3) * mu_;
    // The second-order correction is capped: where the predictor is cut short it misleads.
    c.array() += target - (affine.s.cwiseProduct(affine.z)).array().max(-10 * mu_).min(10 * mu_);
    d = direction(c);
    alpha = longest(d);
    for (int round = 0; round < 3 && alpha < 0.9; ++round) {
      const double aim = std::max(target, 1e-3 * mu_);
      const double reach = std::min(1.0, 1.5 * alpha + 0.1);
      // Gondzio: products s z that a step of length `reach` would leave far from `aim` are called back into [aim/10, 10 aim].
      const Eigen::ArrayXd product = (at_.s + reach * d.s).cwiseProduct(at_.z + reach * d.z);
      c.array() += (product.max(0.1 * aim).min(10 * aim) - product).max(-10 * aim).min(10 * aim);
      const Point better = direction(c);
      const double longer = longest(better);
      if (longer < alpha + 0.1 * (reach - alpha)) break;
      d = better, alpha = longer;
    }
  }
  if (alpha < 1) alpha *= std::clamp(1 - 10 * mu_ / unit_, 0.9, 0.995);
  last_ = d;
  before_ = at_;
  for (Vector Point::*part : {&Point::x, &Point::w, &Point::y, &Point::s, &Point::z}) at_.*part += alpha * d.*part;
  return at_.x.allFinite() && at_.y.allFinite() && at_.w.allFinite();
}

bool Barrier::decided() const {
  const auto clear = [](double a, double b) { return std::min(a, b) < kFalls * std::max(a, b) && std::max(a, b) > kStays; };
  for (std::size_t k = 0; k < row_.size(); ++k)
    if (!clear(at_.s[k] / before_.s[k], at_.z[k] / before_.z[k])) return false;
  return true;
}

std::vector<Barrier::End> Barrier::ends() const {
  std::vector<End> out(rows());
  for (std::size_t k = 0; k < row_.size(); ++k)
    if (out[row_[k]].side == Side::free && at_.z[k] * before_.s[k] > at_.s[k] * before_.z[k])
      out[row_[k]] = {sign_[k] > 0 ? Side::low : Side::high, -sign_[k] * at_.z[k]};
  return out;
}

}  // namespace dotyk::program
