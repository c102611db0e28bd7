#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "../support/scenes.hpp"
#include "base/error.hpp"
#include "punch.hpp"
#include "reference.hpp"

using namespace dotyk;
using mesh::Point;
using test::coulomb;
using test::given;

namespace {

struct Blocks {
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
};

/// C2 and T2 of the reference values: a free block on a fixed one, pulled sideways.
Blocks blocks(int n, const scene::GivenLaw& friction, Point traction = {2, -10, 0}) {
  const auto half = [&](const char* name, double y) {
    const double from[2] = {0, y}, to[2] = {2, y + 1};
    const int cells[2] = {n, n / 2};
    const mesh::Grading even[2];
    return test::body(name, mesh::rectangle(from, to, cells, mesh::Family::p1, even), 1000);
  };
  const auto lower = half("lower", 0), upper = half("upper", 1);
  test::fix(lower, "bottom");
  test::pull(upper, "top", [=](const Point&) { return traction; });
  Blocks b;
  b.scene = scene::make_scene({lower, upper});
  b.contact = scene::add_contact(*b.scene, test::part(upper, "bottom"), test::part(lower, "top"), {}, friction);
  return b;
}

std::shared_ptr<scene::Solution> solve_by_default(const std::shared_ptr<scene::Scene>& s) {
  Monitor quiet;
  return scene::solve(s, {}, {}, quiet);
}

constexpr double kTenDigits = 5e-11;

}  // namespace

TEST_CASE("Coulomb friction of two blocks has the values of other codes") {
  const auto b = blocks(64, coulomb(0.3));
  const auto s = solve_by_default(b.scene);
  REQUIRE_MESSAGE(s->result().converged, s->result().reason);
  CHECK(s->result().iterations <= 12);
  reference::compare(s->energy(), "C2", "n=64", "energy (elastic minus load work)", kTenDigits);
  const auto c = s->contact(*b.contact);
  CHECK(std::to_string(c.stick) + "/" + std::to_string(c.slip) + "/" + std::to_string(c.open) == "34/31/0");
  CHECK(c.force[0] == doctest::Approx(-4).epsilon(1e-11));
  CHECK(c.force[1] == doctest::Approx(20).epsilon(1e-11));
  CHECK(s->residual().friction < 1e-11);
  CHECK(s->residual().equilibrium < 1e-11);
  for (const auto& node : c.nodes) {
    const double shear = std::hypot(node.shear[0], node.shear[1]), slip = node.slip[0];
    if (node.status == problem::Status::stick) CHECK(std::abs(slip) < 1e-12);
    if (node.status != problem::Status::slip) continue;
    CHECK(shear == doctest::Approx(0.3 * node.pressure).epsilon(1e-9));
    CHECK(slip * node.shear[0] <= 0);  // friction acts against the slip
  }
}

TEST_CASE("given friction of two blocks has the values of other codes, and is refused beyond what it carries") {
  const auto b = blocks(64, given(2.5));
  const auto s = solve_by_default(b.scene);
  REQUIRE_MESSAGE(s->result().converged, s->result().reason);
  reference::compare(s->energy(), "T2", "n=64", "elastic energy minus load work", kTenDigits);
  reference::compare(s->energy() + s->friction_energy(), "T2", "n=64", "the same plus friction term", kTenDigits);
  const auto c = s->contact(*b.contact);
  CHECK(std::to_string(c.stick) + "/" + std::to_string(c.slip) + "/" + std::to_string(c.open) == "24/41/0");
  CHECK_THROWS_WITH_AS(solve_by_default(blocks(16, given(1.5)).scene),
                       doctest::Contains("nothing stops 'upper': translation along x; the load does work 4"), InputError);
}

TEST_CASE("the Coulomb punch in space has the values of other codes") {
  const double from[3] = {0, 0, 0}, to[3] = {1, 1, 1};
  const int cells[3] = {8, 8, 8};
  const mesh::Grading even[3];
  const auto cube = test::body("cube", mesh::box(from, to, cells, mesh::Family::p1, even), 1000);
  test::fix(cube, "bottom");
  const auto scene = scene::make_scene({cube});
  const auto gap = [](const Point& x) {
    return ((x[0] - .5) * (x[0] - .5) + (x[1] - .5) * (x[1] - .5)) / 2 - 0.02;
  };
  const auto contact = scene::add_contact(*scene, test::part(cube, "top"), contact::RigidGap{{0, 0, 1}, gap}, {}, false,
                                          coulomb(0.3));
  const auto s = solve_by_default(scene);
  REQUIRE_MESSAGE(s->result().converged, s->result().reason);
  reference::compare(s->energy(), "S3C", "n=8", "elastic energy", kTenDigits);
  const auto c = s->contact(*contact);
  CHECK(std::to_string(c.stick) + "/" + std::to_string(c.slip) == "3/2");
}

TEST_CASE("no friction, and friction that cannot slip") {
  // Pressed straight down and held sideways, so that every case has a solution.
  for (int dim : {2, 3}) {
    const auto make = [&](const scene::GivenLaw& friction, bool glued = false) {
      const auto lower = test::block("lower", dim, mesh::Family::q1, 3), upper = test::block("upper", dim, mesh::Family::q1, 3, 1, 400);
      test::fix(lower, "bottom");
      test::fix(upper, "left");
      test::pull(upper, "top", [=](const Point& x) {
        Point t{0.3, 0, 0};
        t[dim - 1] = -1 - x[0];
        return t;
      });
      auto scene = scene::make_scene({lower, upper});
      if (glued)
        scene::add_glue(*scene, test::part(upper, "bottom"), test::part(lower, "top"));
      else
        scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"), {}, friction);
      return solve_by_default(scene);
    };
    const auto plain = make({});
    CHECK(make(given(0))->rows() == plain->rows());
    CHECK(make(coulomb(0))->rows() == plain->rows());
    CHECK((make(given(0))->result().state.u.here() - plain->result().state.u.here()).norm() < 1e-12 * plain->result().state.u.here().norm());
    const auto stuck = make(given(std::numeric_limits<double>::infinity())), large = make(given(1e6));
    CHECK(stuck->result().converged);
    CHECK(large->result().converged);
    CHECK((stuck->result().state.u.here() - large->result().state.u.here()).norm() < 1e-9 * stuck->result().state.u.here().norm());
    for (double bad : {-1.0, std::nan("")}) {
      CHECK_THROWS_WITH_AS(make(given(bad)), doctest::Contains("must be zero or positive"), InputError);
      CHECK_THROWS_WITH_AS(make(coulomb(bad)), doctest::Contains("must be zero or positive"), InputError);
    }
    CHECK_THROWS_AS(make(coulomb(std::numeric_limits<double>::infinity())), InputError);
  }
}

TEST_CASE("a block sticks until the tangent of the load's angle passes the coefficient") {
  for (int dim : {2, 3})
    for (double direction : {0.0, 0.7}) {
      if (dim == 2 && direction > 0) continue;
      const auto pulled = [&](double tangent) {
        const auto block = test::block("block", dim, mesh::Family::q1, 2);
        // As a force per volume through a low body, so that it slides before it tips.
        const double along = tangent;
        test::pull(block, "bottom", [=](const Point&) {
          Point t{along * std::cos(direction), dim == 3 ? along * std::sin(direction) : 0, 0};
          t[dim - 1] = -1;
          return t;
        });
        auto scene = scene::make_scene({block});
        Point normal{0, 0, 0};
        normal[dim - 1] = 1;
        scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, normal}, {}, false, coulomb(0.4));
        return scene;
      };
      for (double tangent : {0.1, 0.39, 0.3999}) CHECK(solve_by_default(pulled(tangent))->result().converged);
      for (double tangent : {0.4001, 0.41, 1.0})
        CHECK_THROWS_WITH_AS(solve_by_default(pulled(tangent)), doctest::Contains("nothing stops 'block'"), InputError);
    }
}

TEST_CASE("pdas says that it cannot treat friction, and what can") {
  Monitor quiet;
  CHECK_THROWS_WITH_AS(scene::solve(blocks(8, coulomb(0.3)).scene, solver::Pdas{}, {}, quiet),
                       doctest::Contains("pdas cannot treat the Coulomb friction"), InputError);
}

TEST_CASE("friction where nothing touches: the linear solution, with no multipliers") {
  Monitor quiet;
  const auto block = test::block("block", 2, mesh::Family::p1, 3);
  test::fix(block, "bottom");
  test::press(block, "top", 1);
  auto scene = scene::make_scene({block});
  scene::add_contact(*scene, test::part(block, "top"), contact::RigidPlane{{0, 2, 0}, {0, -1, 0}}, {}, false, coulomb(0.3));
  const auto s = scene::solve(scene, solver::Newton{}, {}, quiet);
  CHECK(s->result().converged);
  CHECK(s->result().state.lambda.norm() == 0);
  CHECK(s->residual().equilibrium < 1e-13);
}

TEST_CASE("given friction that jumps: nothing where it is zero, each node within its own bound, no slip where infinite") {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double high : {10.0, infinite}) {
    const auto bound = [=](const Point& x) { return x[0] < 0.9 ? 0 : x[0] < 1.6 ? 1.5 : high; };
    const auto b = blocks(32, {problem::laws::friction, bound});
    const auto s = solve_by_default(b.scene);
    REQUIRE_MESSAGE(s->result().converged, s->result().reason);
    const auto c = s->contact(*b.contact);
    CHECK(c.friction_force[0] == doctest::Approx(-4).epsilon(1e-11));
    CHECK(std::abs(c.friction_force[1]) < 1e-12);
    CHECK(c.closed == 15);  // the nodes with g = 0 have no tangential unknowns
    for (const auto& node : c.nodes) {
      const double g = bound(node.x), shear = std::abs(node.shear[0]);
      if (g == 0) {
        CHECK(shear == 0);
        CHECK(node.status == problem::Status::closed);
      } else {
        CHECK(shear <= g * (1 + 1e-12));
        CHECK(std::abs(node.slip[0]) < (shear < g * (1 - 1e-9) ? 1e-12 : infinite));
      }
    }
  }
}
