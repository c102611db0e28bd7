// Supports that move, and forces at them that vary in time: û, T̂ and M̂ of P4; Young's modulus and expansion along the beam.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "../support/thermoelastic_beam.hpp"

using namespace dotyk;
using namespace dotyk::test;
using namespace dotyk::thermoelastic;

namespace {

History wave(double amplitude, double frequency = 1) {
  return history([=](double t) { return amplitude * std::sin(frequency * t); });
}

/// Without expansion heat does nothing.
Data cold_beam(int cells = 4) {
  Data d = thermal_beam(cells);
  d.expansion = 0;
  return d;
}

/// The same for both orders, decomposed or not: f(stepping, t) at several times.
template <class Check>
void at_times(const Data& data, const Loads& loads, Check check) {
  for (const Order order : {Order::one, Order::two})
    for (const bool decompose : {true, false}) {
      CAPTURE(decompose);
      Stepping s(data, {}, {0.1, order, decompose, {}}, loads, monitor);
      for (const double t : {0.0, 0.7, 2.0, 4.5}) {
        s.run(t, loads, monitor);
        CAPTURE(t);
        check(s, t);
      }
    }
}

}  // namespace

TEST_CASE("a settlement and a turn of one end of a clamped beam, in closed form") {
  Data d = cold_beam();
  for (Support& s : d.supports) s.deflection = s.rotation = law(&laws::prescribed);
  d.supports[0].deflection.numbers[0] = 0.25;  // what is prescribed adds to the place
  Loads loads;
  loads.supports = {{0, {wave(0.5), {}}, {wave(-0.3, 2), {}}, {}}};
  const double EJ = d.E * Coefficients(d).J;
  for (const Order order : {Order::one, Order::two}) {
    Stepping s(d, {}, {0.1, order, true, {}}, loads, monitor);
    for (const double t : {0.0, 0.7, 2.0}) {
      s.run(t, loads, monitor);
      const double h = 0.25 + 0.5 * std::sin(t), turn = -0.3 * std::sin(2 * t), x = 0.4;
      CHECK(s.deflection(x) == doctest::Approx(h * (1 - x * x * (3 - 2 * x)) + turn * x * (1 - x) * (1 - x)).epsilon(1e-10));
      CHECK(s.reaction(0).force == doctest::Approx(EJ * (12 * h + 6 * turn)).epsilon(1e-9));
      CHECK(s.reaction(0).moment == doctest::Approx(EJ * (6 * h + 4 * turn)).epsilon(1e-9));
      CHECK(s.reaction(1).force == doctest::Approx(-EJ * (12 * h + 6 * turn)).epsilon(1e-9));
    }
  }
}

TEST_CASE("T + ku = T̂ and M - mDu = M̂ at the end of a cantilever, the springs' feet moving; the same along the axis") {
  Data d = cold_beam();
  const double EJ = d.E * Coefficients(d).J, EF = d.E * Coefficients(d).F, k = 2, m = 0.5, axial = 30;
  d.supports[0].deflection = d.supports[0].rotation = d.supports[0].displacement = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::elastic, k);
  d.supports[1].rotation = law(&laws::elastic, m);
  d.supports[1].displacement = law(&laws::elastic, axial);
  Loads loads;
  loads.supports = {{1, {wave(0.2), wave(0.7, 3)}, {wave(0.1, 2), wave(-0.4)}, {wave(0.05), wave(4, 2)}}, {0, {}, {}, {wave(-0.02), {}}}};
  at_times(d, loads, [&](const Stepping& s, double t) {
    // The tip under P and C: u = P/3EJ + C/2EJ, u' = P/2EJ + C/EJ, P = T̂ − k(u − û), C = M̂ − m(u' − ŵ).
    Eigen::Matrix2d flexibility;
    flexibility << 1 / (3 * EJ), 1 / (2 * EJ), 1 / (2 * EJ), 1 / EJ;
    const Eigen::Vector2d springs(k, m), feet(0.2 * std::sin(t), 0.1 * std::sin(2 * t)), given(0.7 * std::sin(3 * t), -0.4 * std::sin(t));
    const Eigen::Matrix2d A = Eigen::Matrix2d::Identity() + flexibility * springs.asDiagonal();
    const Eigen::Vector2d u = A.inverse() * flexibility * (given + springs.cwiseProduct(feet));
    const Eigen::Vector2d P = given - springs.cwiseProduct(u - feet);
    const Reaction r = s.reaction(1);
    CHECK(r.deflection == doctest::Approx(u[0]).epsilon(1e-9));
    CHECK(r.rotation == doctest::Approx(u[1]).epsilon(1e-9));
    CHECK(r.force == doctest::Approx(P[0]).epsilon(1e-9));
    CHECK(r.moment == doctest::Approx(P[1]).epsilon(1e-9));
    CHECK(s.shear(0.5) == doctest::Approx(P[0]).epsilon(1e-9));  // T of P4 at x = L: T + ku = T̂ with the foot at 0
    const double left = -0.02 * std::sin(t), foot = 0.05 * std::sin(t), pull = 4 * std::sin(2 * t);
    const double N = EF * (pull - axial * (left - foot)) / (EF + axial);
    CHECK(s.normal(0.3) == doctest::Approx(N).epsilon(1e-9));
    CHECK(r.axial == doctest::Approx(N).epsilon(1e-9));
    CHECK(r.displacement == doctest::Approx(left + N / EF).epsilon(1e-9));
  });
}

TEST_CASE("a stop that rises meets the end of a cantilever") {
  Data d = cold_beam();
  const double EJ = d.E * Coefficients(d).J, q = -0.8, rest = q / (8 * EJ);
  d.supports[0].deflection = d.supports[0].rotation = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::signorini);
  Loads loads;
  loads.transverse.constant = q;
  loads.supports = {{1, {wave(-0.2), {}}, {}, {}}};
  bool lifted = false, pushed = false;
  at_times(d, loads, [&](const Stepping& s, double t) {
    const double h = -0.2 * std::sin(t), u = std::max(rest, h);
    (u > h ? lifted : pushed) = true;
    CHECK(s.deflection(1) == doctest::Approx(u).epsilon(1e-9));
    CHECK(s.reaction(1).force == doctest::Approx(3 * EJ * (u - rest)).scale(1).epsilon(1e-9));
  });
  CHECK((lifted && pushed));
}

TEST_CASE("places and forces that stay are prescribed displacements and loads") {
  Data d = thermal_beam(8, 0.2, 0.8), constant = d;
  for (Data* data : {&d, &constant}) {
    data->supports.insert(data->supports.begin() + 1, {"middle", 0.4, law(&laws::elastic, 3), {}, {}});
    data->supports[0].deflection = data->supports[0].rotation = data->supports[0].displacement = law(&laws::prescribed);
    data->supports[2].deflection = law(&laws::prescribed);
  }
  constant.supports[0].deflection.numbers[0] = 0.1;
  constant.supports[0].rotation.numbers[0] = -0.2;
  constant.supports[0].displacement.numbers[0] = 0.03;
  constant.supports[1].rotation = law(&laws::load, 0.7);
  constant.supports[2].displacement = law(&laws::load, 2);
  Loads still, driven;
  still.heat_gradient = driven.heat_gradient = source([](double x, double t) { return 20 * std::sin(2 * t) * x; });
  const auto number = [](double value) { return History{value, {}}; };
  driven.supports = {{1, {}, {}, {{}, number(2)}},
                     {0.4, {}, {{}, number(0.7)}, {}},
                     {0, {number(0.1), {}}, {number(-0.2), {}}, {number(0.03), {}}}};
  Stepping a(constant, {}, {0.1, Order::two, true, {}}, still, monitor), b(d, {}, {0.1, Order::two, true, {}}, driven, monitor);
  a.run(1, still, monitor);
  b.run(1, driven, monitor);
  for (const double x : {0.1, 0.6}) {
    CHECK(b.deflection(x) == doctest::Approx(a.deflection(x)).epsilon(1e-11));
    CHECK(b.displacement(x) == doctest::Approx(a.displacement(x)).epsilon(1e-11));
    CHECK(b.temperature(x) == doctest::Approx(a.temperature(x)).epsilon(1e-11));
  }
  for (int i = 0; i < 3; ++i) {
    CHECK(b.reaction(i).force == doctest::Approx(a.reaction(i).force).epsilon(1e-10));
    CHECK(b.reaction(i).moment == doctest::Approx(a.reaction(i).moment).scale(1).epsilon(1e-10));
    CHECK(b.reaction(i).axial == doctest::Approx(a.reaction(i).axial).epsilon(1e-10));
  }
  CHECK(b.energy().put_in == doctest::Approx(a.energy().put_in).epsilon(1e-10));
}

TEST_CASE("supports that move rigidly carry the beam along: temperatures and reactions of every law stay") {
  const auto with = [](const problem::LawSpec* kind) {
    Data d = thermal_beam(8, 0.2, 0.8);
    d.supports[0].deflection = law(kind, 2, 0.3), d.supports[0].deflection.numbers[1] = 0.5;
    d.supports[0].rotation = d.supports[0].deflection;
    d.supports[1].deflection = law(&laws::prescribed);
    d.supports[1].displacement = d.supports[0].deflection;
    return d;
  };
  for (const problem::LawSpec* kind : {&laws::elastic, &laws::one_sided_elastic, &laws::signorini, &laws::friction, &laws::one_sided_friction,
                             &laws::capped_elastic, &laws::unequal_elastic}) {
    CAPTURE(kind->words);
    Loads still, moved;
    still.transverse = moved.transverse = source([](double x, double t) { return -0.4 * (1 + 0.2 * std::sin(5 * t) * x); });
    still.heat_gradient = moved.heat_gradient = source([](double x, double t) { return 20 * std::sin(2 * t) * x; });
    still.heat = moved.heat = source([](double, double t) { return 5 * std::sin(6 * t); });
    still.axial = moved.axial = source([](double, double) { return 0.1; });
    // u + sin t − x·sin(2t)/2, u₁ + sin 3t.
    const History up = wave(1), turn = wave(-0.5, 2), along = wave(1, 3);
    moved.supports = {{0, {up, {}}, {turn, {}}, {along, {}}},
                      {1, {history([](double t) { return std::sin(t) - 0.5 * std::sin(2 * t); }), {}}, {turn, {}}, {along, {}}}};
    Stepping a(with(kind), {}, {0.05, Order::two, true, {}}, still, monitor), b(with(kind), {}, {0.05, Order::two, true, {}}, moved, monitor);
    for (const double t : {0.4, 1.0, 1.7}) {
      a.run(t, still, monitor);
      b.run(t, moved, monitor);
      for (const double x : {0.0, 0.7}) {
        CHECK(b.deflection(x) == doctest::Approx(a.deflection(x) + std::sin(t) - 0.5 * x * std::sin(2 * t)).scale(1).epsilon(1e-9));
        CHECK(b.displacement(x) == doctest::Approx(a.displacement(x) + std::sin(3 * t)).scale(1).epsilon(1e-9));
        CHECK(b.temperature(x, 0.2) == doctest::Approx(a.temperature(x, 0.2)).scale(1).epsilon(1e-9));
      }
      for (int i = 0; i < 2; ++i) {
        CHECK(b.reaction(i).force == doctest::Approx(a.reaction(i).force).scale(1).epsilon(1e-9));
        CHECK(b.reaction(i).moment == doctest::Approx(a.reaction(i).moment).scale(1).epsilon(1e-9));
        CHECK(b.reaction(i).axial == doctest::Approx(a.reaction(i).axial).scale(1).epsilon(1e-9));
      }
      CHECK(b.energy().stored == doctest::Approx(a.energy().stored).epsilon(1e-9));
    }
  }
}

namespace {

/// Heat bends and stretches; supports move and are pressed.
Data driven_beam() {
  Data d = thermal_beam(8, 0.2, 0.8);
  d.supports[0].deflection = d.supports[0].rotation = d.supports[0].displacement = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::elastic, 10);
  d.supports[1].rotation = law(&laws::elastic, 0.5);
  d.supports[1].displacement = law(&laws::elastic, 5);
  return d;
}

Loads driven_loads() {
  Loads out;
  out.transverse.constant = -1;
  out.supports = {{0, {wave(1), {}}, {wave(0.3, 2), {}}, {wave(0.2, 3), {}}}, {1, {wave(1, 2), wave(-0.5, 3)}, {wave(0.2), wave(0.3, 2)}, {wave(0.1), wave(1, 2)}}};
  return out;
}

}  // namespace

TEST_CASE("orders 1 and 2 in time under moving supports and end forces, and of the balance of energy" * doctest::test_suite("large")) {
  const auto at_end = [&](int steps, Order order, double& defect) {
    const Loads loads = driven_loads();
    Stepping s(driven_beam(), {}, {1.0 / steps, order, true, {}}, loads, monitor);
    s.run(1, loads, monitor);
    defect = s.energy().defect / s.energy().put_in;
    Eigen::VectorXd out(6);
    out << s.deflection(0.5), s.displacement(0.5), s.temperature(0.3), s.gradient(0.3), s.reaction(0).force, s.reaction(1).moment;
    return out;
  };
  double none = 0;
  const Eigen::VectorXd exact = at_end(4096, Order::two, none);
  for (const Order order : {Order::one, Order::two}) {
    const double expected = order == Order::one ? 4 : 16;
    double coarse_defect = 0, fine_defect = 0;
    const Eigen::VectorXd coarse = at_end(32, order, coarse_defect) - exact, fine = at_end(128, order, fine_defect) - exact;
    CAPTURE(coarse.transpose());
    CAPTURE(fine.transpose());
    CAPTURE(coarse_defect);
    CAPTURE(fine_defect);
    for (int i = 0; i < exact.size(); ++i) {
      CHECK(coarse[i] / fine[i] > 0.9 * expected);
      CHECK(coarse[i] / fine[i] < 1.1 * expected);
    }
    CHECK(coarse_defect / fine_defect > 0.8 * expected);
    CHECK(coarse_defect / fine_defect < 1.1 * expected);
    CHECK(std::abs(fine_defect) < (order == Order::one ? 0.1 : 1e-3));
  }
}

TEST_CASE("what statics decomposes stays so where its supports move and are pressed: reactions in closed form, the fields of the coupled solution") {
  // Simply supported on a rigid and an elastic support, all moments given; heat bends and stretches it.
  Data d = thermal_beam(8, 0.2, 0.2);
  d.supports[0].deflection = d.supports[0].displacement = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::elastic, 4);
  Loads loads;
  loads.transverse.constant = -1;
  loads.heat_gradient = source([](double x, double t) { return 20 * std::sin(2 * t) * x; });
  loads.supports = {{0, {wave(0.3), wave(0.2)}, {{}, wave(0.6, 2)}, {wave(0.1), {}}}, {1, {wave(0.4, 3), wave(-0.7)}, {{}, wave(-0.5)}, {{}, wave(2)}}};
  for (const Order order : {Order::one, Order::two}) {
    Stepping a(d, {}, {0.1, order, true, {}}, loads, monitor), b(d, {}, {0.1, order, false, {}}, loads, monitor);
    for (const double t : {0.5, 1.5}) {
      a.run(t, loads, monitor);
      b.run(t, loads, monitor);
      CHECK(a.decomposed().size() == 2);
      const double right = 0.5 - 0.6 * std::sin(2 * t) + 0.5 * std::sin(t);
      CHECK(a.reaction(1).force == doctest::Approx(right).epsilon(1e-10));
      CHECK(a.reaction(0).force == doctest::Approx(1 - right).epsilon(1e-10));
      CHECK(a.deflection(0) == doctest::Approx(0.3 * std::sin(t)).epsilon(1e-10));
      CHECK(a.deflection(1) == doctest::Approx(0.4 * std::sin(3 * t) - (right + 0.7 * std::sin(t)) / 4).epsilon(1e-10));
      CHECK(a.normal(0.5) == doctest::Approx(2 * std::sin(t)).epsilon(1e-9));
      for (const double x : {0.0, 0.3, 1.0}) {
        CHECK(b.deflection(x) == doctest::Approx(a.deflection(x)).scale(1).epsilon(1e-10));
        CHECK(b.displacement(x) == doctest::Approx(a.displacement(x)).scale(1).epsilon(1e-10));
        CHECK(b.temperature(x, 0.1) == doctest::Approx(a.temperature(x, 0.1)).scale(1).epsilon(1e-10));
      }
      CHECK(b.energy().put_in == doctest::Approx(a.energy().put_in).epsilon(1e-9));
      CHECK(b.energy().stored == doctest::Approx(a.energy().stored).epsilon(1e-9));
    }
  }
}

TEST_CASE("loads of a support that is not there are refused") {
  Loads loads;
  loads.supports = {{0.3, {wave(1), {}}, {}, {}}};
  CHECK_THROWS_WITH_AS(Stepping(driven_beam(), {}, {0.1, Order::two, true, {}}, loads, monitor), "no support is at x = 0.3, where loads of one are given", InputError);
}

TEST_CASE("a modulus and an expansion that jump, in closed form; the same by statics") {
  // Insulated, warm by ϑ₁ = 2 and ϑ₂ = 3 throughout: each half bends and stretches freely by its own expansion, the tip's load
  // bends it by its own modulus. At rest, at t = 0, nothing is coupled yet.
  Data d = thermal_beam(8, 0, 0);
  d.E_of = [](double x) { return x < 0.5 ? 100.0 : 25.0; };
  d.expansion_of = [](double x) { return x < 0.5 ? 0.1 : 0.3; };
  d.supports[0].deflection = d.supports[0].rotation = d.supports[0].displacement = law(&laws::prescribed);
  const double P = -0.2, N = 1.5, J = Coefficients(d).J, F = Coefficients(d).F;
  Loads loads;
  loads.supports = {{1, {{}, {P, {}}}, {}, {{}, {N, {}}}}};
  const Initial initial{{2, {}}, {3, {}}};
  const double first = 100 * J, second = 25 * J;
  // ∫(1 − x)² over the halves are 7/24 and 1/24; ∫(1 − x) are 3/8 and 1/8; u'' = P(1 − x)/EJ − αϑ₂.
  const double tip = P * (7 / (24 * first) + 1 / (24 * second)) - 3 * (0.1 * 3 / 8 + 0.3 / 8);
  const double end = 0.5 * (N / (100 * F) + 0.1 * 2 + N / (25 * F) + 0.3 * 2);
  std::vector<double> tips;
  for (const bool decompose : {true, false}) {
    Stepping s(d, initial, {0.1, Order::two, decompose, {}}, loads, monitor);
    CHECK(s.deflection(1) == doctest::Approx(tip).epsilon(1e-10));
    CHECK(s.displacement(1) == doctest::Approx(end).epsilon(1e-10));
    CHECK(s.moment(0.2) == doctest::Approx(-P * 0.8).epsilon(1e-9));
    s.run(1, loads, monitor);
    CHECK(s.moment(0.7) == doctest::Approx(-P * 0.3).epsilon(1e-9));
    CHECK(s.normal(0.7) == doctest::Approx(N).epsilon(1e-9));
    tips.push_back(s.deflection(1));
  }
  CHECK(tips[1] == doctest::Approx(tips[0]).epsilon(1e-11));
  d.E_of = [](double x) { return x - 0.5; };
  CHECK_THROWS_WITH_AS(Stepping(d, initial, {0.1, Order::two, true, {}}, loads, monitor),
                       "Young's modulus E is -0.4375 at x = 0.0625; it must be positive", InputError);
}

TEST_CASE("order 2 in the cells where the modulus and the expansion vary") {
  const auto at_end = [](int cells) {
    Data d = thermal_beam(cells, 0.2, 0.8);
    d.E_of = [](double x) { return 100 * (1 + x * x); };
    d.expansion_of = [](double x) { return 0.1 * std::exp(x); };
    for (Support& s : d.supports) s.deflection = s.rotation = s.displacement = law(&laws::prescribed);
    Loads loads;
    loads.transverse.constant = -1;
    loads.heat = loads.heat_gradient = source([](double x, double t) { return 20 * t * x; });
    Stepping s(d, {}, {0.1, Order::two, true, {}}, loads, monitor);
    s.run(0.5, loads, monitor);
    return Eigen::Vector4d(s.deflection(0.5), s.displacement(0.5), s.temperature(0.5), s.gradient(0.5));
  };
  const Eigen::Vector4d exact = at_end(256), coarse = at_end(8) - exact, fine = at_end(32) - exact;
  CAPTURE(coarse.transpose());
  CAPTURE(fine.transpose());
  for (int i = 0; i < 4; ++i) CHECK(std::abs(coarse[i]) > 12 * std::abs(fine[i]));
}
