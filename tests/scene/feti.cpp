// FETI against the direct methods: one problem, cut in many ways, has one solution.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/feti.hpp"
#include "base/error.hpp"

using namespace dotyk;
using mesh::Point;
using test::feti;
using test::friction;

namespace {

using Preconditioner = solver::Feti::Preconditioner;

/// ‖u − v‖ / ‖v‖ and the same of the multipliers.
void check_same(const scene::Solution& s, const scene::Solution& exact, double tolerance) {
  REQUIRE_MESSAGE(s.result().converged, s.result().reason);
  const auto &mine = s.result().state, &right = exact.result().state;
  CHECK((mine.u.here() - right.u.here()).norm() <= tolerance * right.u.here().norm());
  CHECK((mine.lambda - right.lambda).norm() <= tolerance * right.lambda.norm());
}

/// A block on another, pressed down and drawn sideways; held at its left side, or by contact alone.
std::shared_ptr<scene::Scene> two_blocks(int dimension, mesh::Family family, const scene::GivenLaw& friction, bool held,
                                         int n = 4) {
  const auto lower = test::block("lower", dimension, family, n), upper = test::block("upper", dimension, family, n, 1.0, 100);
  const char *top = "top", *bottom = "bottom";
  test::fix(lower, bottom);
  if (held) test::fix(upper, "left");
  test::pull(upper, top, [=](const Point& x) {
    return dimension == 2 ? Point{1, -10 + 4 * x[0], 0} : Point{0.8, 0.5, -10 + 4 * x[0]};
  });
  auto s = scene::make_scene({lower, upper});
  scene::add_contact(*s, test::part(upper, bottom), test::part(lower, top), {}, friction);
  return s;
}

}  // namespace

TEST_CASE("frictionless contact: every decomposition, preconditioner and update gives the direct method's solution") {
  for (const int dimension : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto s = two_blocks(dimension, family, {}, true);
      const auto exact = test::solve_by(s, solver::Pdas{});
      for (const bool rows : {true, false})
        for (const int count : {2, 7})
          check_same(*test::solve_by(s, feti(count, rows)), *exact, 1e-9);
      for (const auto preconditioner : {Preconditioner::lumped, Preconditioner::dirichlet})
        check_same(*test::solve_by(s, feti(6, true, preconditioner)), *exact, 1e-9);
      auto printed = feti(6);
      printed.outer.update = solver::Smalbe::Update::penalty;
      printed.expansion = solver::MprgpSettings::Expansion::projected_cg_step;
      check_same(*test::solve_by(s, printed), *exact, 1e-9);
    }
}

TEST_CASE("without contact a body cut into pieces has the linear solution, prescribed values and springs included") {
  for (const int dimension : {2, 3}) {
    const auto b = test::block("b", dimension, mesh::Family::q1, 4);
    auto left = test::part(b, "left"), right = test::part(b, "right");
    scene::displace(left, {[](const Point& x) { return 0.01 * x[1]; }, [](const Point&) { return 0.0; }, {}});
    test::springs(b, "right", {5, 3, 2});
    test::pull(b, "top", [](const Point&) { return Point{1, -2, 0.5}; });
    const auto s = scene::make_scene({b});
    const auto exact = test::solve_by(s, {});
    for (const bool rows : {true, false}) {
      const auto cut = test::solve_by(s, feti(5, rows));
      REQUIRE_MESSAGE(cut->result().converged, cut->result().reason);
      CHECK((cut->result().state.u.here() - exact->result().state.u.here()).norm() <= 1e-9 * exact->result().state.u.here().norm());
      CHECK(cut->residual().equilibrium <= 1e-7);  // K times what the copies disagree by: tol times K's condition
    }
  }
}

TEST_CASE("given and Coulomb friction: FETI finds what Newton's method finds") {
  namespace laws = dotyk::problem::laws;
  for (const int dimension : {2, 3})
    for (const auto& law : {friction(&laws::friction, 0.7), friction(&laws::coulomb, 0.12)}) {
      const auto s = two_blocks(dimension, mesh::Family::q1, law, true);
      const auto exact = test::solve_by(s, solver::Newton{});
      REQUIRE(exact->result().converged);
      const auto cut = test::solve_by(s, feti(6));
      check_same(*cut, *exact, 1e-8);
      const auto mine = cut->contact(*s->contacts[0]), right = exact->contact(*s->contacts[0]);
      CHECK(mine.stick == right.stick);
      CHECK(mine.slip == right.slip);
      CHECK(mine.slip > 0);
    }
}

TEST_CASE("free bodies are in equilibrium, and touching without force does no harm") {
  // Three blocks stacked on a rigid floor, pressed in the middle: the wide rest of the joints touches or opens.
  const auto scene_of = [](std::vector<std::shared_ptr<scene::Body>>& bodies) {
    bodies.clear();
    for (int k = 0; k < 3; ++k) bodies.push_back(test::block("b" + std::to_string(k), 2, mesh::Family::q1, 6, k));
    auto s = scene::make_scene({bodies});
    contact::RigidShape floor = contact::RigidPlane{{0, 0, 0}, {0, 1, 0}};
    scene::add_contact(*s, test::part(bodies[0], "bottom"), floor, {}, false);
    for (int k = 1; k < 3; ++k) scene::add_contact(*s, test::part(bodies[k], "bottom"), test::part(bodies[k - 1], "top"), {});
    test::pull(bodies[2], "top", [](const Point& x) { return Point{0, std::abs(x[0] - 0.5) < 0.26 ? -3.0 : 0.0, 0}; });
    return s;
  };
  std::vector<std::shared_ptr<scene::Body>> bodies;
  const auto s = scene_of(bodies);
  const auto cut = test::solve_by(s, feti(12));
  REQUIRE_MESSAGE(cut->result().converged, cut->result().reason);
  const auto exact = test::solve_by(s, solver::Pdas{});
  // The stack may slide sideways: stresses and forces are unique, not the displacement.
  CHECK((cut->result().state.lambda - exact->result().state.lambda).norm() <= 1e-9 * exact->result().state.lambda.norm());
  const double pressed = test::resultant(*bodies[2])[1];
  for (const auto& contact : s->contacts) {
    CHECK(cut->contact(*contact).force[1] == doctest::Approx(-pressed).epsilon(1e-10));
    double moment = 0;
    for (const auto& node : cut->contact(*contact).nodes) moment += node.force * (node.x[0] - 0.5);
    CHECK(std::abs(moment) <= 1e-10 * std::abs(pressed));
  }
  CHECK(cut->residual().equilibrium <= 1e-10);
}

TEST_CASE("a free body in space on a plane: motions that no row notices stay zero, loads on them are refused") {
  for (const auto family : test::kFamilies)
    for (const int count : {1, 4}) {
      const auto b = test::block("b", 3, family, 3);
      const auto s = scene::make_scene({b});
      contact::RigidShape floor = contact::RigidPlane{{0, 0, 0}, {0, 0, 1}};
      scene::add_contact(*s, test::part(b, "bottom"), floor, {}, false);
      test::pull(b, "top", [](const Point& x) { return Point{0, 0, -2 - x[0]}; });
      const auto cut = test::solve_by(s, feti(count));
      const auto exact = test::solve_by(s, solver::Pdas{});
      REQUIRE_MESSAGE(cut->result().converged, cut->result().reason);
      CHECK(cut->residual().equilibrium <= 1e-8);
      CHECK((cut->result().state.lambda - exact->result().state.lambda).norm() <= 1e-8 * exact->result().state.lambda.norm());
      CHECK(cut->result().history.size() >= 1);
    }
}

TEST_CASE("a load that no contact balances is refused, of however many bodies") {
  std::vector<std::shared_ptr<scene::Body>> bodies;
  for (int k = 0; k < 70; ++k) bodies.push_back(test::block("b" + std::to_string(k), 2, mesh::Family::q1, 1));
  auto s = scene::make_scene({bodies});
  contact::RigidShape floor = contact::RigidPlane{{0, 0, 0}, {0, 1, 0}};
  for (const auto& b : bodies) scene::add_contact(*s, test::part(b, "bottom"), floor, {}, false);
  for (const auto& b : bodies) test::pull(b, "top", [](const Point&) { return Point{0, -1, 0}; });
  CHECK(test::solve_by(s, feti(0))->result().converged);
  test::pull(bodies[41], "left", [](const Point&) { return Point{1, 0, 0}; });
  CHECK_THROWS_WITH_AS(test::solve_by(s, feti(0)), doctest::Contains("nothing stops 'b41': translation along x; the load does work 1 "), InputError);
}
