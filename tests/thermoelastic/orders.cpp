// Convergence in space and time.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/thermoelastic_beam.hpp"

using namespace dotyk;
using namespace dotyk::test;
using namespace dotyk::thermoelastic;

namespace {

/// Everything a product g(t) × a function of x, unlike exchange above and below: all four fields coupled.
struct Manufactured {
  std::function<double(double)> g, rate;  ///< g and g'
  Data data = thermal_beam(8, 0.2, 0.8);
  // u = (x(1−x))² eˣ, u₁ = sin(2x)(1−x), ϑ₁ = cos x + x, ϑ₂ = sin 3x: derivatives by hand, 0 to 4.
  static double U(double x, int k) {
    const double p[] = {std::pow(x * (1 - x), 2), 2 * x * (1 - x) * (1 - 2 * x), 2 - 12 * x + 12 * x * x, -12 + 24 * x, 24};
    static const int binomial[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
    double sum = 0;
    for (int j = 0; j <= k; ++j) sum += binomial[k][j] * p[j];
    return sum * std::exp(x);
  }
  static double V(double x, int k) {
    if (k == 0) return std::sin(2 * x) * (1 - x);
    if (k == 1) return 2 * std::cos(2 * x) * (1 - x) - std::sin(2 * x);
    return -4 * std::sin(2 * x) * (1 - x) - 4 * std::cos(2 * x);
  }
  static double mean(double x, int k) { return k == 0 ? std::cos(x) + x : k == 1 ? 1 - std::sin(x) : -std::cos(x); }
  static double gradient(double x, int k) { return k == 0 ? std::sin(3 * x) : k == 1 ? 3 * std::cos(3 * x) : -9 * std::sin(3 * x); }

  Manufactured() {
    for (Support& s : data.supports) s.deflection = s.rotation = s.displacement = law(&laws::prescribed);
    data.heat_ends = {HeldHeat{true, true}, HeldHeat{true, true}};
  }
  Loads loads() const {
    const Coefficients a(data);
    const double EF = data.E * a.F, EJ = data.E * a.J, alpha = data.expansion, k = data.conductivity;
    Loads out;
    out.transverse = source([=, g = g](double x, double t) { return EJ * g(t) * (U(x, 4) + alpha * gradient(x, 2)); });
    out.axial = source([=, g = g](double x, double t) { return -EF * g(t) * (V(x, 2) - alpha * mean(x, 1)); });
    out.heat = source([=, g = g, d = rate](double x, double t) {
      return k * (d(t) * (a.a1 * mean(x, 0) + a.a2 * V(x, 1)) + g(t) * (a.a11 * mean(x, 0) + a.a12 * gradient(x, 0) - mean(x, 2)));
    });
    out.heat_gradient = source([=, g = g, d = rate](double x, double t) {
      return k * (d(t) * (a.a1 * gradient(x, 0) - a.a2 * U(x, 2)) + g(t) * (a.a22 * gradient(x, 0) + a.a21 * mean(x, 0) - gradient(x, 2)));
    });
    for (int end = 0; end < 2; ++end) {
      out.mean[end] = history([=, g = g](double t) { return g(t) * mean(end, 0); });
      out.gradient[end] = history([=, g = g](double t) { return g(t) * gradient(end, 0); });
    }
    return out;
  }
  Initial initial() const {
    return {source([g = g](double x, double) { return g(0) * mean(x, 0); }), source([g = g](double x, double) { return g(0) * gradient(x, 0); })};
  }
  /// Greatest errors at time 1 of u, u₁, ϑ₁ and ϑ₂.
  Eigen::Vector4d errors(int cells, Order order, int steps) const {
    Manufactured m = *this;
    m.data.cells = cells;
    const Loads driving = m.loads();
    Stepping s(m.data, m.initial(), {1.0 / steps, order, true, {}}, driving, monitor);
    s.run(1, driving, monitor);
    Eigen::Vector4d worst = Eigen::Vector4d::Zero();
    for (int i = 0; i <= 160; ++i) {
      const double x = i / 160.0, gt = g(1);
      const Eigen::Vector4d off(s.deflection(x) - gt * U(x, 0), s.displacement(x) - gt * V(x, 0), s.temperature(x) - gt * mean(x, 0), s.gradient(x) - gt * gradient(x, 0));
      worst = worst.cwiseMax(off.cwiseAbs());
    }
    return worst;
  }
};

}  // namespace

TEST_CASE("order 4 in space of deflection and temperatures, 3 of the axial displacement; linear in time is exact") {
  Manufactured m;
  m.g = [](double t) { return 1 + t; };
  m.rate = [](double) { return 1.0; };
  for (const Order order : {Order::one, Order::two}) {
    const Eigen::Vector4d coarse = m.errors(16, order, 4), fine = m.errors(64, order, 4);
    const Eigen::Vector4d rates = (coarse.array() / fine.array()).log() / std::log(4.0);
    CAPTURE(rates.transpose());
    CAPTURE(fine.transpose());
    CHECK(rates[0] > 3.8);
    CHECK(rates[1] > 2.9);
    CHECK(rates[2] > 3.8);
    CHECK(rates[3] > 3.8);
    CHECK(fine.maxCoeff() < 1e-6);
  }
}

TEST_CASE("orders 1 and 2 in time") {
  Manufactured m;
  m.g = [](double t) { return std::cos(3 * t); };
  m.rate = [](double t) { return -3 * std::sin(3 * t); };
  for (const Order order : {Order::one, Order::two}) {
    const Eigen::Vector4d coarse = m.errors(64, order, 12), fine = m.errors(64, order, 48);
    const Eigen::Vector4d rates = (coarse.array() / fine.array()).log() / std::log(4.0);
    CAPTURE(rates.transpose());
    CAPTURE(fine.transpose());
    for (int i = 0; i < 4; ++i) {
      CHECK(rates[i] > static_cast<int>(order) - 0.15);
      CHECK(rates[i] < static_cast<int>(order) + 0.3);
    }
  }
}

TEST_CASE("order 2 in time stays where supports close and open on the way" * doctest::test_suite("large")) {
  Data d = thermal_beam(12);
  d.supports[0].deflection = d.supports[0].rotation = law(&laws::prescribed);
  d.supports[1].deflection = law(&laws::signorini);
  d.supports[1].rotation = law(&laws::friction, 0.05);
  Loads driving;
  driving.transverse.constant = 0.05;
  driving.heat_gradient = source([](double x, double t) { return 300 * std::sin(7 * t) * (0.5 + x); });
  const auto at_end = [&](int steps, Order order) {
    Stepping s(d, {}, {1.0 / steps, order, true, {}}, driving, monitor);
    int opened = 0;
    bool open = false;
    for (int i = 0; i < steps; ++i) {
      s.step(driving, monitor);
      const bool now = s.reaction(1).force == 0;
      opened += now != open;
      open = now;
    }
    CHECK(opened >= 3);
    return Eigen::Vector3d(s.deflection(0.5), s.gradient(0.5), s.reaction(0).moment);
  };
  const Eigen::Vector3d exact = at_end(8192, Order::two);
  for (const Order order : {Order::one, Order::two}) {
    const double coarse = (at_end(64, order) - exact).norm(), fine = (at_end(512, order) - exact).norm();
    CAPTURE(coarse);
    CAPTURE(fine);
    // Over a factor 8: 8 and 64 where the branches change at the same place within their steps, which they do not.
    CHECK(coarse / fine > (order == Order::one ? 6 : 36));
  }
}
