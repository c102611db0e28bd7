#include "channel/series.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "algebra/dense/quadrature.hpp"

using namespace dotyk;
using namespace dotyk::channel;

TEST_CASE("coefficients of the initial profile: closed for p = 1, 2, 4") {
  const int count = 400;
  const Eigen::ArrayXd alpha = wave_numbers(count);
  const Eigen::ArrayXd one = initial_coefficients(1, count), two = initial_coefficients(2, count), four = initial_coefficients(4, count);
  for (int k = 0; k < count; ++k) {
    const double x = alpha(k), sign = k % 2 == 0 ? 1 : -1;
    CHECK(std::abs(one(k) - 2 / (x * x)) < 1e-15);
    CHECK(std::abs(two(k) - 4 * sign / (x * x * x)) < 2e-15);
    CHECK(std::abs(four(k) - 8 * sign / (x * x * x) * (3 - 6 / (x * x))) < 2e-15);
  }
}

TEST_CASE("coefficients of the initial profile: both ways agree where they meet, and the bound holds") {
  const int count = 3000;
  const Eigen::ArrayXd alpha = wave_numbers(count);
  for (const double p : {0.05, 0.6, 1.7, 2.996, 5.3, 12.0, 30.5}) {
    CAPTURE(p);
    const Eigen::ArrayXd c = initial_coefficients(p, count);
    const algebra::Quadrature rule = algebra::gauss(400, p);
    const CoefficientBound bound = coefficient_bound(p);
    for (int k = 0; k < count; ++k) {
      if (alpha(k) < 200) {
        const double J = (rule.weights.array() * (alpha(k) * rule.points.array()).sin() / rule.points.array()).sum();
        CHECK(std::abs(c(k) - 2 * p / alpha(k) * J) < 1e-14 * (1 + p));
      }
      if (alpha(k) >= asymptotic_limit(p))
        CHECK(std::abs(c(k)) <= bound.smooth * std::pow(alpha(k), -3) + bound.cusp * std::pow(alpha(k), -p - 1) + 1e-18);
    }
  }
}

TEST_CASE("coefficients of the initial profile: Parseval") {
  for (const double p : {0.6, 2.996, 7.0}) {
    const Eigen::ArrayXd c = initial_coefficients(p, 100000);
    // int_0^1 (1 - s^p)^2 ds = 1 - 2/(p+1) + 1/(2p+1), and int cos^2 = 1/2; what is left out falls as count^{-1-2p}
    CHECK(c.square().sum() / 2 == doctest::Approx(1 - 2 / (p + 1) + 1 / (2 * p + 1)).epsilon(1e-10));
  }
}
