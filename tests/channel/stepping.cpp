#include "channel/stepping.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "channel/series.hpp"
#include "flows.hpp"

using namespace dotyk::channel;
using flows::quiet;

namespace {

double difference(const Series& series, const Stepping& stepping) {
  double greatest = 0;
  for (int i = -20; i <= 20; ++i) {
    const double y = series.data().half_width * i / 20.0;
    greatest = std::max(greatest, std::abs(stepping.velocity(y) - series.velocity(y, stepping.time())));
  }
  return greatest;
}

double error_at(const Data& data, double time, double step, int cells, int degree) {
  Stepping stepping(data, step, cells, degree);
  stepping.advance(time, quiet);
  return difference(Series(data), stepping);
}

}  // namespace

TEST_CASE("series and time stepping agree to 1e-8") {
  for (Data data : {flows::electric(), flows::magnetic()}) {
    for (const double speed : {0.0, 2.0, 700.0}) {
      data.initial_speed = speed;
      CAPTURE(speed);
      const Series series(data);
      Stepping stepping(data, 1.0 / 400, 10, 8);
      for (const double t : {0.5, 1.0}) {
        stepping.advance(t, quiet);
        CHECK(difference(series, stepping) < 1e-8 * std::max(1.0, speed));
      }
    }
  }
}

TEST_CASE("stepping tends to the stationary profile when the oscillation is taken away") {
  Data data = flows::electric();
  data.drive = 0;
  Stepping stepping(data, 0.05, 10, 10);
  stepping.advance(10, quiet);
  for (const double y : {0.0, 0.3, -0.95, 1.0}) CHECK(std::abs(stepping.velocity(y) - stationary(data, y)) < 1e-12);
}

TEST_CASE("order in time") {
  // 5 for Radau IIA, from rest and from the profile: kinks at the walls die out within a few steps
  for (Data data : {flows::electric(), flows::magnetic()}) {
    double previous = 0;
    for (const int steps : {32, 64, 128}) {
      const double error = error_at(data, 1, 1.0 / steps, 10, 10);
      MESSAGE("steps " << steps << ": " << error << ", order " << std::log2(previous / error));
      if (previous > 0) CHECK(std::log2(previous / error) > 4.7);
      previous = error;
    }
  }
}

TEST_CASE("order in space") {
  for (const int degree : {1, 2, 3, 4}) {
    double previous = 0;
    for (const int cells : {4, 8, 16}) {
      const double error = error_at(flows::electric(), 0.25, 1.0 / 800, cells, degree);
      MESSAGE("degree " << degree << ", cells " << cells << ": " << error << ", order " << std::log2(previous / error));
      if (previous > 0) CHECK(std::log2(previous / error) > degree + 0.6);
      previous = error;
    }
  }
}

TEST_CASE("a slow magnetic field is stepped where the series refuses: near the steady channel of the moment") {
  Data data = flows::magnetic();
  data.omega = 0.1;
  data.initial_speed = 0;
  Stepping stepping(data, 0.02, 8, 8);
  stepping.advance(5, quiet);  // cos wt = 0.8776, 60 cos^2 = 46, changing by 0.1 a unit of time
  Data frozen = data;
  frozen.oscillating = Oscillating::electric;
  frozen.c = resistance(data, 5);
  frozen.d = force(data, 5);
  CHECK(stepping.velocity(0.2) == doctest::Approx(stationary(frozen, 0.2)).epsilon(5e-3));
}

TEST_CASE("time lands where it is told to, and steps add up") {
  Stepping a(flows::electric(), 0.03), b(flows::electric(), 0.03);
  a.advance(0.1, quiet);
  CHECK(a.time() == 0.1);
  CHECK(a.steps() == 4);
  a.advance(0.1, quiet);
  CHECK(a.steps() == 4);
  b.step();
  CHECK(b.time() == 0.03);
}
