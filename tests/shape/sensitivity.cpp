// Derivatives of contact solutions by the places of nodes, without friction, against central differences of scenes solved
// again over steps from 1e-1 to 1e-10. At the bottom truncation, h², meets rounding, about 1e-14/h of the solution: 1e-8 is
// asked for, 1e-9 to 1e-11 are reached (test_shape --success prints each).
#include "shape/derivative/sensitivity.hpp"

#include "base/error.hpp"
#include "differences.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;

namespace {

/// A rectangle or box with a curved bottom that touches height 0 in the middle of its left (front) edge.
std::shared_ptr<scene::Body> roller(const std::string& name, int dimension, Family family, int n, double curvature = 0.15) {
  mesh::Mesh m = dimension == 2 ? test::rectangle(family, n, n / 2, 0, 0, 1, 0.5)
                                : test::box(family, n, n, n / 2, {0, 0, 0}, {1, 1, 0.5});
  mesh::transform(m, [&](Point x) {
    const double height = dimension == 2 ? x[1] : x[2], r2 = x[0] * x[0] + (dimension == 2 ? 0 : 0.5 * x[1] * x[1]);
    return x[dimension - 1] += curvature * r2 * (1 - 2 * height), x;
  });
  return test::body(name, std::move(m), 1000);
}

void check(const test::ScenePtr& scene, const test::Motion& motion, double bottom = 1e-8) {
  const auto V = test::velocities(*scene, motion);
  const auto condenser = std::make_shared<problem::Condenser>();
  const auto s = test::sensitivity(test::solved(scene, condenser), condenser);
  REQUIRE(s.smooth());
  const shape::Derivative d = s.along(V);
  test::check_bottom(test::central_errors(*scene, V, d), bottom);
  test::check_adjoint(s, V);
  // A factor of its own gives the same.
  const shape::Derivative again = test::sensitivity(test::solved(scene)).along(V);
  CHECK((again.u - d.u).norm() < 1e-9 * d.u.norm());
}

}  // namespace

TEST_CASE("a roller pressed onto a rigid plane, held down by contact alone") {
  for (const auto family : test::kFamilies) {
    const auto body = roller("roller", 2, family, 12);
    test::fix(body, "left", {true, false, false});
    test::press(body, "top", 3);
    const auto scene = scene::make_scene({body});
    scene::add_contact(*scene, test::part(body, "bottom"), contact::RigidPlane{{0, -0.001, 0}, {0, 1, 0}}, {}, true);
    check(scene, test::random_motion(0.01));
  }
}

TEST_CASE("a block pressed onto a rigid ball, in the plane and in space") {
  for (const int dimension : {2, 3})
    for (const auto family : test::kFamilies) {
      CAPTURE(dimension);
      const auto body = test::block("block", dimension, family, dimension == 2 ? 10 : 4, 0, 1000);
      test::fix(body, "top");
      Point centre{0.45, 0.55, -1};
      if (dimension == 2) centre = {0.45, -1, 0};
      const auto scene = scene::make_scene({body});
      scene::add_contact(*scene, test::part(body, "bottom"), contact::RigidBall{centre, 1.05}, {}, true);
      check(scene, test::random_motion(0.02));
    }
}

TEST_CASE("two bodies whose nodes match, both moving") {
  for (const int dimension : {2, 3})
    for (const auto family : test::kFamilies) {
      CAPTURE(dimension);
      const int n = dimension == 2 ? 8 : 4;
      const auto lower = test::block("lower", dimension, family, n, 0, 1000), upper = test::block("upper", dimension, family, n, 1, 600);
      test::fix(lower, "bottom");
      test::fix(upper, "left", {true, dimension == 3, false});
      test::pull(upper, "top", [=](const Point& x) {
        Point t{0, 0, 0};
        t[dimension - 1] = -6 - 2 * x[0];
        return t;
      });
      const auto scene = scene::make_scene({lower, upper});
      scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"),
                         [](const Point& x) { return 0.05 * (1 - x[0]) * (1 - x[0]); }, {}, true);
      const auto s = test::solved(scene);
      const auto c = s->contact(*scene->contacts.front());
      CHECK(c.open > 0);
      CHECK(c.closed > 0);
      check(scene, test::waves(0.02));
    }
}

TEST_CASE("a stack of free bodies that contact alone holds") {
  for (const auto family : test::kFamilies) {
    // On a floor and against a wall: three rigid motions each, all noticed.
    const auto lower = test::block("lower", 2, family, 6, 0, 1000), upper = test::block("upper", 2, family, 6, 1, 600);
    for (const auto& body : {lower, upper}) test::pull(body, "right", [](const Point& x) { return Point{-2 - x[1], 0, 0}; });
    test::pull(upper, "top", [](const Point& x) { return Point{0, -4 - x[0], 0}; });
    const auto scene = scene::make_scene({lower, upper});
    scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"), {}, {}, true);
    scene::add_contact(*scene, test::part(lower, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, true);
    for (const auto& body : {lower, upper})
      scene::add_contact(*scene, test::part(body, "left"), contact::RigidPlane{{0, 0, 0}, {1, 0, 0}}, {}, true);
    const auto s = test::solved(scene);
    CHECK(s->model().problem.blocks[0].kernel.cols() == 3);
    check(scene, test::random_motion(0.01));
  }
}

TEST_CASE("springs that move, one-sided supports and given displacements that rest") {
  const auto body = roller("roller", 2, Family::q1, 12);
  test::springs(body, "left", {300, 20, 0});
  test::press(body, "top", 3);
  auto right = test::part(body, "right");
  scene::support(right, problem::LawChoice{&problem::laws::one_sided_elastic, 500}, {});
  const auto scene = scene::make_scene({body});
  scene::add_contact(*scene, test::part(body, "bottom"), contact::RigidPlane{{0, -0.001, 0}, {0, 1, 0}}, {}, true);
  const auto support = test::solved(scene)->support(right);
  CHECK(support.open + support.closed > 0);
  check(scene, [random = test::random_motion(0.01)](int b, const Point& x) { return x[0] > 0.95 ? Point{0, 0, 0} : random(b, x); });

  const auto displaced = test::block("block", 2, Family::p1, 8, 0, 1000);
  test::fix(displaced, "bottom");
  auto top = test::part(displaced, "top");
  scene::displace(top, {elasticity::ScalarField(), [](const Point& x) { return -0.02 - 0.01 * x[0]; }, elasticity::ScalarField()});
  const auto second = scene::make_scene({displaced});
  scene::add_contact(*second, test::part(displaced, "right"), contact::RigidPlane{{1.004, 0, 0}, {-1, 0, 0}}, {}, true);
  check(second, test::random_motion(0.01));
}

TEST_CASE("a body without contact: P7 (6)") {
  const auto body = test::block("block", 2, Family::q1, 6, 0, 1000);
  test::fix(body, "bottom");
  test::press(body, "right", 4);
  const auto scene = scene::make_scene({body});
  const auto V = test::velocities(*scene, test::random_motion(0.02));
  const auto s = test::sensitivity(test::solved(scene));
  CHECK(s.smooth());
  const shape::Derivative d = s.along(V);
  test::check_bottom(test::central_errors(*scene, V, d));
  test::check_adjoint(s, V);
}

TEST_CASE("a motion that no contact notices: u' has none of it, and nothing may work on it") {
  const auto body = test::block("block", 2, Family::q1, 6, 0, 1000);
  test::pull(body, "top", [](const Point& x) { return Point{0, -2 - x[0], 0}; });
  const auto scene = scene::make_scene({body});
  scene::add_contact(*scene, test::part(body, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, true);
  const auto V = test::velocities(*scene, test::random_motion(0.01));
  const auto s = test::sensitivity(test::solved(scene));
  const shape::Derivative d = s.along(V);
  test::check_bottom(test::central_errors(*scene, V, d));
  const algebra::Vector& f = s.solution().model().problem.blocks.front().f;  // of the compliance: no work on the motion
  CHECK(s.adjoint(f, {}).along(s.change(V)) == doctest::Approx(f.dot(d.u)).epsilon(1e-10));
  algebra::Vector push = algebra::Vector::Zero(s.solution().unknowns());
  push[0] = 1;  // along x
  CHECK_THROWS_WITH_AS(s.adjoint(push, {}), doctest::Contains("nothing holds 'block': translation along x, on which the gradient by displacements does the work 1"), InputError);

  const auto pressed = test::block("block", 2, Family::q1, 6, 0, 1000);
  test::press(pressed, "top", 2);
  const auto second = scene::make_scene({pressed});
  scene::add_contact(*second, test::part(pressed, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, true);
  const auto turning = test::velocities(*second, [](int, const Point& x) { return Point{0, 0.1 * x[0] * x[1], 0}; });
  CHECK_THROWS_WITH_AS(test::sensitivity(test::solved(second)).along(turning),
                       doctest::Contains("nothing holds 'block': translation along x, on which the change of loads and shape does the work"), InputError);
}

TEST_CASE("derivatives take the solve's own factor") {
  const auto body = roller("roller", 2, Family::q1, 12);
  test::fix(body, "left", {true, false, false});
  test::press(body, "top", 3);
  const auto scene = scene::make_scene({body});
  scene::add_contact(*scene, test::part(body, "bottom"), contact::RigidPlane{{0, -0.001, 0}, {0, 1, 0}}, {}, true);
  const auto condenser = std::make_shared<problem::Condenser>();
  const auto solution = test::solved(scene, condenser);
  const auto V = test::velocities(*scene, test::random_motion(0.01));
  const auto shared = test::sensitivity(solution, condenser), own = test::sensitivity(solution);
  const shape::Derivative a = shared.along(V), b = own.along(V);
  CHECK(shared.clock().factor == 0);
  CHECK(own.clock().factor > 0);
  CHECK(a.u == b.u);
}

TEST_CASE("what has no derivative is refused with the reason") {
  const auto make = [](contact::Multipliers multipliers) {
    const auto lower = test::block("lower", 2, Family::q1, 4, 0, 1000), upper = test::block("upper", 2, Family::q1, 4, 1, 600);
    test::fix(lower, "bottom");
    test::fix(upper, "left", {true, false, false});
    test::press(upper, "top", 2);
    const auto scene = scene::make_scene({lower, upper});
    scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"), {},
                       {problem::laws::friction, [](const Point&) { return 0.5; }}, false, {multipliers});
    return scene;
  };
  const auto scene = make(contact::Multipliers::p1_p0);
  const auto V = test::velocities(*scene, test::waves(0.01));
  const auto s = test::sensitivity(test::solved(scene));
  CHECK_THROWS_WITH_AS(s.change(V), doctest::Contains("P1-P0"), InputError);
  CHECK_THROWS_WITH_AS(s.change({{}}), "the scene has 2 bodies; velocities are given for 1", InputError);
  CHECK_THROWS_WITH_AS(s.change({{1.0}, {}}), doctest::Contains("'lower' has 50 coordinates; 1 velocities are given"),
                       InputError);
  CHECK_THROWS_WITH_AS(s.change({{}, std::vector<double>(50, std::nan(""))}), "a velocity of 'upper' is not a finite number", InputError);
  CHECK(s.change({{}, {}}).f.norm() == 0);
  CHECK_THROWS_WITH_AS(s.adjoint(algebra::Vector::Zero(3), {}), doctest::Contains("the gradient is of 3 unknowns"), InputError);
}
