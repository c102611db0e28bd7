// Thermoelastic beams whose solutions are known in closed form.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/thermoelastic_beam.hpp"
#include "base/error.hpp"

using namespace dotyk;
using namespace dotyk::test;
using namespace dotyk::thermoelastic;

namespace {

constexpr double kPi = M_PI;

}  // namespace

TEST_CASE("a sine of the gradient in a simply supported beam decays at (π² + a₂₂)/(a₁ + a₂α)") {
  for (const bool decompose : {true, false}) {
    Data d = thermal_beam(24);
    d.supports[0].deflection = d.supports[1].deflection = law(&laws::prescribed);
    d.heat_ends = {HeldHeat{true, true}, HeldHeat{true, true}};
    const Initial initial{{}, source([](double x, double) { return std::sin(kPi * x); })};
    Stepping s(d, initial, {1e-3, Order::two, decompose, {}}, {}, monitor);
    const Coefficients a(d);
    s.run(0.1, {}, monitor);
    const double rate = (kPi * kPi + a.a22) / (a.a1 + a.a2 * d.expansion), theta = std::exp(-rate * 0.1);
    // Alexander's scheme errs by its constant times (rate·τ)² rate·t ≈ 1e-5 of the solution; cubic elements by far less.
    CHECK(s.gradient(0.5) == doctest::Approx(theta).epsilon(1e-4));
    CHECK(s.gradient(0.2) == doctest::Approx(theta * std::sin(0.2 * kPi)).epsilon(1e-4));
    CHECK(s.deflection(0.5) == doctest::Approx(d.expansion * theta / (kPi * kPi)).epsilon(1e-4));
    CHECK(std::abs(s.moment(0.3)) < 1e-10);
    CHECK(std::abs(s.reaction(0).force) < 1e-10);
  }
}

TEST_CASE("a free bar cools at a₁₁/(a₁ + a₂α), a held one at a₁₁/a₁ under N = −EFαϑ") {
  for (const bool held : {false, true}) {
    Data d = thermal_beam(4);
    if (held) d.supports[0].displacement = d.supports[1].displacement = law(&laws::prescribed);
    const Initial initial{{2, {}}, {}};
    Stepping s(d, initial, {1e-2, Order::two, true, {}}, {}, monitor);
    s.run(1, {}, monitor);
    const Coefficients a(d);
    const double rate = a.a11 / (held ? a.a1 : a.a1 + a.a2 * d.expansion), theta = 2 * std::exp(-rate);
    CHECK(s.temperature(0.3) == doctest::Approx(theta).epsilon(1e-5));
    CHECK(s.normal(0.7) == doctest::Approx(held ? -d.E * a.F * d.expansion * theta : 0).epsilon(1e-5));
    CHECK(s.reaction(0).axial == doctest::Approx(held ? d.E * a.F * d.expansion * theta : 0).epsilon(1e-5));
    CHECK(s.displacement(1) - s.displacement(0) == doctest::Approx(held ? 0 : d.expansion * theta).epsilon(1e-5));
    CHECK(s.decomposed() == (held ? std::vector<std::string>{"bending"} : std::vector<std::string>{"stretching", "bending"}));
  }
}

TEST_CASE("a heated bar between two walls that only push presses on both, cooled it leaves them") {
  for (const double sign : {1.0, -1.0}) {
    Data d = thermal_beam(4);
    d.supports[0].displacement = d.supports[1].displacement = law(&laws::signorini);
    const Initial initial{{sign, {}}, {}};
    Stepping s(d, initial, {0.1, Order::one, true, {}}, {}, monitor);
    const double force = sign > 0 ? d.E * 0.5 * d.expansion : 0;
    CHECK(s.reaction(0).axial == doctest::Approx(force));
    CHECK(s.reaction(1).axial == doctest::Approx(-force));
    CHECK(s.displacement(1) - s.displacement(0) == doctest::Approx(sign > 0 ? 0 : -d.expansion));
    CHECK(s.displacement(0) >= -1e-12);
    CHECK(s.displacement(1) <= 1e-12);
  }
}

TEST_CASE("a uniform gradient bends a clamped beam not at all, with M = −EJα ϑ₂; a free one to a circle") {
  Data d = thermal_beam(6);
  const Initial initial{{}, {3, {}}};
  const double EJ = d.E * Coefficients(d).J;
  {
    Stepping s(d, initial, {0.1, Order::one, true, {}}, {}, monitor);
    CHECK(s.deflection(0.5) - 0.5 * (s.deflection(0) + s.deflection(1)) == doctest::Approx(3 * d.expansion / 8));
    CHECK(std::abs(s.moment(0.5)) < 1e-10);
  }
  for (Support& end : d.supports) end.deflection = end.rotation = law(&laws::prescribed);
  Stepping s(d, initial, {0.1, Order::one, true, {}}, {}, monitor);
  CHECK(std::abs(s.deflection(0.4)) < 1e-12);
  CHECK(s.moment(0.4) == doctest::Approx(-EJ * d.expansion * 3));
  CHECK(s.reaction(0).moment == doctest::Approx(-EJ * d.expansion * 3));
}

TEST_CASE("without heat it is the beam: deflection, moment and shear of a propped cantilever, exact at nodes") {
  Data d = thermal_beam(7);
  d.supports[0].deflection = d.supports[0].rotation = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::signorini);
  Loads loads;
  loads.transverse.constant = -2;
  loads.axial.constant = 3;
  d.supports[0].displacement = law(&laws::elastic, 20);
  Stepping s(d, {}, {0.1, Order::two, true, {}}, loads, monitor);
  const double EJ = d.E * Coefficients(d).J, EF = d.E * 0.5;
  CHECK(s.reaction(1).force == doctest::Approx(3 * 2.0 / 8).epsilon(1e-10));
  CHECK(s.reaction(0).moment == doctest::Approx(2.0 / 8).epsilon(1e-10));
  for (const double x : {0.0, 1.0 / 7, 4.0 / 7, 1.0}) {
    const double y = 1 - x;  // propped at y = 0: u = −q (y − 3y³ + 2y⁴)/(48 EJ)
    CHECK(s.deflection(x) == doctest::Approx(-2 * (y - 3 * y * y * y + 2 * y * y * y * y) / (48 * EJ)).epsilon(1e-9));
    CHECK(s.displacement(x) == doctest::Approx(3.0 / 20 + 3 * (x - x * x / 2) / EF).epsilon(1e-10));
  }
  for (const double x : {0.05, 0.5, 0.93}) {
    CHECK(s.moment(x) == doctest::Approx((1 - x) * (1 - x) - 0.75 * (1 - x)).epsilon(1e-9));
    CHECK(s.shear(x) == doctest::Approx(0.75 - 2 * (1 - x)).epsilon(1e-9));
    CHECK(s.normal(x) == doctest::Approx(3 * (1 - x)).epsilon(1e-10));
  }
}

TEST_CASE("what cannot be solved is refused with the time, the motion and the theorem, and the state stays") {
  Data d = thermal_beam(4);
  d.supports[0].deflection = d.supports[1].deflection = law(&laws::signorini);
  Loads loads;
  loads.transverse = source([](double, double t) { return t - 0.55; });
  for (const bool decompose : {true, false}) {
    Stepping s(d, {}, {0.1, Order::one, decompose, {}}, loads, monitor);
    s.run(0.4, loads, monitor);
    const double before = s.deflection(0.5);
    std::string message;
    try {
      s.run(1, loads, monitor);
    } catch (const InputError& error) {
      message = error.what();
    }
    CHECK(message.find("no solution at t = 0.6") != std::string::npos);
    CHECK(message.find("theorem 3") != std::string::npos);
    CHECK(s.time() == doctest::Approx(0.5));
    CHECK(std::isfinite(s.deflection(0.5)));
    CHECK(s.deflection(0.5) > before);  // the load is almost gone at 0.5
  }
}

TEST_CASE("numbers that make no sense are refused") {
  const auto refused = [](auto change) {
    Data d = thermal_beam(4);
    change(d);
    CHECK_THROWS_AS(Stepping(d, {}, {0.1, Order::one, true, {}}, {}, monitor), InputError);
  };
  refused([](Data& d) { d.height = 0; });
  refused([](Data& d) { d.conductivity = -1; });
  refused([](Data& d) { d.expansion = NAN; });
  refused([](Data& d) { d.exchange_above = -1; });
  refused([](Data& d) { d.reference = 0; });
  refused([](Data& d) { d.cells = 0; });
  refused([](Data& d) { d.supports[0].deflection = law(&laws::elastic, -1); });
  Data d = thermal_beam(4);
  CHECK_THROWS_AS(Stepping(d, {}, {0, Order::one, true, {}}, {}, monitor), InputError);
  Stepping s(d, {}, {0.1, Order::one, true, {}}, {}, monitor);
  CHECK_THROWS_AS(s.run(-1, {}, monitor), InputError);
  CHECK_THROWS_AS(s.run(NAN, {}, monitor), InputError);
  CHECK_THROWS_AS(s.deflection(1.1), InputError);
  CHECK_THROWS_AS(s.temperature(0.1, 0.3), InputError);
}
