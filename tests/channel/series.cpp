#include "channel/series.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "flows.hpp"

using namespace dotyk::channel;

namespace {

/// Central differences of order 8: f' and f'' at x.
template <class F>
std::array<double, 2> derivatives(const F& f, double x, double h) {
  const double first[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280}, second[] = {8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};
  double d1 = 0, d2 = -205.0 / 72 * f(x);
  for (int i = 1; i <= 4; ++i) {
    const double up = f(x + i * h), down = f(x - i * h);
    d1 += first[i - 1] * (up - down);
    d2 += second[i - 1] * (up + down);
  }
  return {d1 / h, d2 / (h * h)};
}

void check_equation(const Data& data, double scale) {
  const Series u(data);
  for (const double y : {0.0, 0.41, -0.8})
    for (const double t : {0.07, 0.3, 2.0}) {
      CAPTURE(y);
      CAPTURE(t);
      const double u_t = derivatives([&](double s) { return u.velocity(y, s); }, t, 2e-3)[0];
      const double u_yy = derivatives([&](double x) { return u.velocity(x, t); }, y, 0.02)[1];
      const double residual = data.a * u_t - data.b * u_yy + resistance(data, t) * u.velocity(y, t) - force(data, t);
      CHECK(std::abs(residual) < 1e-8 * scale);  // of the differences: 1e-13/h^2 and h^8
      CHECK(std::abs(u.velocity(data.half_width, t)) < 1e-13 * scale);
    }
}

}  // namespace

TEST_CASE("the series solves the equation") {
  check_equation(flows::electric(), 700);
  check_equation(flows::magnetic(), 700);
  Data rest = flows::electric();  // from rest, in units of its own force
  rest.initial_speed = 0;
  check_equation(rest, 4);
}

TEST_CASE("the initial profile is reached, and starting from rest is starting from 0") {
  for (Data data : {flows::electric(), flows::magnetic()}) {
    const Series u(data);
    for (const double y : {0.0, 0.5, -0.7, 1.0}) CHECK(u.velocity(y, 0) == initial_velocity(data, y));
    // within the flow a short time changes the velocity by t u_t only: bounded by that of the profile
    const double t = 1e-6;
    for (const double y : {0.3, 0.5, -0.7})
      CHECK(std::abs(u.velocity(y, t) - initial_velocity(data, y)) < 2 * t * 700 * (9 + data.c) + u.truncation_bound(t));
    data.initial_speed = 0;
    const Series rest(data);
    for (const double y : {0.0, 0.5, 0.9}) {
      CHECK(rest.velocity(y, 0) == 0);
      // u = t (d + drive)/a + O(t^2) away from the walls; (38) alone gives the periodic state here
      CHECK(std::abs(rest.velocity(y, t) / t - (data.d + data.drive) / data.a) < 1e-3);
    }
  }
}

TEST_CASE("stationary limit: what is left when the oscillation is taken away") {
  Data data = flows::electric();
  data.drive = 0;
  const Series u(data);
  for (const double y : {0.0, 0.3, -0.95, 1.0}) CHECK(std::abs(u.velocity(y, 40) - stationary(data, y)) < 1e-12);
  data.drive = 1;
  const Series oscillating(data);
  const double period = 2 * std::numbers::pi / data.omega;
  for (const double y : {0.0, 0.3, -0.95}) {
    double mean = 0;
    for (int j = 0; j < 32; ++j) mean += oscillating.velocity(y, 40 + j * period / 32) / 32;
    CHECK(std::abs(mean - stationary(data, y)) < 1e-12);
  }
}

TEST_CASE("the periodic state repeats and is what remains") {
  for (const Data& data : {flows::electric(), flows::magnetic()}) {
    const Series u(data);
    const double period = 2 * std::numbers::pi / data.omega;
    for (const double y : {0.0, 0.6})
      for (const double t : {0.01, 0.2}) {
        CHECK(std::abs(u.periodic(y, t) - u.periodic(y, t + 7 * period)) < 1e-13);
        CHECK(std::abs(u.velocity(y, t + 100 * period) - u.periodic(y, t)) < 1e-12);
      }
  }
}

TEST_CASE("amplitude at w: of the samples of a period, both combinations") {
  for (const Data& data : {flows::electric(), flows::magnetic()}) {
    const Series u(data);
    Complex sum = 0;
    for (int j = 0; j < 101; ++j) {
      const double phase = 2 * std::numbers::pi * j / 101;
      sum += u.velocity(0.2, 40 * 2 * std::numbers::pi / data.omega + phase / data.omega) * std::polar(2.0 / 101, -phase);
    }
    // after 40 periods the transient is e^{-100} and smaller
    CHECK(std::abs(std::abs(sum) - u.amplitude(0.2)) < 1e-13);
  }
}

TEST_CASE("the truncation bound holds and is not idle") {
  for (const double speed : {0.0, 3.0, 40.0, 700.0})  // p from 0.7, with its cusp on the axis, to 3
    for (Data data : {flows::electric(), flows::magnetic()}) {
      data.initial_speed = speed;
      CAPTURE(speed);
      const Series full(data, 100000);
      for (const int terms : {64, 200, 1000}) {
        const Series cut(data, terms);
        for (const double t : {1e-8, 1e-6, 1e-4}) {
          CAPTURE(terms);
          CAPTURE(t);
          const double bound = cut.truncation_bound(t) + full.truncation_bound(t);
          double greatest = 0;
          for (int i = 0; i <= 100; ++i) {
            const double y = i / 100.0;
            greatest = std::max(greatest, std::abs(cut.velocity(y, t) - full.velocity(y, t)));
          }
          CHECK(greatest <= bound + 1e-14 * (1 + speed));
          if (terms == 64 && t < 1e-5) CHECK(greatest > bound / 100);
        }
      }
      // the bound goes down with terms and with time, and few terms are enough later
      CHECK(full.truncation_bound(1e-6, 2000) < full.truncation_bound(1e-6, 1000));
      CHECK(full.truncation_bound(1e-4, 30) < full.truncation_bound(1e-5, 30));
      CHECK(full.terms_used(0.1) < 12);
    }
}
