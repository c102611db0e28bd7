#include <doctest/doctest.h>

#include <limits>

#include "base/error.hpp"
#include "channel/series.hpp"
#include "channel/stepping.hpp"
#include "flows.hpp"

using namespace dotyk;
using namespace dotyk::channel;
using flows::quiet;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

template <class F>
void refused(const F& f, const std::string& part) {
  CAPTURE(part);
  try {
    f();
    FAIL_CHECK("not refused");
  } catch (const InputError& error) {
    CAPTURE(error.what());
    CHECK(std::string(error.what()).find(part) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("data refused, by name") {
  const auto with = [](double Data::*member, double value) {
    Data data = flows::electric();
    data.*member = value;
    return [data] { Series series(data); };
  };
  refused(with(&Data::half_width, 0), "half_width is 0; it must be positive");
  refused(with(&Data::a, -1), "a is -1");
  refused(with(&Data::b, -1), "b is -1");
  refused(with(&Data::b, kNan), "b is nan");
  refused(with(&Data::c, -1e-3), "c is -0.001; it must be finite and not negative");
  refused(with(&Data::d, kInfinity), "d is inf");
  refused(with(&Data::omega, -2), "omega is -2");
  refused(with(&Data::initial_speed, kNan), "u0 is nan");
  Data slow = flows::magnetic();
  slow.omega = 1;
  refused([&] { Series series(slow); }, "use stepping");
  slow.omega = 0;
  refused([&] { Series series(slow); }, "omega of an oscillating magnetic field is 0");
  Physical f{.half_width = 1, .density = 1, .viscosity = -1, .conductivity = 1, .E0 = 1, .B0 = 1};
  refused([&] { reduced(f); }, "viscosity is -1; it must be positive");
  f.viscosity = 1;
  f.E0 = -1;
  refused([&] { reduced(f); }, "E0 is -1");
}

TEST_CASE("places and times refused") {
  const Series u(flows::electric());
  refused([&] { u.velocity(1.001, 1); }, "y = 1.001 is outside the channel, |y| <= 1");
  refused([&] { u.velocity(kNan, 1); }, "y = nan");
  refused([&] { u.velocity(0, -1e-9); }, "t = -1e-09");
  refused([&] { u.velocity(0, kNan); }, "t = nan");
  refused([&] { u.velocity(0, kInfinity); }, "t = inf");
  refused([&] { u.amplitude(-2); }, "outside");
  refused([&] { stationary(u.data(), 2); }, "outside");
  Stepping s(flows::electric(), 0.1);
  s.step();
  refused([&] { s.velocity(1.5); }, "outside");
  refused([&] { s.advance(0.05, quiet); }, "it is 0.1 already");
  refused([&] { s.advance(kNan, quiet); }, "nan");
  refused([&] { s.advance(1e9, quiet); }, "at most 1e7");
  refused([&] { Stepping(flows::electric(), 0); }, "step is 0");
  refused([&] { Stepping(flows::electric(), 0.1, 0); }, "cells is 0");
  refused([&] { Stepping(flows::electric(), 0.1, 4, 17); }, "degree is 17");
  refused([&] { Series(flows::electric(), 10); }, "terms is 10");
}
