// FETI where loads are extreme, motions free, or no solution there is.
#include <doctest/doctest.h>

#include "../support/feti.hpp"
#include "base/error.hpp"

using namespace dotyk;
using mesh::Point;
using test::solve_by;

namespace {

solver::Feti feti(int count, double tol = 1e-11) {
  solver::Feti method = test::feti(count);
  method.tol = tol;
  return method;
}

contact::RigidShape floor_of(int dimension) {
  return contact::RigidPlane{{0, 0, 0}, dimension == 2 ? Point{0, 1, 0} : Point{0, 0, 1}};
}

/// 70 blocks on a rigid floor, each pressed onto it: 210 rigid motions.
std::shared_ptr<scene::Scene> many(std::vector<std::shared_ptr<scene::Body>>& bodies) {
  for (int k = 0; k < 70; ++k) bodies.push_back(test::block("b" + std::to_string(k), 2, mesh::Family::q1, 2));
  auto s = scene::make_scene({bodies});
  for (const auto& b : bodies) scene::add_contact(*s, test::part(b, "bottom"), floor_of(2), {}, false);
  for (const auto& b : bodies) test::pull(b, "top", [](const Point&) { return Point{0, -1, 0}; });
  return s;
}

}  // namespace

TEST_CASE("motions that no row notices: the displacement is the least, as the direct methods give it") {
  for (const int dimension : {2, 3})
    for (const int count : {1, 4}) {
      const auto b = test::block("b", dimension, mesh::Family::q1, 3);
      const auto s = scene::make_scene({b});
      scene::add_contact(*s, test::part(b, "bottom"), floor_of(dimension), {}, false);
      test::pull(b, "top", [=](const Point& x) { return dimension == 2 ? Point{0, -2 - x[0], 0} : Point{0, 0, -2 - x[0]}; });
      const auto cut = solve_by(s, feti(count)), exact = solve_by(s, solver::Pdas{});
      REQUIRE_MESSAGE(cut->result().converged, cut->result().reason);
      CHECK(cut->result().reason.find("the displacement is the least") != std::string::npos);
      CHECK((cut->result().state.u.here() - exact->result().state.u.here()).norm() <= 1e-8 * exact->result().state.u.here().norm());
    }
}

TEST_CASE("of many bodies those that nothing holds are named, with its motion and what would hold it") {
  {
    std::vector<std::shared_ptr<scene::Body>> bodies;
    const auto s = many(bodies);
    test::pull(bodies[41], "left", [](const Point&) { return Point{1, 0, 0}; });
    test::pull(bodies[17], "left", [](const Point&) { return Point{-0.4, 0, 0}; });
    for (const int count : {0, 140})
      CHECK_THROWS_WITH_AS(solve_by(s, feti(count)), doctest::Contains("nothing stops 'b17': translation along -x by 0.4, 'b41': translation along x by 1;"), InputError);
  }
  std::vector<std::shared_ptr<scene::Body>> bodies;
  const auto s = many(bodies);
  test::pull(bodies[41], "top", [](const Point&) { return Point{0, 3, 0}; });  // 2 upwards in all
  CHECK_THROWS_WITH_AS(solve_by(s, feti(0)), doctest::Contains("nothing stops 'b41': translation along y; the load does work 2 on a unit of this motion. Hold 'b41' along y"), InputError);
}

TEST_CASE("displacements out of equilibrium are not called a solution") {
  const auto soft = test::block("soft", 2, mesh::Family::q1, 8, 0, 1), hard = test::block("hard", 2, mesh::Family::q1, 8, 1, 1e13);
  test::fix(soft, "bottom");
  test::fix(hard, "left", {true, false, false});
  test::pull(hard, "top", [](const Point&) { return Point{0.1, -1, 0}; });
  auto s = scene::make_scene({soft, hard});
  scene::add_contact(*s, test::part(hard, "bottom"), test::part(soft, "top"), {});
  const auto cut = solve_by(s, feti(8, 1e-8));
  CHECK(cut->residual().equilibrium > 1e-3);
  CHECK(!cut->result().converged);
  CHECK_MESSAGE(cut->result().reason.find(" in equilibrium") != std::string::npos, cut->result().reason);
}

TEST_CASE("loads of any size: the solution is in proportion") {
  namespace laws = dotyk::problem::laws;
  for (const int dimension : {2, 3})
    for (const auto kind : {&laws::free, &laws::friction, &laws::coulomb}) {
      const auto of = [&](double size) {
        const auto lower = test::block("lower", dimension, mesh::Family::q1, 3), upper = test::block("upper", dimension, mesh::Family::q1, 3, 1.0, 100);
        test::fix(lower, "bottom");
        test::fix(upper, "left");
        test::pull(upper, "top", [=](const Point& x) {
          return dimension == 2 ? Point{size, size * (-10 + 4 * x[0]), 0} : Point{0.8 * size, 0.5 * size, size * (-10 + 4 * x[0])};
        });
        auto s = scene::make_scene({lower, upper});
        const double value = kind == &laws::friction ? 0.7 * size : kind == &laws::coulomb ? 0.12 : 0;
        scene::add_contact(*s, test::part(upper, "bottom"), test::part(lower, "top"), {}, {*kind, [=](const Point&) { return value; }});
        return solve_by(s, feti(5, 1e-9));
      };
      const auto one = of(1);
      REQUIRE_MESSAGE(one->result().converged, one->result().reason);
      for (const double size : {1e-170, 1e-100, 1e120, 1e150}) {
        CAPTURE(size);
        const auto scaled = of(size);
        CHECK_MESSAGE(scaled->result().converged, scaled->result().reason);
        const auto &mine = scaled->result().state, &right = one->result().state;
        CHECK((mine.u.here() / size - right.u.here()).norm() <= 1e-7 * right.u.here().norm());
        CHECK((mine.lambda / size - right.lambda).norm() <= 1e-7 * right.lambda.norm());
      }
    }
}

TEST_CASE("prescribed displacements of any size: the solution is in proportion") {
  const auto of = [](double size) {
    const auto b = test::block("b", 2, mesh::Family::q1, 4);
    test::fix(b, "bottom");
    auto top = test::part(b, "top");
    scene::displace(top, {[=](const Point& x) { return 0.1 * size * x[0]; }, [=](const Point&) { return -size; }, {}});
    return solve_by(scene::make_scene({b}), feti(4, 1e-9));
  };
  const auto one = of(1e-3);
  REQUIRE(one->result().converged);
  for (const double size : {1e-173, 1e140}) {
    const auto scaled = of(size);
    CHECK_MESSAGE(scaled->result().converged, scaled->result().reason);
    CHECK((scaled->result().state.u.here() / (1e3 * size) - one->result().state.u.here()).norm() <= 1e-7 * one->result().state.u.here().norm());
  }
}
