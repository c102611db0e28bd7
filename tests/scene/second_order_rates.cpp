// Contact of order 2 beside a closed form: rates of convergence, inf-sup constants.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "../support/stacks.hpp"
#include "scene/study/inf_sup.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;
using std::numbers::pi;
using test::quiet;

namespace {

/// A sinusoidal surface on an elastic half-space in the plane (Westergaard 1939; Johnson 1985, 13.2), wavelength 1, half of it:
/// gap δ(1 − cos 2πx), contact |x| < a under the mean pressure (πE*δ) sin² πa, and
///   p = 2 p̄ cos πx √(sin² πa − sin² πx)/sin² πa.
/// The block is 1.5 deep: of the half-space e^{-6π} is missing.
struct Wave {
  static constexpr double E = 210, nu = 0.3, delta = 0.01, a = 0.2;
  static double mean() { return pi * E / (1 - nu * nu) * delta * std::pow(std::sin(pi * a), 2); }
  static double pressure(double x) {
    const double s = std::pow(std::sin(pi * a), 2), rest = s - std::pow(std::sin(pi * x), 2);
    return rest > 0 ? 2 * mean() / s * std::cos(pi * x) * std::sqrt(rest) : 0;
  }
  double l2 = 0, peak = 0, energy = 0;  ///< relative error of pressures over contact; of the greatest one; energy

  Wave(Family family, int n) {
    const auto block = test::body("block", test::rectangle(family, n, 3 * n, 0, -1.5, 0.5, 0), E, nu);
    test::slide(block, "left");
    test::slide(block, "right");
    test::press(block, "bottom", mean());
    const auto scene = scene::make_scene({block});
    const auto contact = scene::add_contact(*scene, test::part(block, "top"), contact::RigidGap{{0, 1, 0}, [](const Point& x) { return delta * (1 - std::cos(2 * pi * x[0])); }}, {}, false);
    const auto s = test::solve(scene);
    REQUIRE_MESSAGE(s->result().converged, s->result().reason);
    double square = 0, whole = 0;
    for (const auto& node : s->contact(*contact).nodes) {
      const double p = pressure(node.x[0]);
      square += node.weight * (node.pressure - p) * (node.pressure - p), whole += node.weight * p * p;
      if (node.x[0] == 0) peak = std::abs(node.pressure / p - 1);
    }
    l2 = std::sqrt(square / whole);
    energy = s->energy();
  }
};

}  // namespace

TEST_CASE("a wavy surface on a rigid plane: pressures tend to Westergaard's, energies of order 2 faster than of order 1") {
  const double limit = Wave(Family::q2, 64).energy;  // its own error: a twentieth of those below
  for (const Family family : test::kAllFamilies) {
    // How far the edge of contact is from a node is another thing on every mesh: the slope of the least-squares line through many.
    double sx = 0, sy = 0, sxx = 0, sxy = 0, count = 0;
    for (int n : {8, 9, 10, 11, 12, 13, 14, 16, 18, 20, 22, 24}) {
      const double x = std::log2(n), y = -std::log2(std::abs(Wave(family, n).energy - limit));
      sx += x, sy += y, sxx += x * x, sxy += x * y, count += 1;
    }
    const double energy_order = (count * sxy - sx * sy) / (count * sxx - sx * sx);
    const Wave coarse(family, 8), fine(family, 32);
    CAPTURE(test::name(family));
    CAPTURE(energy_order);
    CAPTURE(coarse.l2);
    CAPTURE(fine.l2);
    CAPTURE(coarse.peak);
    CAPTURE(fine.peak);
    CHECK(fine.l2 < coarse.l2 / 1.7);  // in L2 the root at the edge leaves h; where it lies between nodes makes that jump about
    CHECK(fine.l2 < 0.02);
    if (test::quadratic(family)) CHECK(fine.peak < coarse.peak / 4);
    // u is of H^{5/2 − ε} at the contact's edge: h² of order 1, h³ of order 2.
    CHECK(energy_order > (test::quadratic(family) ? 2.7 : 1.7));
  }
}

TEST_CASE("inf-sup constants of order 2 with the corners' hats stay away from 0 on refinement") {
  for (const Family family : test::kSecondOrder)
    for (int dim : {2, 3}) {
      std::vector<double> constants;
      for (int n : {2, 4, 8}) {
        if (dim == 3 && n > 4) continue;
        test::Stack s = test::stack(dim, family, family, n, n);
        test::fix(s.low, "bottom");
        test::touch(s, true, test::given(1));
        constants.push_back(scene::inf_sup(*s.contact, {scene::MultiplierPart::both, true}, quiet).constant);
      }
      CAPTURE(test::name(family));
      CAPTURE(dim);
      CAPTURE(constants[0]);
      CAPTURE(constants[1]);
      CAPTURE(constants.back());
      CHECK(constants.back() > 0.5);
      CHECK(constants.back() == doctest::Approx(constants[constants.size() - 2]).epsilon(0.05));
    }
}
