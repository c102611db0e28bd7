#include <doctest/doctest.h>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

struct Notch {
  std::shared_ptr<scene::Body> block, frame;
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
};

/// A block in the corner of an L, in contact along both legs. The whole surface of the frame is fixed where `held`,
/// else its outer sides.
Notch notch(mesh::Family family, bool held) {
  Notch s;
  auto frame = test::without(test::rectangle(family, 8, 8), [](const Point& x) { return x[0] > 0.5 && x[1] > 0.5; });
  s.frame = test::body("frame", std::move(frame), 1000);
  s.block = test::body("block", test::rectangle(family, 4, 4, 0.5, 0.5, 1, 1));
  auto outer = scene::chosen_part(s.frame, "outer",
                                  [=](const Point& x, const Point&) { return held || x[0] == 0 || x[1] == 0; });
  scene::fix(outer, {true, true, true});
  s.scene = scene::make_scene({s.block, s.frame});
  const auto first =
      scene::chosen_part(s.block, "corner", [](const Point& x, const Point&) { return x[0] == 0.5 || x[1] == 0.5; });
  const auto second = scene::chosen_part(s.frame, "legs", [](const Point& x, const Point&) {
    return (x[0] == 0.5 && x[1] > 0.5) || (x[1] == 0.5 && x[0] > 0.5);
  });
  s.contact = scene::add_contact(*s.scene, first, second, {});
  return s;
}

}  // namespace

TEST_CASE("a block in a rigid corner: each leg has its own exact pressure, the corner both") {
  for (const auto family : test::kFamilies)
    for (const bool reduced : {true, false}) {
      auto s = notch(family, true);
      test::press(s.block, "right", 2);
      test::press(s.block, "top", 5);
      const auto solution = test::solve(s.scene, reduced);
      REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
      const auto c = solution->contact(*s.contact);
      CHECK(c.nodes.size() == 10);
      CHECK(c.open == 0);
      int at_corner = 0;
      for (const auto& node : c.nodes) {
        const bool leg = std::abs(node.normal[0]) > 0.5;  // pressed by the right side's load
        CHECK(node.pressure == doctest::Approx(leg ? 2 : 5).epsilon(1e-11));
        at_corner += node.x == Point{0.5, 0.5, 0};
      }
      CHECK(at_corner == 2);
      CHECK(c.force[0] == doctest::Approx(1).epsilon(1e-11));
      CHECK(c.force[1] == doctest::Approx(2.5).epsilon(1e-11));
    }
}

TEST_CASE("a block in an elastic corner: forces balance, no penetration on either leg") {
  for (const auto family : test::kFamilies) {
    auto s = notch(family, false);
    test::press(s.block, "right", 2);
    test::press(s.block, "top", 5);
    const auto solution = test::solve(s.scene);
    REQUIRE(solution->result().converged);
    const auto c = solution->contact(*s.contact);
    CHECK(c.force[0] == doctest::Approx(1).epsilon(1e-11));
    CHECK(c.force[1] == doctest::Approx(2.5).epsilon(1e-11));
    for (const auto& node : c.nodes) {
      CHECK(node.gap > -1e-12);
      CHECK(node.force >= 0);
      CHECK(std::abs(node.force * node.gap) < 1e-12);
    }
    auto outer =
        scene::chosen_part(s.frame, "outer", [](const Point& x, const Point&) { return x[0] == 0 || x[1] == 0; });
    const auto support = solution->reaction(outer);
    CHECK(support[0] == doctest::Approx(1).epsilon(1e-10));
    CHECK(support[1] == doctest::Approx(2.5).epsilon(1e-10));
  }
}
