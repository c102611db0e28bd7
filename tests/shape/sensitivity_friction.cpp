// Derivatives of solutions with friction where it is differentiable: stick and slip in the plane and in space, against
// central differences as in sensitivity.cpp (with a little more rounding: 3e-8), and the refusal of its kinks.
#include "base/error.hpp"
#include "differences.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;

namespace {

scene::GivenLaw given(elasticity::ScalarField g) { return {problem::laws::friction, std::move(g)}; }

using BodyPtr = std::shared_ptr<scene::Body>;

/// A body on another, pressed and pulled sideways.
test::ScenePtr pressed(const BodyPtr& lower, const BodyPtr& upper, const scene::GivenLaw& friction) {
  const int dimension = lower->dimension();
  test::fix(lower, "bottom");
  test::springs(upper, "right", {30, dimension == 3 ? 25.0 : 0.0, 0});
  test::pull(upper, "top", [=](const Point& x) {
    Point t{1.5 + 0.5 * x[0], dimension == 3 ? 0.7 : 0, 0};
    t[dimension - 1] = -6 - 2 * x[0];
    return t;
  });
  const auto scene = scene::make_scene({lower, upper});
  scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"), {}, friction, true);
  return scene;
}

test::ScenePtr blocks(int dimension, Family family, int n, const scene::GivenLaw& friction) {
  return pressed(test::block("lower", dimension, family, n, 0, 1000), test::block("upper", dimension, family, n, 1, 600), friction);
}

/// Moves without turning the contact's plane in space, whose tangents' axis would change with it.
test::Motion motion(int dimension) {
  return [=, waves = test::waves(0.02)](int b, const Point& x) {
    Point v = waves(b, x);
    if (dimension == 3) v[2] *= (x[2] - 1) * (x[2] - 1);
    return v;
  };
}

void check(const test::ScenePtr& scene, const test::Motion& motion, bool sticks, bool slips, double bottom = 3e-8) {
  const auto V = test::velocities(*scene, motion);
  const auto solution = test::solved(scene);
  const auto c = solution->contact(*scene->contacts.front());
  CAPTURE(c.stick);
  CAPTURE(c.slip);
  CHECK((c.stick > 0) == sticks);
  CHECK((c.slip > 0) == slips);
  const auto s = test::sensitivity(solution);
  REQUIRE(s.smooth());
  test::check_bottom(test::central_errors(*scene, V, s.along(V)), bottom);
  test::check_adjoint(s, V);
}

}  // namespace

TEST_CASE("given friction: some nodes stick, some slip, in the plane and in space") {
  for (const int dimension : {2, 3})
    for (const auto family : test::kFamilies) {
      CAPTURE(dimension);
      check(blocks(dimension, family, dimension == 2 ? 8 : 4, given([=](const Point& x) { return (dimension == 2 ? 0.4 : 0.5) * (1 + 3 * x[0]); })), motion(dimension), true, true);
    }
}

TEST_CASE("given friction that holds everywhere, and friction that cannot slip") {
  for (const double g : {50.0, std::numeric_limits<double>::infinity()})
    for (const int dimension : {2, 3})
      check(blocks(dimension, Family::q1, 4, given([=](const Point&) { return g; })), motion(dimension), true, false);
}

TEST_CASE("Coulomb friction: its bound follows the pressure") {
  for (const int dimension : {2, 3})
    check(blocks(dimension, Family::q1, dimension == 2 ? 8 : 4, test::coulomb(dimension == 2 ? 0.2 : 0.25)), motion(dimension), true, true);
}

TEST_CASE("a corner of the contact, whose given friction the nodes beside it bear") {
  const auto folded = [](const std::string& name, double lift, double E) {
    mesh::Mesh m = test::unit(2, Family::q1, 8);
    mesh::transform(m, [&](Point x) { return x[1] += lift + 0.5 * std::abs(x[0] - 0.5), x; });
    return test::body(name, std::move(m), E);
  };
  const auto friction = given([](const Point& x) { return 2 * (1 + x[0]); });
  check(pressed(folded("lower", 0, 1000), folded("upper", 1, 600), friction), motion(2), true, true);
}

TEST_CASE("given friction against a rigid ball, whose tangents turn") {
  for (const int dimension : {2, 3}) {
    const auto body = test::block("block", dimension, Family::q1, dimension == 2 ? 10 : 4, 0, 1000);
    auto top = test::part(body, "top");
    std::array<elasticity::ScalarField, 3> down;
    for (int i = 0; i < dimension; ++i) down[i] = [=](const Point&) { return i == 0 ? 0.01 : i == dimension - 1 ? -0.02 : 0.01; };
    scene::displace(top, down);
    Point centre{0.45, 0.56, -1};
    if (dimension == 2) centre = {0.45, -1, 0};
    const auto scene = scene::make_scene({body});
    scene::add_contact(*scene, test::part(body, "bottom"), contact::RigidBall{centre, 1.05}, {}, true, given([=](const Point&) { return dimension == 2 ? 10.0 : 6.0; }));
    check(scene, test::waves(0.02), true, true);
  }
}

TEST_CASE("friction that is about to slip has no derivative, and the node is named") {
  const auto stuck = test::solved(blocks(2, Family::q1, 4, given([](const Point&) { return 50.0; })));
  const auto nodes = stuck->contact(*stuck->scene().contacts.front()).nodes;
  const auto& third = nodes[2];
  const double just = std::hypot(third.shear[0], third.shear[1]);
  const auto at_limit = [&](double factor) {
    return test::solved(blocks(2, Family::q1, 4, given([&](const Point& x) { return std::abs(x[0] - third.x[0]) < 1e-9 ? factor * just : 50.0; })));
  };
  CHECK_THROWS_WITH_AS(test::sensitivity(at_limit(1)), doctest::Contains("node 3 of 'upper' at (0.5, 1) bears all its friction bound"), InputError);
  CHECK_NOTHROW(test::sensitivity(at_limit(1.001)));
  CHECK_NOTHROW(test::sensitivity(at_limit(0.999)));
}

TEST_CASE("solutions that have no derivative of their own are refused") {
  Monitor quiet;
  const auto scene = blocks(2, Family::q1, 4, given([](const Point& x) { return 0.4 * (1 + 3 * x[0]); }));
  const scene::Step half{.all = 0.5, .factor = {}, .move = {}}, whole{.all = 1.0, .factor = {}, .move = {}};
  const auto last = scene::solve(scene, solver::Newton{}, {}, quiet, {half, whole});
  CHECK_THROWS_WITH_AS(test::sensitivity(last), doctest::Contains("its slip goes on from an earlier step"), InputError);
  CHECK_THROWS_WITH_AS(test::sensitivity(last->steps().front()), doctest::Contains("the solution is an earlier step of a history"), InputError);
  solver::Newton short_of_time;
  short_of_time.max_iterations = 1;
  CHECK_THROWS_WITH_AS(test::sensitivity(scene::solve(scene, short_of_time, {}, quiet)), doctest::Contains("the solution has not converged"), InputError);
  // One step under half the load is a solution like any other.
  const auto alone = scene::solve(scene, solver::Newton{}, {}, quiet, {half});
  CHECK(test::sensitivity(alone).along(test::velocities(*scene, motion(2))).u.norm() > 0);
}
