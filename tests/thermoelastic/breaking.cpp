// Supports that break while a coupled beam is stepped: closed forms, the scheme's order, decomposition, energy.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/thermoelastic_beam.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

using namespace dotyk;
using namespace dotyk::test;
using namespace dotyk::thermoelastic;

namespace {

constexpr double kStiffness = 40, kLimit = 0.3;

/// Clamped at the left, on a support at the right that breaks.
Data propped(double limit = kLimit) {
  Data d = thermal_beam(8);
  d.supports[0].deflection = d.supports[0].rotation = d.supports[0].displacement = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::breaking, kStiffness, limit);
  return d;
}

double EJ(const Data& d) { return d.E * Coefficients(d).J; }

/// A load that grows with time, q = −t.
Loads growing() {
  Loads out;
  out.transverse = source([](double, double t) { return -t; });
  return out;
}

/// Loads and heat that press it down more and more, but not steadily.
Loads pressing() {
  Loads out;
  out.transverse = source([](double x, double t) { return -3 * t * (1 + 0.3 * std::sin(5 * t) * x); });
  out.heat_gradient = source([](double x, double t) { return 3 * std::cos(2 * t) * x; });
  return out;
}

Stepping run(const Data& d, const Scheme& scheme, const Loads& loads, double t) {
  Stepping s(d, {}, scheme, loads, monitor);
  s.run(t, loads, monitor);
  return s;
}

}  // namespace

TEST_CASE("without expansion a propped cantilever breaks when and as the closed form says") {
  Data d = propped();
  d.expansion = 0;
  // r = q/(8 EJ)/(1/k + 1/(3 EJ)) for q = t and length 1, until it is the limit; then the load bends a cantilever
  const double compliance = 1 / kStiffness + 1 / (3 * EJ(d)), breaks = 8 * EJ(d) * kLimit * compliance;
  const Stepping before = run(d, {0.1, Order::two, true, {}}, growing(), 0.9 * breaks), after = run(d, {0.1, Order::two, true, {}}, growing(), 2);
  CHECK(before.broken().empty());
  CHECK(before.reaction(1).force == doctest::Approx(0.9 * kLimit).epsilon(1e-10));
  CHECK(before.energy().released == 0);
  REQUIRE(after.broken().size() == 1);
  CHECK(after.broken()[0].name == "right deflection");
  CHECK(after.broken()[0].time == doctest::Approx(breaks).epsilon(2e-9));  // found to 1e-10 of a step beyond (1 + 1e-9) limits
  CHECK(after.reaction(1).force == 0);
  CHECK(after.deflection(1) == doctest::Approx(-2 / (8 * EJ(d))).epsilon(1e-10));
  CHECK(after.energy().released == doctest::Approx(kLimit * kLimit * compliance / 2).epsilon(1e-8));
  CHECK(std::abs(after.energy().defect) < 1e-9 * after.energy().stored);  // the trapezoidal rule is exact for these
}

TEST_CASE("once broken it bears nothing, however the load turns") {
  Data d = propped();
  d.expansion = 0;
  Loads turning;
  turning.transverse = source([](double, double t) { return -2.5 * std::sin(M_PI * t / 2); });
  const Stepping s = run(d, {0.05, Order::two, true, {}}, turning, 1.9);
  REQUIRE(s.broken().size() == 1);
  CHECK(s.deflection(1) < 0);
  CHECK(s.reaction(1).force == 0);
}

TEST_CASE("the jump exchanges no heat: what is set free is that of a beam stiffer by θ₀Eα²/c") {
  const Data d = propped();
  const double at_once = 1 / (3 * EJ(d) * (1 + d.reference * d.E * d.expansion * d.expansion / d.heat_capacity));  // compliance of the end
  for (const double step : {0.5, 0.02}) {
    const Stepping s = run(d, {step, Order::two, true, {}}, growing(), 3);
    REQUIRE(s.broken().size() == 1);
    CHECK(s.energy().released == doctest::Approx(kLimit * kLimit * (1 / kStiffness + at_once) / 2).epsilon(1e-8));
  }
}

TEST_CASE("the scheme keeps its order, decomposed or not, and the energy is balanced") {
  const Data d = propped(0.4);
  const auto at_end = [&](Order order, int steps, bool decompose = true) { return run(d, {1.0 / steps, order, decompose, {}}, pressing(), 1); };
  const Stepping exact = at_end(Order::two, 1024);
  REQUIRE(exact.broken().size() == 1);
  CHECK(exact.decomposed() == std::vector<std::string>{"stretching", "bending"});  // a cantilever now
  const auto error = [&](const Stepping& s) { return std::abs(s.deflection(1) - exact.deflection(1)); };
  const auto late = [&](const Stepping& s) { return std::abs(s.broken()[0].time - exact.broken()[0].time); };
  for (const Order order : {Order::one, Order::two}) {
    const Stepping coarse = at_end(order, 32), fine = at_end(order, 128);
    const double expected = order == Order::one ? 4 : 16;
    CAPTURE(expected);
    CHECK(error(coarse) / error(fine) > 0.7 * expected);
    CHECK(late(coarse) / late(fine) > 0.7 * expected);
    CHECK(std::abs(coarse.energy().defect / fine.energy().defect) > 0.7 * expected);
    CHECK(fine.energy().released > 0);
    CHECK(std::abs(fine.deflection(1) - at_end(order, 128, false).deflection(1)) < 1e-8);
  }
}

TEST_CASE("one support that breaks overloads the next, also at rest; all at once where they bear the same") {
  Data d = thermal_beam(16);
  for (const double x : {0.25, 0.5, 0.75})
    d.supports.insert(d.supports.end() - 1, {text("x = ", x), x, law(&laws::breaking, 1e5, 0.4), {}, {}});
  d.supports[0].deflection = d.supports[4].deflection = law(&laws::prescribed);
  d.supports[0].displacement = law(&laws::prescribed);
  const Stepping s = run(d, {0.1, Order::two, true, {}}, growing(), 3);
  REQUIRE(s.broken().size() == 3);
  CHECK(s.broken()[0].time == s.broken()[2].time);
  CHECK(s.broken()[0].name != "x = 0.5 deflection");  // the outer two first, then the middle one bears their share
  CHECK(s.broken()[2].name == "x = 0.5 deflection");
  Loads heavy;
  heavy.transverse.constant = -3;
  const Stepping rest(d, {}, {0.1, Order::two, true, {}}, heavy, monitor);
  CHECK(rest.broken().size() == 3);
  CHECK(rest.broken()[0].time == 0);
  CHECK(rest.reaction(0).force == doctest::Approx(1.5));
}

TEST_CASE("a beam that falls when its support breaks is refused by name, and left as it was") {
  Data d = thermal_beam(8);
  d.supports[0].deflection = d.supports[0].displacement = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::breaking, kStiffness, kLimit);
  Stepping s(d, {}, {0.1, Order::two, true, {}}, growing(), monitor);
  s.run(0.5, growing(), monitor);
  const double deflection = s.deflection(0.5);
  std::string what;
  try {
    s.run(1, growing(), monitor);
  } catch (const InputError& error) {
    what = error.what();
  }
  CHECK(what.find("after a support broke at t = 0.6 (right deflection): no solution at t = 0.6") == 0);
  CHECK(s.time() <= 0.6);  // at the last whole step
  CHECK(s.broken().empty());
  CHECK(s.deflection(0.5) <= deflection);
}

TEST_CASE("a bar between walls breaks a support along its axis while bending goes on") {
  Data d = thermal_beam(8);
  d.supports[0].deflection = d.supports[1].deflection = d.supports[0].displacement = law(&laws::prescribed);
  d.supports[1].displacement = law(&laws::breaking, 30, 0.5);
  Loads heated;
  heated.heat = source([](double, double t) { return 2 * t; });
  const Stepping s = run(d, {0.05, Order::two, true, {}}, heated, 2);
  REQUIRE(s.broken().size() == 1);
  CHECK(s.broken()[0].name == "right displacement");
  CHECK(s.normal(0.5) == doctest::Approx(0));
  CHECK(s.displacement(1) > 0);
}

TEST_CASE("a temperature that jumps while a support breaks, or before a short step, puts in what it does otherwise") {
  Data d = propped(0.4);
  d.heat_ends[0].mean = d.heat_ends[0].gradient = true;
  Loads jumping = pressing();
  jumping.mean[0] = history([](double t) { return t > 0.3 ? 1.0 : 0; });
  jumping.gradient[0] = history([](double t) { return t > 0.3 ? 2.0 : 0; });
  const auto put_in = [&](int steps, double shortest) {
    Stepping s(d, {}, {1.0 / steps, Order::two, true, {}}, jumping, monitor);
    s.run(0.3, jumping, monitor);
    s.run(0.3 + shortest, jumping, monitor);
    s.run(1, jumping, monitor);
    CHECK(s.broken().size() == 1);
    CHECK(std::abs(s.energy().defect) < 0.1 * s.energy().put_in);
    return s.energy().put_in;
  };
  const double expected = put_in(400, 0.001);
  for (const double shortest : {1e-10, 1e-6, 1e-3}) CHECK(put_in(200, shortest) == doctest::Approx(expected).epsilon(0.02));
}
