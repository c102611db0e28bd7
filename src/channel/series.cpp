#include "channel/series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/text.hpp"
#include "channel/initial_profile.hpp"

namespace dotyk::channel {
namespace {

using std::numbers::pi;
constexpr int kSamples = 256;       // a period; the coefficients of e^g decay as (growth/2)^m/m!
constexpr double kGreatestGrowth = 6;

double in_range(double u) {
  if (!std::isfinite(u)) throw InputError("the velocity is beyond the range of numbers: scale the data");
  return u;
}

}  // namespace

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
