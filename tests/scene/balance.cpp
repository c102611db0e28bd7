#include <doctest/doctest.h>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

void check_balance(const scene::Solution& s, const std::vector<scene::Part>& supports, Point others, double scale) {
  const int dim = s.scene().dimension();
  for (const auto& b : s.scene().bodies) {
    const Point load = test::resultant(*b);
    for (int i = 0; i < dim; ++i) others[i] += load[i];
  }
  for (const auto& part : supports) {
    const Point r = s.reaction(part);
    for (int i = 0; i < dim; ++i) others[i] += r[i];
  }
  for (int i = 0; i < dim; ++i) CHECK(std::abs(others[i]) < 1e-11 * scale);
}

}  // namespace

TEST_CASE("reactions of fixed, displaced, sliding and sprung parts and contact balance the loads") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto block = test::block("block", dim, family, 4);
      auto left = test::part(block, "left"), top = test::part(block, "top"), right = test::part(block, "right");
      scene::fix(left, {true, false, false});
      std::array<elasticity::ScalarField, 3> tilt;
      tilt[dim - 1] = [](const Point& x) { return 0.01 * x[0]; };
      scene::displace(top, tilt);
      scene::spring(right, {[](const Point& x) { return 5 + x[1]; }, nullptr, [](const Point&) { return 2.0; }});
      test::pull(block, "right", [](const Point& x) { return Point{1 + x[1], -2, 0.5}; });
      std::vector<scene::Part> supports{left, top, right};
      if (dim == 3) {
        auto back = test::part(block, "back");
        scene::slide(back);
        supports.push_back(back);
      }
      const auto scene = scene::make_scene({block});
      Point normal{0, 0, 0};
      normal[dim - 1] = 1;
      Point below{0, 0, 0};
      below[dim - 1] = -0.001;
      const auto contact =
          scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{below, normal}, {}, false);
      const auto s = test::solve(scene);
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      check_balance(*s, supports, s->contact(*contact).force, 10);
    }
}

TEST_CASE("a slide along no axis carries its share, and its reaction is along its normal") {
  for (const auto family : test::kFamilies) {
    auto m = test::rectangle(family, 4, 4);
    mesh::transform(m, [](const Point& x) { return Point{x[0] + 0.5 * x[1], x[1], 0}; });  // left and right lean
    const auto block = test::body("wedge", std::move(m));
    auto left = test::part(block, "left"), bottom = test::part(block, "bottom");
    scene::slide(left);
    scene::slide(bottom);
    test::press(block, "right", 2);
    test::press(block, "top", 1);
    const auto s = test::solve(scene::make_scene({block}));
    REQUIRE_MESSAGE(s->result().converged, s->result().reason);
    check_balance(*s, {left, bottom}, {0, 0, 0}, 3);
    const Point r = s->reaction(left);
    CHECK(r[0] * 0.5 + r[1] * 1 == doctest::Approx(0).epsilon(1e-11));  // none along the side (½, 1)
    CHECK(std::abs(s->reaction(bottom)[0]) < 1e-12);
  }
}

TEST_CASE("a contact node that is also fixed in the normal direction breaks nothing") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const bool reduced : {true, false}) {
        const auto block = test::block("block", dim, family, 4);
        auto left = test::part(block, "left");
        scene::fix(left, {true, true, true});  // its lowest nodes are on the contact part too
        test::press(block, "top", 4);
        const auto scene = scene::make_scene({block});
        Point normal{0, 0, 0};
        normal[dim - 1] = 1;
        const auto contact =
            scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, normal}, {}, false);
        const auto s = test::solve(scene, reduced);
        REQUIRE_MESSAGE(s->result().converged, s->result().reason);
        check_balance(*s, {left}, s->contact(*contact).force, 4);
        CHECK(s->contact(*contact).nodes.size() == (dim == 2 ? 5u : 25u));
      }
}

TEST_CASE("a fixed contact node that lies inside the other side is refused: no displacement parts them") {
  const auto block = test::block("block", 2, mesh::Family::p1, 2);
  test::fix(block, "left");
  const auto scene = scene::make_scene({block});
  scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0.1, 0}, {0, 1, 0}}, {}, true);
  CHECK_THROWS_WITH_AS(test::solve(scene), doctest::Contains("is fixed in the normal direction and lies 0.1 inside"),
                       InputError);
}

TEST_CASE("action equals reaction between bodies under an uneven load") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto low = test::block("low", dim, family, 4), high = test::block("high", dim, family, 4, 1);
      auto bottom = test::part(low, "bottom"), top = test::part(high, "top");
      scene::fix(bottom, {true, true, true});
      std::array<elasticity::ScalarField, 3> down;
      for (int i = 0; i < dim; ++i) down[i] = [=](const Point& x) { return i == dim - 1 ? 0.02 - 0.06 * x[0] : 0.0; };
      scene::displace(top, down);
      const auto scene = scene::make_scene({low, high});
      const auto contact = scene::add_contact(*scene, test::part(low, "top"), test::part(high, "bottom"), {});
      const auto s = test::solve(scene);
      REQUIRE(s->result().converged);
      const auto c = s->contact(*contact);
      CHECK(c.open > 0);
      CHECK(c.closed > 0);
      const Point under = s->reaction(bottom), above = s->reaction(top);
      for (int i = 0; i < dim; ++i) {
        CHECK(std::abs(under[i] + c.force[i]) < 1e-12 * std::abs(c.force[dim - 1]));
        CHECK(std::abs(above[i] - c.force[i]) < 1e-12 * std::abs(c.force[dim - 1]));
      }
    }
}
