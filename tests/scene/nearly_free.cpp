#include <doctest/doctest.h>

#include "../support/scenes.hpp"
#include "base/error.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

std::shared_ptr<scene::Body> sprung(double k) {
  const auto b = test::block("lid", 2, mesh::Family::q1, 6, 0, 1, 0.3);
  test::springs(b, "bottom", {k, k, 0});
  test::press(b, "top", 1e-9);
  return b;
}

bool contains(const std::string& whole, const std::string& part) { return whole.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("plan and solution name a body that is nearly free, the motion, and what little holds it") {
  const auto scene = scene::make_scene({sprung(1e-6)});
  const std::string expected =
      "'lid' is nearly free: translation along x, translation along y, rotation about (0.5, 0.5); held only by spring on "
      "bottom, ";
  CHECK(contains(scene::plan(*scene), "warning: " + expected));
  const auto s = test::solve(scene);
  CHECK(s->result().converged);
  CHECK_MESSAGE(contains(s->result().reason, expected), s->result().reason);
}

TEST_CASE("a motion that is lost in rounding is not called solved, whatever the residuals") {
  const auto s = test::solve(scene::make_scene({sprung(6e-9)}));
  CHECK(!s->result().converged);
  CHECK_MESSAGE(contains(s->result().reason, "of a motion that supports hardly hold; "), s->result().reason);
  CHECK_MESSAGE(contains(s->result().reason, "; 'lid' is nearly free"), s->result().reason);
}

TEST_CASE("a patch that holds too little is named with its nodes") {
  mesh::Mesh m = test::unit(2, mesh::Family::p1, 16);
  mesh::transform(m, [](const Point& x) { return Point{std::pow(x[0], 4), std::pow(x[1], 2), 0}; });
  const auto b = test::body("lid", std::move(m));
  auto patch = scene::chosen_part(b, "patch", [](const Point& x, const Point& n) { return n[1] < -0.9 && x[0] < 2e-5; });
  scene::fix(patch, {true, true, true});
  test::press(b, "right", 1);
  CHECK(contains(scene::plan(*scene::make_scene({b})),
                 "'lid' is nearly free: rotation about (0, 0); held only by fix of patch (2 nodes), "));
}

TEST_CASE("springs lost in rounding are refused, by plan and solver; without them the body is free, exactly") {
  const auto scene = scene::make_scene({sprung(1e-20)});
  CHECK(contains(scene::plan(*scene), "no solution: 'lid' is as good as free: translation along x"));
  CHECK_THROWS_WITH_AS(test::solve(scene), doctest::Contains("held only by spring on bottom, whose stiffness is lost in rounding"),
                       InputError);
  const auto free = test::block("lid", 2, mesh::Family::q1, 6, 0, 1, 0.3);
  test::press(free, "top", 1);
  const auto on_floor = scene::make_scene({free});
  scene::add_contact(*on_floor, test::part(free, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  CHECK(test::solve(on_floor)->result().converged);
}

TEST_CASE("ordinary supports give no warning") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto held = test::block("held", dim, family, 4);
      test::fix(held, "left");
      test::press(held, "top", 1);
      const auto scene = scene::make_scene({held});
      CHECK(!contains(scene::plan(*scene), "nearly free"));
      CHECK(!contains(test::solve(scene)->result().reason, "nearly free"));
    }
}
