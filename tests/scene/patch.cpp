#include <doctest/doctest.h>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;
using test::block;
using test::kPressure;

namespace {

// 1e-11 of the pressure: rounding of some thousand unknowns of condition 1e4.
constexpr double kExactPressure = 1e-11 * kPressure;

struct PatchStack {
  std::shared_ptr<scene::Body> low, high;
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
};

/// Two blocks of different stiffness on top of each other; `low`'s top is in contact with `high`'s bottom.
PatchStack stack(int dim, mesh::Family family, int n) {
  PatchStack s;
  s.low = block("low", dim, family, n, 0, 210, 0.3);
  s.high = block("high", dim, family, n, 1, 70, 0.2);
  s.scene = scene::make_scene({s.low, s.high});
  s.contact = scene::add_contact(*s.scene, test::part(s.low, "top"), test::part(s.high, "bottom"), {});
  return s;
}

/// Every contact node carries exactly p; every nodal stress is −p along the last axis and nothing else.
void check_uniform(const PatchStack& s, const scene::Solution& solution, double p) {
  const int dim = s.low->dimension();
  const auto c = solution.contact(*s.contact);
  CHECK(c.open == 0);
  for (const auto& node : c.nodes) {
    CHECK(std::abs(node.pressure - p) < kExactPressure);
    CHECK(std::abs(node.gap) < 1e-13);
  }
  CHECK(c.force[dim - 1] == doctest::Approx(-p).epsilon(1e-11));
  for (int b : {0, 1})
    for (const auto& stress : solution.stress(b)) {
      const double nu = b == 0 ? 0.3 : 0.2;
      for (int v = 0; v < 6; ++v) {
        const double exact = v == dim - 1 ? -p : (dim == 2 && v == 2 ? -nu * p : 0);
        CHECK(std::abs(stress[v] - exact) < 10 * kExactPressure);  // differences of displacements lose a digit
      }
    }
}

}  // namespace

TEST_CASE("two blocks pressed together: uniform pressure is exact, for every element") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies)
      for (const bool reduced : {true, false}) {
        auto s = stack(dim, family, dim == 2 ? 6 : 3);
        for (const auto& b : {s.low, s.high}) test::symmetric(b);
        test::slide(s.low, "bottom");
        test::press(s.high, "top", kPressure);
        const auto solution = test::solve(s.scene, reduced);
        REQUIRE(solution->result().converged);
        check_uniform(s, *solution, kPressure);
        // Action is reaction: what the floor gives, the contact passes on and the pressure presses.
        const auto floor = solution->reaction(test::part(s.low, "bottom"));
        CHECK(std::abs(floor[dim - 1] - kPressure) < 1e-12 * kPressure);
        CHECK(std::abs(floor[dim - 1] + solution->contact(*s.contact).force[dim - 1]) < 1e-12 * kPressure);
      }
}

TEST_CASE("the same on springs: the whole stack sinks by p/k") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      auto s = stack(dim, family, 3);
      for (const auto& b : {s.low, s.high}) test::symmetric(b);
      Point k{0, 0, 0};
      k[dim - 1] = 50;
      test::springs(s.low, "bottom", k);
      test::press(s.high, "top", kPressure);
      const auto solution = test::solve(s.scene);
      REQUIRE(solution->result().converged);
      check_uniform(s, *solution, kPressure);
      CHECK(solution->displacement(0)[dim - 1] == doctest::Approx(-kPressure / 50).epsilon(1e-11));
      CHECK(solution->reaction(test::part(s.low, "bottom"))[dim - 1] == doctest::Approx(kPressure).epsilon(1e-11));
    }
}

TEST_CASE("the same by a prescribed displacement of the top") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      auto s = stack(dim, family, 3);
      for (const auto& b : {s.low, s.high}) test::symmetric(b);
      test::slide(s.low, "bottom");
      // Compliance of a unit block under stress along the last axis: (1 − ν²)/E in plane strain, 1/E solid.
      const double compliance = dim == 2 ? (1 - 0.09) / 210 + (1 - 0.04) / 70 : 1.0 / 210 + 1.0 / 70;
      std::array<elasticity::ScalarField, 3> down;
      down[dim - 1] = [&](const Point&) { return -kPressure * compliance; };
      auto top = test::part(s.high, "top");
      scene::displace(top, down);
      const auto solution = test::solve(s.scene);
      REQUIRE(solution->result().converged);
      check_uniform(s, *solution, kPressure);
      CHECK(solution->reaction(top)[dim - 1] == doctest::Approx(-kPressure).epsilon(1e-11));
    }
}

TEST_CASE("the same turned by 30 degrees: slides along no axis are rows, bodies are free but for them") {
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies)
      for (const bool reduced : {true, false}) {
        Point up{0, 0, 0};
        std::vector<std::shared_ptr<scene::Body>> bodies;
        for (int b : {0, 1}) {
          mesh::Mesh m = test::unit(dim, family, 3);
          mesh::transform(m, [&](Point x) {
            x[dim - 1] += b;
            const double along = x[0], high = x[dim - 1];
            x[0] = c * along - s * high;
            x[dim - 1] = s * along + c * high;
            return x;
          });
          bodies.push_back(test::body(b ? "high" : "low", std::move(m)));
          test::symmetric(bodies.back());
        }
        up[0] = -s, up[dim - 1] = c;
        test::slide(bodies[0], "bottom");
        test::press(bodies[1], "top", kPressure);
        const auto scene = scene::make_scene(bodies);
        const auto contact =
            scene::add_contact(*scene, test::part(bodies[0], "top"), test::part(bodies[1], "bottom"), {});
        const auto solution = test::solve(scene, reduced);
        REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
        const auto result = solution->contact(*contact);
        CHECK(result.open == 0);
        for (const auto& node : result.nodes) CHECK(std::abs(node.pressure - kPressure) < 10 * kExactPressure);
        const auto floor = solution->reaction(test::part(bodies[0], "bottom"));
        for (int i = 0; i < dim; ++i) {
          CHECK(std::abs(result.force[i] + kPressure * up[i]) < kExactPressure);
          CHECK(std::abs(floor[i] - kPressure * up[i]) < kExactPressure);
        }
        // σ = −p up⊗up.
        for (int b : {0, 1})
          for (const auto& stress : solution->stress(b)) {
            CHECK(std::abs(stress[0] + kPressure * up[0] * up[0]) < 100 * kExactPressure);
            CHECK(std::abs(stress[dim == 2 ? 5 : 4] + kPressure * up[0] * up[dim - 1]) < 100 * kExactPressure);
          }
      }
}

TEST_CASE("a gap that closes: the stack compresses from where it touches") {
  for (const auto family : test::kAllFamilies) {
    auto low = block("low", 2, family, 4), high = block("high", 2, family, 4, 1.001);
    for (const auto& b : {low, high}) test::symmetric(b);
    test::slide(low, "bottom");
    auto top = test::part(high, "top");
    scene::displace(top, {nullptr, [](const Point&) { return -0.003; }, nullptr});
    const auto scene = scene::make_scene({low, high});
    const auto contact = scene::add_contact(*scene, test::part(low, "top"), test::part(high, "bottom"), {});
    const auto solution = test::solve(scene);
    REQUIRE(solution->result().converged);
    const double p = 0.002 / (2 * (1 - 0.09) / 210);  // what is left after the gap of 0.001
    for (const auto& node : solution->contact(*contact).nodes)
      CHECK(node.pressure == doctest::Approx(p).epsilon(1e-10));
    // Less than the gap: nothing touches.
    auto free = block("high", 2, family, 4, 1.001);
    test::symmetric(free);
    auto free_top = test::part(free, "top");
    scene::displace(free_top, {nullptr, [](const Point&) { return -0.0005; }, nullptr});
    const auto apart = scene::make_scene({low, free});
    const auto open = scene::add_contact(*apart, test::part(low, "top"), test::part(free, "bottom"), {});
    const auto result = test::solve(apart)->contact(*open);
    CHECK(result.closed == 0);
    for (const auto& node : result.nodes) CHECK(node.gap == doctest::Approx(0.0005).epsilon(1e-10));
  }
}

TEST_CASE("stiff units: pascals and metres, and micro-units, give the same pressures by both methods") {
  for (const double E : {2.1e11, 2.1e-4})
    for (const bool reduced : {true, false}) {
      auto low = block("low", 2, mesh::Family::p1, 4, 0, E), high = block("high", 2, mesh::Family::p1, 4, 1, E);
      for (const auto& b : {low, high}) test::symmetric(b);
      test::slide(low, "bottom");
      test::press(high, "top", 1e-3 * E);
      const auto scene = scene::make_scene({low, high});
      const auto contact = scene::add_contact(*scene, test::part(low, "top"), test::part(high, "bottom"), {});
      const auto solution = test::solve(scene, reduced);
      REQUIRE(solution->result().converged);
      for (const auto& node : solution->contact(*contact).nodes)
        CHECK(node.pressure == doctest::Approx(1e-3 * E).epsilon(1e-10));
    }
}
