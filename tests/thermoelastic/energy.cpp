// stored + dissipated = put in + stored at first, to the order of the scheme.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/thermoelastic_beam.hpp"

using namespace dotyk;
using namespace dotyk::test;
using namespace dotyk::thermoelastic;

namespace {

Loads driving_loads() {
  Loads out;
  out.transverse = source([](double x, double t) { return -1 - std::sin(5 * t) * x; });
  out.axial = source([](double x, double t) { return x * std::sin(3 * t); });
  out.heat_gradient = source([](double x, double t) { return 20 * std::sin(2 * t) * x; });
  out.ambient_below = history([](double t) { return std::sin(3 * t); });
  out.mean[0] = history([](double t) { return 0.5 * std::sin(t); });
  return out;
}

/// A propped cantilever on a one-sided spring, its axis held by friction and a spring, one end's temperature moving.
Data held_beam() {
  Data d = thermal_beam(8, 0.2, 0.8);
  d.supports[0].deflection = d.supports[0].rotation = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::one_sided_elastic, 10);
  d.supports[0].displacement = law(&laws::friction, 0.3);
  d.supports[1].displacement = law(&laws::elastic, 5);
  d.heat_ends[0].mean = true;
  return d;
}

Energy balance(Order order, int steps) {
  Stepping s(held_beam(), {}, {1.0 / steps, order, true, {}}, driving_loads(), monitor);
  s.run(1, driving_loads(), monitor);
  return s.energy();
}

}  // namespace

TEST_CASE("the defect of the balance falls with the scheme's order, and what is dissipated is not negative") {
  for (const Order order : {Order::one, Order::two}) {
    const Energy coarse = balance(order, 64), fine = balance(order, 256);
    const double expected = order == Order::one ? 4 : 16;
    CAPTURE(coarse.defect);
    CAPTURE(fine.defect);
    CHECK(fine.dissipated > 0);
    CHECK(std::abs(fine.defect) < 2e-2 * fine.dissipated);
    // The order, over a factor four; branches of the laws change between steps, which costs some of it.
    CHECK(coarse.defect / fine.defect > 0.75 * expected);
    CHECK(coarse.defect / fine.defect < 1.35 * expected);
  }
}

TEST_CASE("left alone, a warm beam's stored energy only falls, and Euler's scheme dissipates more than conduction does") {
  Data d = held_beam();
  d.heat_ends = {};
  const Initial initial{{1, {}}, source([](double x, double) { return 4 * x; })};
  Stepping s(d, initial, {0.02, Order::one, true, {}}, {}, monitor);
  double stored = s.energy().stored;
  for (int i = 0; i < 50; ++i) {
    s.step({}, monitor);
    const Energy now = s.energy();
    CHECK(now.stored <= stored);
    CHECK(now.defect <= 0);
    CHECK(now.put_in == 0);
    stored = now.stored;
  }
}
