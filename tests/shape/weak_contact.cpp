// Nodes that touch without force: the derivative along a motion and along its opposite, each by the quadratic program of P7
// (15)–(17), against one-sided differences of second order of scenes solved again.
#include "base/error.hpp"
#include "differences.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;

namespace {

/// A pressed block over a rigid floor with this gap at the bottom's nodes, by x.
test::ScenePtr block(Family family, const elasticity::ScalarField& gap, bool free, const scene::GivenLaw& friction) {
  const auto body = test::block("block", 2, family, 8, 0, 1000);
  if (free) {
    test::fix(body, "left", {true, false, false});
    test::press(body, "top", 3);
  } else {
    test::fix(body, "top", {true, false, false});
    auto top = test::part(body, "top");
    scene::displace(top, {elasticity::ScalarField(), [](const Point&) { return -0.02; }, elasticity::ScalarField()});
  }
  const auto scene = scene::make_scene({body});
  scene::add_contact(*scene, test::part(body, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, gap, true, friction);
  return scene;
}

double bowl(const Point& x) { return 0.08 * (x[0] - 0.5) * (x[0] - 0.5); }

/// The block over a bowl, whose first `count` open nodes (by distance from the middle) have exactly the gap that they
/// close: where contact does not notice them, they touch without force.
test::ScenePtr touching(Family family, int count, bool free = false, const scene::GivenLaw& friction = {}) {
  const auto open = test::solved(block(family, bowl, free, friction));
  auto nodes = open->contact(*open->scene().contacts.front()).nodes;
  std::erase_if(nodes, [](const scene::ContactNode& n) { return n.gap < 1e-9; });
  std::sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return std::abs(a.x[0] - 0.5) < std::abs(b.x[0] - 0.5); });
  nodes.resize(static_cast<std::size_t>(count));
  return block(family, [=](const Point& x) {
    for (const scene::ContactNode& n : nodes)
      if (std::abs(x[0] - n.x[0]) < 1e-9) return -n.displacement[1];
    return bowl(x);
  }, free, friction);
}

test::Motion tilted() {
  return [](int, const Point& x) { return Point{0.01 * std::sin(5 * x[1]), 0.02 * (x[0] - 0.4) * (1.3 - x[1]), 0}; };
}
test::Motion backwards(const test::Motion& motion) {
  return [=](int b, const Point& x) {
    const Point v = motion(b, x);
    return Point{-v[0], -v[1], -v[2]};
  };
}

void check_sides(const test::ScenePtr& scene, const test::Motion& motion, int weak) {
  const auto s = test::sensitivity(test::solved(scene));
  CHECK_FALSE(s.smooth());
  CHECK(static_cast<int>(s.weak().size()) == weak);
  const auto V = test::velocities(*scene, motion), W = test::velocities(*scene, backwards(motion));
  const shape::Derivative forwards = s.along(V), back = s.along(W);
  for (const auto& d : {forwards, back})
    for (const int r : s.weak()) {
      CHECK(d.lambda[r] >= 0);
      if (!s.solution().model().problem.group_of_rows()[static_cast<std::size_t>(r)]->law->unilateral()) continue;
      CHECK(d.x[r] <= 1e-12 * d.x.lpNorm<Eigen::Infinity>());
      CHECK(std::abs(d.lambda[r] * d.x[r]) <= 1e-10 * d.lambda.lpNorm<Eigen::Infinity>() * d.x.lpNorm<Eigen::Infinity>());
    }
  test::check_bottom(test::one_sided_errors(*scene, V, forwards));
  test::check_bottom(test::one_sided_errors(*scene, W, back));
  CHECK((forwards.lambda + back.lambda).norm() > 0.01 * forwards.lambda.norm());  // they differ: a kink
}

}  // namespace

TEST_CASE("one node in weak contact: it closes one way and opens the other") {
  for (const auto family : test::kFamilies) check_sides(touching(family, 1), tilted(), 1);
}

TEST_CASE("two nodes in weak contact, and a body that contact alone holds down") {
  for (const bool free : {false, true}) check_sides(touching(Family::q1, 2, free), tilted(), 2);
}

TEST_CASE("weak contact with given friction that sticks and slips elsewhere; with Coulomb's it is refused") {
  const scene::GivenLaw given{problem::laws::friction, [](const Point& x) { return 0.2 + 2 * x[0]; }};
  const auto scene = touching(Family::q1, 1, false, given);
  const auto c = test::solved(scene)->contact(*scene->contacts.front());
  CHECK(c.stick > 0);
  CHECK(c.slip > 0);
  check_sides(scene, tilted(), 1);
  const scene::GivenLaw coulomb{problem::laws::coulomb, [](const Point&) { return 0.2; }};
  CHECK_THROWS_WITH_AS(test::sensitivity(test::solved(touching(Family::q1, 1, false, coulomb))),
                       doctest::Contains("touches without force, where its friction begins"), InputError);
}

TEST_CASE("in weak contact there is no gradient, and the nodes are named") {
  const auto s = test::sensitivity(test::solved(touching(Family::q1, 1)));
  CHECK(s.weak_text().find("of 'block' at (") != std::string::npos);
  CHECK_THROWS_WITH_AS(s.adjoint(algebra::Vector::Zero(s.solution().unknowns()), {}), doctest::Contains("weak contact (no force) at node "),
                       InputError);
}

namespace {

/// A block fixed below, before one-sided springs at its right; its load grows linearly with `level`.
test::ScenePtr before_springs(double level) {
  const auto body = test::block("block", 2, Family::q1, 6, 0, 1000);
  test::fix(body, "bottom");
  test::pull(body, "left", [=](const Point& x) { return Point{level - 20 * x[1] * x[1], 2, 0}; });
  auto right = test::part(body, "right");
  scene::support(right, problem::LawChoice{&problem::laws::one_sided_elastic, 500}, {});
  return scene::make_scene({body});
}

}  // namespace

TEST_CASE("a support's spring at the beginning of its law: weak contact with a compliance") {
  const int row = 3;
  const auto beyond = [&](double level) {
    const auto s = test::solved(before_springs(level));
    return (s->model().problem.B * s->result().state.u.here())[row];
  };
  double low = 5, at_low = beyond(low), high = 12, at_high = beyond(high);
  REQUIRE(at_low * at_high < 0);
  for (int k = 0; k < 60 && at_high != 0 && high != low; ++k) {  // secants of a function that is piecewise linear
    const double next = high - at_high * (high - low) / (at_high - at_low);
    low = high, at_low = at_high, high = next, at_high = beyond(next);
    if (at_high == at_low) break;
  }
  REQUIRE(std::abs(at_high) < 1e-15);
  check_sides(before_springs(high), [](int, const Point& x) {
    const double rest = 1 - x[0];  // of the right side
    return Point{0.05 * rest * x[1], 0.04 * rest, 0};
  }, 1);
}
