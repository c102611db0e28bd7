// The decomposition of P4: where statics gives the reactions, the heat is solved without the displacement.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/thermoelastic_beam.hpp"

using namespace dotyk;
using namespace dotyk::test;
using namespace dotyk::thermoelastic;

namespace {

struct Case {
  const char* name;
  problem::LawChoice left_deflection, left_rotation, right_deflection, right_rotation;
};

const problem::LawChoice kNone{}, kHeld = law(&laws::prescribed, 0.01), kAtNought = law(&laws::prescribed);

Data beam_of(const Case& c, double above = 0.2) {
  Data d = thermal_beam(16, above, 0.2);
  d.supports[0].deflection = c.left_deflection;
  d.supports[0].rotation = c.left_rotation;
  d.supports[1].deflection = c.right_deflection;
  d.supports[1].rotation = c.right_rotation;
  d.supports[0].displacement = kAtNought;
  return d;
}

/// Loads and heat that change in time and space, pressing on both ends throughout.
Loads pressing_loads() {
  Loads out;
  out.transverse = source([](double x, double t) { return -1 - 0.3 * std::sin(5 * t) * x; });
  out.axial = source([](double x, double t) { return x * std::cos(3 * t); });
  out.heat = source([](double x, double t) { return std::sin(2 * t) * (1 + x); });
  out.ambient_above = history([](double t) { return std::sin(3 * t); });
  return out;
}

/// Decomposed against coupled after 200 steps to time 2: the greatest difference, relative to the greatest value.
double difference(const Data& d, Order order, const std::vector<std::string>& expected) {
  const Loads driving = pressing_loads();
  const Initial initial{{0.3, {}}, source([](double x, double) { return x * x; })};
  Stepping apart(d, initial, {0.01, order, true, {}}, driving, monitor), coupled(d, initial, {0.01, order, false, {}}, driving, monitor);
  apart.run(2, driving, monitor);
  coupled.run(2, driving, monitor);
  CHECK(apart.steps() == 200);
  CHECK(apart.decomposed() == expected);
  CHECK(coupled.decomposed().empty());
  double worst = 0;
  const auto compare = [&](auto value) {
    double most = 0, off = 0;
    for (int i = 0; i <= 10; ++i) {
      const double x = i / 10.0;
      most = std::max(most, std::abs(value(coupled, x)));
      off = std::max(off, std::abs(value(coupled, x) - value(apart, x)));
    }
    worst = std::max(worst, off / most);
  };
  compare([](const Stepping& s, double x) { return s.deflection(x); });
  compare([](const Stepping& s, double x) { return s.rotation(x); });
  compare([](const Stepping& s, double x) { return s.displacement(x); });
  compare([](const Stepping& s, double x) { return s.temperature(x); });
  compare([](const Stepping& s, double x) { return s.gradient(x); });
  compare([](const Stepping& s, double x) { return s.moment(x); });
  compare([](const Stepping& s, double x) { return s.normal(x); });
  compare([](const Stepping& s, double x) { return s.reaction(x < 0.5 ? 0 : 1).force + s.reaction(x < 0.5 ? 0 : 1).moment; });
  return worst;
}

}  // namespace

TEST_CASE("decomposed and coupled agree after 200 steps in the six exceptional cases and where solvability forces one" * doctest::test_suite("large")) {
  const auto spring = law(&laws::elastic, 20), weak = law(&laws::elastic, 5);
  const problem::LawChoice unequal{&laws::unequal_elastic, 20, 5};
  const std::vector<Case> cases{
      {"1, simply supported", kHeld, kNone, kAtNought, kNone},
      {"2, cantilever", kHeld, kHeld, kNone, kNone},
      {"3, simply supported and guided", kHeld, kNone, kNone, kAtNought},
      {"4, simply supported by springs", spring, kNone, weak, kNone},
      {"5, cantilever held by springs", spring, weak, kNone, kNone},
      {"6, simply supported and guided by springs", spring, kNone, kNone, weak},
      {"simply supported, one end loaded by a moment", kHeld, law(&laws::load, 0.2), kAtNought, kNone},
      {"theorem 2, one-sided springs", law(&laws::one_sided_elastic, 20), kNone, law(&laws::one_sided_elastic, 30), kNone},
      {"theorem 3, Signorini", law(&laws::signorini), kNone, law(&laws::signorini), kNone},
      {"theorem 4, friction against rotation", kAtNought, law(&laws::friction, 2), kNone, kNone},
      {"theorem 5, friction against deflection", law(&laws::friction, 2), kNone, law(&laws::friction, 2), kNone},
      {"one-sided friction", law(&laws::one_sided_friction, 2), kNone, law(&laws::one_sided_friction, 2), kNone},
      {"capped springs", law(&laws::capped_elastic, 20, 2), kNone, law(&laws::capped_elastic, 20, 2), kNone},
      {"springs of two stiffnesses", unequal, kNone, unequal, kNone},
      {"springs of two stiffnesses about the rotation", kHeld, unequal, kNone, kNone},
      {"laws without strength besides", kHeld, law(&laws::friction, 0), kAtNought, law(&laws::elastic, 0)},
  };
  const std::vector<std::string> both{"stretching", "bending"};
  for (const Case& c : cases)
    for (const double above : {0.2, 0.7})
      for (const Order order : {Order::one, Order::two}) {
        CAPTURE(c.name);
        CAPTURE(above);
        CHECK(difference(beam_of(c, above), order, both) < 1e-8);
      }
}

TEST_CASE("an overhanging beam on two inner supports is decomposed as well") {
  Data d = thermal_beam(16);
  d.supports.insert(d.supports.begin() + 1, {{"x = 0.2", 0.2, law(&laws::signorini), {}, {}}, {"x = 0.7", 0.7, law(&laws::signorini), {}, {}}});
  d.supports[0].displacement = kAtNought;
  d.supports[3].deflection = law(&laws::load, -0.1);
  CHECK(difference(d, Order::two, {"stretching", "bending"}) < 1e-8);
}

TEST_CASE("what statics does not give is coupled: three supports, two clamped ends, a bar between walls") {
  const std::vector<Case> cases{{"propped", kAtNought, kAtNought, law(&laws::signorini), kNone},
                                {"clamped", kAtNought, kAtNought, kAtNought, kAtNought},
                                {"both rotations", kNone, kAtNought, kNone, kAtNought},
                                {"elastic rotation", kAtNought, law(&laws::elastic, 1), kAtNought, kNone}};
  for (const Case& c : cases) {
    CAPTURE(c.name);
    Data d = beam_of(c);
    if (c.name == std::string("both rotations")) d.supports.insert(d.supports.begin() + 1, {"x = 0.5", 0.5, kAtNought, {}, {}});
    CHECK(difference(d, Order::two, {"stretching"}) < 1e-8);
  }
  Data d = beam_of({"", kAtNought, kNone, kAtNought, kNone});
  d.supports[0].displacement = d.supports[1].displacement = kAtNought;
  CHECK(difference(d, Order::two, {"bending"}) < 1e-8);
  d.exchange_above = 0.9;  // bending decomposed, coupled by the heat with stretching that is not
  CHECK(difference(d, Order::two, {"bending"}) < 1e-8);
}

TEST_CASE("at the limit of a law a step is coupled, and goes on") {
  Data d = beam_of({"", law(&laws::signorini), kNone, law(&laws::signorini), kNone});
  Loads driving;
  driving.transverse = source([](double, double t) { return -std::max(0.0, std::sin(2 * M_PI * t)); });  // rests unloaded from 0.5 to 1
  Stepping s(d, {}, {0.05, Order::one, true, {}}, driving, monitor);
  s.run(0.4, driving, monitor);
  CHECK(s.decomposed() == std::vector<std::string>{"stretching", "bending"});
  s.run(1.2, driving, monitor);
  CHECK(s.decomposed() == std::vector<std::string>{"stretching"});
  CHECK(s.reaction(0).force == doctest::Approx(0.5 * std::sin(2.4 * M_PI)));
}
