#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "../support/laws.hpp"
#include "base/error.hpp"
#include "solver/rows/newton.hpp"

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
      "'lid' is nearly free: translation along x, translation along y, rotation about (0.5, 0.5); without contact held only by spring on "
      "bottom, ";
  CHECK(contains(scene::plan(*scene), "warning: " + expected));
  const auto s = test::solve(scene);
  CHECK(s->result().converged);
  CHECK_MESSAGE(contains(s->result().reason, expected), s->result().reason);
}

TEST_CASE("a motion that nodes too near to each other hold, and rounding loses, is not called solved, whatever the residuals") {
  mesh::Mesh m = test::unit(2, mesh::Family::p1, 16);
  mesh::transform(m, [](const Point& x) { return Point{std::pow(x[0], 5), std::pow(x[1], 2), 0}; });
  const auto b = test::body("lid", std::move(m));
  auto patch = scene::chosen_part(b, "patch", [](const Point& x, const Point& n) { return n[1] < -0.9 && x[0] < 2e-6; });
  scene::fix(patch, {true, true, true});
  test::press(b, "right", 1);
  const auto s = test::solve(scene::make_scene({b}));
  CHECK(!s->result().converged);
  CHECK_MESSAGE(s->result().reason.starts_with("rounding "), s->result().reason);
  CHECK_MESSAGE(contains(s->result().reason, "; 'lid' is nearly free"), s->result().reason);
}

TEST_CASE("springs that hold hardly more than rounding beside the body are rows: what they hold moves as statics says") {
  for (const double k : {1.0, 1e-6, 6e-9, 1e-12, 1e-20}) {
    CAPTURE(k);
    const auto s = test::solve(scene::make_scene({sprung(k)}));  // pressed by 1e-9 a length on springs of k a length
    if (k < 1e-15) {  // it goes so far that its strains are lost
      CHECK(!s->result().converged);
      continue;
    }
    CHECK_MESSAGE(s->result().converged, s->result().reason);
    const std::vector<double> u = s->displacement(0);
    const double down = std::accumulate(u.begin(), u.end(), 0.0, [n = 0](double sum, double v) mutable { return sum + (n++ % 2 ? v : 0); });
    CHECK(down / (static_cast<double>(u.size()) / 2) == doctest::Approx(-1e-9 / k).epsilon(k < 1e-3 ? 1e-6 : 1));
    CHECK(s->energy() == doctest::Approx(-0.5 * 1e-18 / k).epsilon(k < 1e-3 ? 1e-6 : 1));
    CHECK(s->reaction(test::part(s->scene().bodies[0], "bottom"))[1] == doctest::Approx(1e-9).epsilon(1e-9));
  }
}

TEST_CASE("weak springs beside a contact that holds take nothing of it, and a law of the same stiffness says the same") {
  for (const double k : {1e-2, 1e-6, 1e-10, 1e-16})
    for (const bool friction : {false, true}) {
      CAPTURE(k);
      CAPTURE(friction);
      const auto force = [&](bool law) {
        const auto b = test::block("lid", 2, mesh::Family::q1, 4, 0, 1000, 0.3);
        test::press(b, "top", 1);
        if (law) test::support(b, "top", {&laws::elastic, k}, {&laws::elastic, k});
        else test::springs(b, "top", {k, k, 0});
        const auto scene = scene::make_scene({b});
        scene::add_contact(*scene, test::part(b, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false, friction ? test::coulomb(0.3) : scene::GivenLaw{});
        Monitor quiet;
        const auto s = scene::solve(scene, solver::Newton{}, {}, quiet);
        CHECK_MESSAGE(s->result().converged, s->result().reason);
        return s->contact(*scene->contacts[0]).force[1];
      };
      CHECK(force(false) == doctest::Approx(1).epsilon(k < 1e-3 ? 1e-6 : 1e-4));
      CHECK(force(false) == doctest::Approx(force(true)).epsilon(1e-5));
    }
}

TEST_CASE("a patch that holds too little is named with its nodes") {
  mesh::Mesh m = test::unit(2, mesh::Family::p1, 16);
  mesh::transform(m, [](const Point& x) { return Point{std::pow(x[0], 4), std::pow(x[1], 2), 0}; });
  const auto b = test::body("lid", std::move(m));
  auto patch = scene::chosen_part(b, "patch", [](const Point& x, const Point& n) { return n[1] < -0.9 && x[0] < 2e-5; });
  scene::fix(patch, {true, true, true});
  test::press(b, "right", 1);
  CHECK(contains(scene::plan(*scene::make_scene({b})),
                 "'lid' is nearly free: rotation about (0, 0); without contact held only by fix of patch (2 nodes), "));
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
