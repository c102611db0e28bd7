#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "channel/series.hpp"
#include "flows.hpp"

using namespace dotyk::channel;

TEST_CASE("closed profile: the quotient of cosh, the parabola and both ways of computing it") {
  for (const Complex gamma : {Complex(0.01, 0), Complex(1, 3), Complex(3.9, 0.1), Complex(0, 40)})
    for (const double y : {0.0, 0.3, -0.9, 1.0}) {
      const Complex m = std::sqrt(gamma / 0.5);
      const Complex quotient = (1.0 - std::cosh(m * y) / std::cosh(m)) / gamma;
      CHECK(std::abs(forced_profile(y, 1, 0.5, gamma) - quotient) < 1e-13);  // the quotient cancels 1e-2 of its digits
    }
  CHECK(forced_profile(0.5, 2, 4, 0).real() == doctest::Approx((4 - 0.25) / 8).epsilon(1e-15));
  // at the seam between the two, |m| y0 = 2, and far beyond the range of cosh
  const double below = forced_profile(0.4, 1, 1, 4 - 1e-9).real(), above = forced_profile(0.4, 1, 1, 4 + 1e-9).real();
  CHECK(std::abs(below - above) < 1e-9);
  CHECK(forced_profile(0, 1, 1, 1e8).real() == doctest::Approx(1e-8).epsilon(1e-14));
  CHECK(forced_profile(1, 1, 1, Complex(1e8, 1e9)) == Complex(0));
}

TEST_CASE("closed profile is the sum of the series (38)") {
  const double b = 0.7, c = 2, aw = 11, y = 0.35;
  Complex sum = 0;
  for (int k = 200000; k-- > 0;) {
    const double alpha = (2 * k + 1) * std::numbers::pi / 2;
    sum += (k % 2 == 0 ? 2 : -2) / alpha * std::cos(alpha * y) / Complex(b * alpha * alpha + c, aw);
  }
  CHECK(std::abs(sum - forced_profile(y, 1, b, Complex(c, aw))) < 1e-14);  // terms fall as 1/k^3
}

TEST_CASE("physical data: a, b, c, d, Hartmann's and Reynolds' numbers") {
  Physical f{.half_width = 2e-3, .density = 1000, .viscosity = 1e-3, .conductivity = 5, .E0 = 200, .B0 = 0.5,
             .pressure_gradient = -30, .omega = 7, .initial_speed = 3};
  const Data data = reduced(f);
  CHECK(data.a == doctest::Approx(2));
  CHECK(data.b == doctest::Approx(2e-6));
  CHECK(data.c == doctest::Approx(0.5 / 200));
  CHECK(data.d == doctest::Approx(30.0 / 500));
  CHECK(data.drive == 1);
  CHECK(hartmann(data) == doctest::Approx(2e-3 * 0.5 * std::sqrt(5 / 1e-3)));
  CHECK(reynolds(data) == doctest::Approx(std::sqrt(2.0) * 2e-3 * 1000 * 3 / 1e-3));
  CHECK(exponent(data) == doctest::Approx(std::log10(reynolds(data) + 1)));
  f.E0 = 0;  // the same liquid without the electric field: nothing oscillates, the velocities are the same
  const Data still = reduced(f);
  CHECK(still.drive == 0);
  for (const double y : {0.0, 1e-3, -1.9e-3}) CHECK(stationary(still, y) == doctest::Approx(stationary(data, y)).epsilon(1e-14));
}

TEST_CASE("stationary profile: (39) off the axis, and Poiseuille's without a field") {
  Data data = flows::electric();
  const double M = hartmann(data);
  CHECK(M == 3);
  for (const double y : {0.0, 0.5, -0.99})
    CHECK(stationary(data, y) == doctest::Approx(data.d / data.c * (1 - std::cosh(M * y) / std::cosh(M))).epsilon(1e-14));
  data.c = 0;
  CHECK(stationary(data, 0.5) == doctest::Approx(data.d * 0.375).epsilon(1e-15));
}

TEST_CASE("amplitude: 1/(a w) on the axis for great w, Hartmann's profile for small") {
  Data data = flows::electric();
  for (const double omega : {1e4, 1e6, 1e8}) {
    data.omega = omega;
    CHECK(std::abs(Series(data).amplitude(0) * data.a * omega - 1) < 50 / (omega * omega) + 1e-14);  // c^2/(a w)^2/2
  }
  data.omega = 1e-9;
  data.d = 1;
  CHECK(Series(data).amplitude(0.4) == doctest::Approx(stationary(data, 0.4)).epsilon(1e-13));
}
