#include "channel/closed_form.hpp"

#include <cmath>

namespace dotyk::channel {
namespace {

Complex sinhc(Complex x) { return std::abs(x) < 1e-4 ? 1.0 + x * x / 6.0 : std::sinh(x) / x; }

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

}  // namespace dotyk::channel
