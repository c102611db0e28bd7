#include "channel/series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra/dense/quadrature.hpp"
#include "base/error.hpp"

namespace dotyk::channel {
namespace {

using std::numbers::pi;
constexpr int kSamples = 256;       // a period; the coefficients of e^g decay as (growth/2)^m/m!
constexpr double kGreatestGrowth = 6;

double in_range(double u) {
  if (!std::isfinite(u)) throw InputError("the velocity is beyond the range of numbers: scale the data");
  return u;
}

Complex sinhc(Complex x) { return std::abs(x) < 1e-4 ? 1.0 + x * x / 6.0 : std::sinh(x) / x; }

/// Im A: the terms (p-1)...(p-n) (i/alpha)^n of odd n.
double imaginary_part(double p, double alpha) {
  double term = 1, sum = 0;
  for (int n = 1; n <= 60; ++n) {
    const double next = term * (p - n) / alpha;
    if (n > p && std::abs(next) > std::abs(term)) break;  // past the least term
    term = next;
    if (n % 4 == 1) sum += term;
    if (n % 4 == 3) sum -= term;
    if (std::abs(term) < 1e-18 * std::abs(sum)) break;
  }
  return sum;
}

/// sin(p pi/2), exactly 0 for even p.
double cusp_factor(double p) { return std::fmod(p, 2.0) == 0 ? 0 : std::sin(std::fmod(p, 4.0) * pi / 2); }

}  // namespace

Complex forced_profile(double y, double y0, double b, Complex gamma) {
  y = std::abs(y);
  const Complex m = std::sqrt(gamma / b);
  const double distance = y0 - y, sum = y0 + y;
  if (std::abs(m) * y0 < 2)  // cosh(m y0) - cosh(m y) as a product
    return distance * sum / (2 * b) * sinhc(m * distance / 2.0) * sinhc(m * sum / 2.0) / std::cosh(m * y0);
  // (1 - e^{-m distance}) (1 - e^{-m sum})/(1 + e^{-2 m y0}) is the same quotient
  const auto one_minus_exp = [](Complex x) { return std::abs(x) < 1 ? 2.0 * std::sinh(x / 2.0) * std::exp(-x / 2.0) : 1.0 - std::exp(-x); };
  return one_minus_exp(m * distance) * one_minus_exp(m * sum) / (1.0 + std::exp(-2.0 * m * y0)) / gamma;
}

Eigen::ArrayXd wave_numbers(int count) {
  return (Eigen::ArrayXd::LinSpaced(count, 0, count - 1) * 2 + 1) * (pi / 2);
}

double asymptotic_limit(double p) { return std::max(40.0, 2 * p); }

Eigen::ArrayXd initial_coefficients(double p, int count) {
  const Eigen::ArrayXd alpha = wave_numbers(count);
  const double limit = asymptotic_limit(p);
  const algebra::Quadrature rule = algebra::gauss(40 + static_cast<int>(limit), p);
  Eigen::ArrayXd coefficients(count);
  for (int k = 0; k < count; ++k) {
    double J;
    if (alpha(k) < limit) {
      J = (rule.weights.array() * (alpha(k) * rule.points.array()).sin() / rule.points.array()).sum();
    } else {
      const double far = (k % 2 == 0 ? 1 : -1) * imaginary_part(p, alpha(k)) / alpha(k);
      const double cusp = p > 0 ? std::exp(std::lgamma(p) - p * std::log(alpha(k))) * cusp_factor(p) : pi / 2;
      J = cusp + far;
    }
    coefficients(k) = 2 * p / alpha(k) * J;
  }
  return coefficients;
}

CoefficientBound coefficient_bound(double p) {
  return {4 * p * std::abs(p - 1), 2 * std::tgamma(p + 1) * std::abs(cusp_factor(p))};
}

Series::Series(const Data& data, int terms) : data_(data) {
  channel::check(data);
  if (terms < 64) throw InputError(text("terms is ", terms, "; at least 64 are needed"));
  const bool magnetic = data.oscillating == Oscillating::magnetic;
  growth_ = magnetic ? data.c / (4 * data.a * data.omega) : 0;
  resistance_ = magnetic ? data.c / 2 : data.c;
  if (!(growth_ <= kGreatestGrowth))
    throw InputError(text("the magnetic field oscillates too slowly for the series: c/(4 a omega) = ", growth_,
                          " takes its digits away, at most ", kGreatestGrowth, " is allowed; use stepping"));
  find_harmonics();
  find_transient(terms);
}

double Series::logarithm(double t) const { return growth_ * std::sin(2 * data_.omega * t); }

void Series::find_harmonics() {
  const auto add = [&](int n, Complex force) {
    harmonics_.push_back({n, force, Complex(resistance_, data_.a * n * data_.omega)});
  };
  if (growth_ == 0) {
    add(0, data_.d);
    add(1, data_.drive);
    return;
  }
  for (int n = 0; n <= kSamples / 3; ++n) {
    Complex sum = 0;
    for (int j = 0; j < kSamples; ++j) {
      const double phase = 2 * pi * j / kSamples;
      const double value = std::exp(growth_ * std::sin(2 * phase)) * (data_.d + data_.drive * std::cos(phase));
      sum += value * std::polar(1.0, -n * phase);
    }
    add(n, sum * (n == 0 ? 1.0 : 2.0) / static_cast<double>(kSamples));
  }
}

void Series::find_transient(int terms) {
  const double y0 = data_.half_width, p = exponent_ = exponent(data_);
  if (!(p < 100)) throw InputError(text("the initial profile has the exponent ", p, "; at most 100 is allowed"));
  alpha_ = wave_numbers(terms);
  const Eigen::ArrayXd diffusion = data_.b * (alpha_ / y0).square();
  lambda_ = (diffusion + resistance_) / data_.a;
  Eigen::ArrayXd sign = Eigen::ArrayXd::Ones(terms);
  for (int k = 1; k < terms; k += 2) sign(k) = -1;
  transient_ = data_.initial_speed * initial_coefficients(p, terms);
  double forces = 0, speed = 0;
  for (const Harmonic& h : harmonics_) {
    const Eigen::ArrayXd real = diffusion + resistance_;
    const double imaginary = h.gamma.imag();
    transient_ -= 2 * sign / alpha_ * (h.force.real() * real + h.force.imag() * imaginary) / (real.square() + imaginary * imaginary);
    forces += std::abs(h.force);
    speed += std::abs(h.force * forced_profile(0, y0, data_.b, h.gamma));
  }
  scale_ = std::abs(data_.initial_speed) + speed;
  const CoefficientBound bound = coefficient_bound(p);
  smooth_ = std::abs(data_.initial_speed) * bound.smooth + 2 * forces * y0 * y0 / data_.b;
  cusp_ = std::abs(data_.initial_speed) * bound.cusp;
  while (first_bounded_ < terms && alpha_(first_bounded_) < asymptotic_limit(p)) ++first_bounded_;
}

double Series::tail(double t, int n) const {
  const double alpha = (2 * n + 1) * pi / 2;
  const double b = data_.b / (data_.a * data_.half_width * data_.half_width);
  const double geometric = -1 / std::expm1(-2 * pi * alpha * b * t);
  const auto power = [&](double factor, double q) {
    if (factor == 0) return 0.0;
    return factor * std::pow(alpha, -q) * std::min(1 + alpha / ((q - 1) * pi), geometric);
  };
  return std::exp(-(b * alpha * alpha + resistance_ / data_.a) * t) * (power(smooth_, 3) + power(cusp_, exponent_ + 1));
}

double Series::truncation_bound(double t, int n) const {
  double bound = tail(t, std::max(n, first_bounded_));
  for (int k = n; k < first_bounded_; ++k) bound += std::abs(transient_(k)) * std::exp(-lambda_(k) * t);
  return bound * std::exp(-logarithm(t));
}

double Series::truncation_bound(double t) const { return t == 0 ? 0 : in_range(truncation_bound(t, terms_used(t))); }

int Series::terms_used(double t) const {
  int enough = static_cast<int>(alpha_.size()), few = -1;  // enough: all there are, or within the bound
  while (enough - few > 1) {
    const int middle = (enough + few) / 2;
    (truncation_bound(t, middle) <= 1e-16 * scale_ ? enough : few) = middle;
  }
  return enough;
}

void Series::check(double y, double t) const {
  check_inside(data_, y);
  if (!(t >= 0 && std::isfinite(t))) throw InputError(text("t = ", t, "; the time must be finite and not negative"));
}

double Series::periodic(double y, double t) const {
  check(y, t);
  double v = 0;
  for (const Harmonic& h : harmonics_)
    v += (h.force * forced_profile(y, data_.half_width, data_.b, h.gamma) * std::polar(1.0, h.n * data_.omega * t)).real();
  return in_range(v * std::exp(-logarithm(t)));
}

double Series::velocity(double y, double t) const {
  check(y, t);
  if (t == 0) return initial_velocity(data_, y);
  const int n = terms_used(t);
  const double transient =
      (transient_.head(n) * (-t * lambda_.head(n)).exp() * (y / data_.half_width * alpha_.head(n)).cos()).sum();
  return in_range(periodic(y, t) + transient * std::exp(-logarithm(t)));
}

double Series::amplitude(double y) const {
  check_inside(data_, y);
  if (growth_ == 0) return in_range(std::abs(data_.drive * forced_profile(y, data_.half_width, data_.b, harmonics_[1].gamma)));
  Complex sum = 0;
  for (int j = 0; j < kSamples; ++j) {
    const double phase = 2 * pi * j / kSamples;
    sum += periodic(y, phase / data_.omega) * std::polar(1.0, -phase);
  }
  return in_range(2 * std::abs(sum) / kSamples);
}

double stationary(const Data& data, double y) {
  check(data);
  check_inside(data, y);
  return in_range(data.d * forced_profile(y, data.half_width, data.b, data.c).real());
}

}  // namespace dotyk::channel
