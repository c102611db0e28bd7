// Springs of two stiffnesses in time: what they are with equal ones and with one of 0, and the side of each displacement.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "../support/thermoelastic_beam.hpp"

using namespace dotyk;
using namespace dotyk::test;
using namespace dotyk::thermoelastic;

namespace {

problem::LawChoice unequal(double push, double pull) { return {&laws::unequal_elastic, push, pull}; }

/// A cantilever whose other end has the law in every displacement, bent and stretched to and fro.
std::unique_ptr<const Stepping> moved(const problem::LawChoice& law, double time) {
  Data d = thermal_beam(8);
  d.supports[0].deflection = d.supports[0].rotation = d.supports[0].displacement = test::law(&laws::prescribed);
  d.supports[1].deflection = d.supports[1].rotation = d.supports[1].displacement = law;
  Loads loads;
  loads.transverse = source([](double, double t) { return -std::cos(5 * t); });
  loads.axial = source([](double, double t) { return std::sin(4 * t); });
  auto s = std::make_unique<Stepping>(d, Initial{}, Scheme{0.05, Order::two, true, {}}, loads, monitor);
  s->run(time, loads, monitor);
  return s;
}

double difference(const std::unique_ptr<const Stepping>& left, const std::unique_ptr<const Stepping>& right) {
  const Stepping &a = *left, &b = *right;
  const auto off = [](double x, double y) { return std::abs(x - y) / std::max(std::abs(y), 1e-3); };
  return std::max({off(a.deflection(1), b.deflection(1)), off(a.rotation(1), b.rotation(1)), off(a.displacement(1), b.displacement(1)),
                   off(a.temperature(0.5), b.temperature(0.5)), off(a.gradient(0.5), b.gradient(0.5))});
}

}  // namespace

TEST_CASE("with equal stiffnesses it is elastic, with one of 0 one-sided elastic, also along the axis") {
  for (const double time : {0.2, 1.0}) {
    CHECK(difference(moved(unequal(7, 7), time), moved(law(&laws::elastic, 7), time)) < 1e-12);
    CHECK(difference(moved(unequal(7, 0), time), moved(law(&laws::one_sided_elastic, 7), time)) < 1e-12);
  }
}

TEST_CASE("a spring of two stiffnesses pushes up, against slopes above zero and inwards, and pulls the other ways") {
  bool pushed[3]{}, pulled[3]{};
  for (const double time : {0.1, 0.4, 0.7, 1.0, 1.3, 1.6, 1.9}) {
    const auto s = moved(unequal(7, 2), time);
    const Reaction r = s->reaction(1);
    const std::array<double, 3> v{s->deflection(1), -s->rotation(1), -s->displacement(1)}, force{r.force, -r.moment, -r.axial};
    for (int i = 0; i < 3; ++i) {
      (v[i] < 0 ? pushed : pulled)[i] = true;
      CHECK(force[i] == doctest::Approx(-(v[i] < 0 ? 7 : 2) * v[i]).epsilon(1e-10));
    }
  }
  for (int i = 0; i < 3; ++i) CHECK((pushed[i] && pulled[i]));
}
