#include "algebra/dense/quadrature.hpp"

#include <doctest/doctest.h>

using namespace dotyk;

TEST_CASE("Gauss-Jacobi: moments of s^power") {
  for (const double power : {0.0, 0.3, 2.7, 9.0}) {
    const algebra::Quadrature rule = algebra::gauss(12, power);
    for (int n = 0; n < 24; ++n)
      CHECK((rule.weights.array() * rule.points.array().pow(n)).sum() == doctest::Approx(1 / (n + power + 1)).epsilon(1e-13));
  }
}
