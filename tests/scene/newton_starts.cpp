#include <doctest/doctest.h>

#include <cmath>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;
using test::friction;

// Newton's method from random multipliers, far from the solution: where the derivative is singular, and
// whether it converges all the same.

namespace {

namespace laws = dotyk::problem::laws;

/// A block on another, 2 × 1 each, pressed and pulled sideways; lengths and stresses in units of the caller's.
std::shared_ptr<scene::Scene> blocks(const scene::GivenLaw& law, bool held, double length = 1, double stress = 1) {
  const auto half = [&](const char* name, double y) {
    return test::body(name, test::rectangle(test::Family::p1, 8, 4, 0, y * length, 2 * length, (y + 1) * length),
                      1000 * stress);
  };
  const auto lower = half("lower", 0), upper = half("upper", 1);
  test::fix(lower, "bottom");
  test::pull(upper, "top", [=](const Point&) { return Point{2 * stress, -10 * stress, 0}; });
  if (held) test::springs(upper, "top", {10 * stress / length, 10 * stress / length, 0});
  auto scene = scene::make_scene({lower, upper});
  scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"), {}, law);
  return scene;
}

/// A cube pressed against a paraboloid by prescribed interference.
std::shared_ptr<scene::Scene> cube(const scene::GivenLaw& law) {
  const auto body = test::body("cube", test::box(test::Family::p1, 4, 4, 4), 1000);
  test::fix(body, "bottom");
  auto scene = scene::make_scene({body});
  const auto gap = [](const Point& x) {
    return ((x[0] - .5) * (x[0] - .5) + (x[1] - .5) * (x[1] - .5)) / 2 + 0.2 * x[0] - 0.15;
  };
  scene::add_contact(*scene, test::part(body, "top"), contact::RigidGap{{0, 0, 1}, gap}, {}, false, law);
  return scene;
}

std::shared_ptr<scene::Solution> solve(const std::shared_ptr<scene::Scene>& s, std::optional<unsigned> seed,
                                       bool watch = true) {
  Monitor quiet;
  solver::Newton newton;
  newton.seed = seed;
  newton.watch = watch;
  return scene::solve(s, newton, {}, quiet);
}

}  // namespace

TEST_CASE("Newton's method converges from random starts to the solution found from rest") {
  for (const auto& scene : {blocks(friction(&laws::friction, 2.5), false), blocks(friction(&laws::coulomb, 0.3), false),
                            blocks(friction(&laws::friction, 2.5), true), blocks(friction(&laws::coulomb, 3), true),
                            cube(friction(&laws::friction, 10)), cube(friction(&laws::coulomb, 0.3))}) {
    const auto rest = solve(scene, std::nullopt);
    REQUIRE(rest->result().converged);
    CHECK(rest->result().iterations <= 12);
    for (unsigned seed = 1; seed <= 60; ++seed) {
      const auto s = solve(scene, seed);
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      CHECK((s->result().state.lambda - rest->result().state.lambda).norm() < 1e-8 * rest->result().state.lambda.norm());
    }
  }
}

TEST_CASE("the derivative is singular exactly where given friction leaves a free body a rigid motion") {
  int singular = 0, steps = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const auto s = solve(blocks(friction(&laws::friction, 2.5), false), seed);
    const auto& history = s->result().history;
    for (std::size_t k = 1; k < history.size(); ++k) {
      // The derivative is that of the iterate before. All rows lie on one line: two closed ones hold the height
      // and the turn, one that sticks holds the rest.
      const bool moves = history[k - 1].active < 2 || history[k - 1].stick < 1;
      CHECK((history[k].singular_value < 1e-12) == moves);
      singular += moves;
      ++steps;
    }
  }
  CHECK(singular > 50);
  CHECK(singular < steps - 50);
}

TEST_CASE("the singular value has no unit") {
  for (const problem::LawSpec* kind : {&laws::friction, &laws::coulomb})
    for (unsigned seed = 1; seed <= 10; ++seed)
      for (const bool held : {false, true}) {
        const double g = kind == &laws::friction ? 2.5 : 0.3;
        const auto one = solve(blocks(friction(kind, g), held), seed);
        const double length = 1e3, stress = 1e-5;
        const auto other =
            solve(blocks(friction(kind, kind == &laws::friction ? g * stress : g), held, length, stress), seed);
        REQUIRE(one->result().history.size() == other->result().history.size());
        for (std::size_t k = 0; k < one->result().history.size(); ++k)
          CHECK(std::abs(one->result().history[k].singular_value - other->result().history[k].singular_value) <
                1e-7 * (1e-6 + one->result().history[k].singular_value));
      }
}

TEST_CASE("unwatched, the singular value is estimated to within the root of the number of rows") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto scene = blocks(friction(&laws::coulomb, 0.3), true);
    const auto exact = solve(scene, seed), estimated = solve(scene, seed, false);
    const double root = std::sqrt(exact->rows());
    REQUIRE(exact->result().history.size() == estimated->result().history.size());
    for (std::size_t k = 0; k < exact->result().history.size(); ++k) {
      const double ratio = estimated->result().history[k].singular_value / exact->result().history[k].singular_value;
      CHECK(ratio > 1 / root);
      CHECK(ratio < 3 * root);  // the estimate of ‖G⁻¹‖₁ is itself rarely out by a factor of three
    }
  }
}
