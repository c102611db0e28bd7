#include "channel/initial_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra/dense/quadrature.hpp"

namespace dotyk::channel {
namespace {

using std::numbers::pi;

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

}  // namespace dotyk::channel
