#include <doctest/doctest.h>

#include <cmath>

#include "../support/random.hpp"
#include "../support/scenes.hpp"
#include "base/error.hpp"
#include "problem/rigid_motions.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

/// The semicoercive cases of TR965 1.2: the lower body is fixed, the upper one held by its side along
/// x₂ (slide) and by contact.
struct Case {
  const char* name;
  std::shared_ptr<scene::Scene> scene;
  std::size_t screws;  ///< how many are needed
};

mesh::Mesh shaped(int dim, int n, double bottom, const std::function<double(double, double)>& bend) {
  mesh::Mesh m = test::unit(dim, mesh::Family::q1, n);
  mesh::transform(m, [&](Point x) {
    x[dim - 1] += bottom + bend(x[0], dim == 3 ? x[1] : 0);
    return x;
  });
  return m;
}

Case make(const char* name, int dim, std::size_t screws, const std::function<double(double, double)>& bend,
          const elasticity::VectorField& traction) {
  const int n = dim == 2 ? 8 : 4;
  const auto lower = test::body("lower", shaped(dim, n, -1, bend), 200),
             upper = test::body("upper", shaped(dim, n, 0, bend), 700);
  test::fix(lower, "bottom");
  // In the plane the upper body may only rise; in space it may move and turn in the x₁x₃ plane.
  test::slide(upper, dim == 2 ? "left" : "front");
  test::pull(upper, "top", traction);
  auto scene = scene::make_scene({lower, upper});
  scene::add_contact(*scene, test::part(upper, "bottom"), test::part(lower, "top"), {});
  return {name, scene, screws};
}

std::vector<Case> cases() {
  const auto down2 = [](const Point& x) { return Point{0, -1 - x[0], 0}; };
  const auto down3 = [](const Point& x) { return Point{0, 0, -1 - x[1]}; };  // its middle is at x₁ = ½
  const auto flat = [](double, double) { return 0.0; };
  const auto bowl = [](double x, double) { return 0.3 * (x - 0.4) * (x - 0.4); };
  const auto groove = [](double x, double y) { return std::abs(x - 0.5) * (0.6 + 0.1 * y); };
  // A cylinder about the axis x₁ = ½, x₃ = 2, along x₂, and the same with a ripple of 1 %.
  const auto cylinder = [](double x, double) { return 2 - std::sqrt(4 - (x - 0.5) * (x - 0.5)); };
  const auto almost = [=](double x, double y) { return cylinder(x, y) + 0.01 * std::sin(3 * x + 1); };
  return {make("plane, flat", 2, 1, flat, down2), make("plane, curved", 2, 1, bowl, down2),
          make("space, planar contact", 3, 2, flat, down3), make("space, a groove", 3, 3, groove, down3),
          make("space, almost a cylinder", 3, 3, almost, down3)};
}

std::shared_ptr<scene::Solution> solve(const Case& c, const solver::Pdas& method) {
  Monitor quiet;
  return scene::solve(c.scene, method, {}, quiet);
}

void agree(const scene::Solution& a, const scene::Solution& b) {
  CHECK((a.result().state.u - b.result().state.u).norm() < 1e-8 * b.result().state.u.norm());
  CHECK((a.result().state.lambda - b.result().state.lambda).norm() < 1e-8 * b.result().state.lambda.norm());
}

}  // namespace

TEST_CASE("screws chosen by themselves give the solution of the exact kernel") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const auto exact = solve(c, {});
    REQUIRE(exact->result().converged);
    solver::Pdas screws;
    screws.kernel = solver::Pdas::Kernel::screws;
    const auto s = solve(c, screws);
    REQUIRE_MESSAGE(s->result().converged, s->result().reason);
    CHECK(s->result().method == "pdas with screws");
    agree(*s, *exact);
    for (double l : s->result().state.lambda) CHECK(l >= -1e-9 * s->result().state.lambda.maxCoeff());
  }
}

TEST_CASE("screws placed wrong on purpose are moved, and end right") {
  test::Random random(301);
  int moved = 0, tried = 0;
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const auto exact = solve(c, {});
    const int rows = exact->rows();
    for (int trial = 0; trial < 12; ++trial) {
      solver::Pdas screws;
      screws.kernel = solver::Pdas::Kernel::screws;
      while (screws.screws.size() < c.screws) {
        const int r = static_cast<int>(random.between(0, rows - 1e-9));
        if (std::find(screws.screws.begin(), screws.screws.end(), r) == screws.screws.end()) screws.screws.push_back(r);
      }
      std::shared_ptr<scene::Solution> s;
      try {
        s = solve(c, screws);
      } catch (const InputError& error) {  // e.g. two screws on one line: refused as such
        CHECK(std::string(error.what()).find("do not hold every rigid motion") != std::string::npos);
        continue;
      }
      ++tried;
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      CHECK(s->result().screw_moves <= screws.max_moves);
      moved += s->result().screw_moves > 0;
      agree(*s, *exact);
    }
  }
  CHECK(tried > 30);
  CHECK(moved > 3);  // otherwise the placements were no test
}

TEST_CASE("screws: too many, repeated, and the full form are refused") {
  const Case c = cases()[1];
  solver::Pdas screws;
  screws.kernel = solver::Pdas::Kernel::screws;
  screws.screws = {0, 1};
  CHECK_THROWS_WITH_AS(solve(c, screws), doctest::Contains("2 are given; this problem needs 1"), InputError);
  screws.screws = {3, 3};
  CHECK_THROWS_WITH_AS(solve(c, screws), doctest::Contains("row 4 is named twice"), InputError);
  screws.screws = {};
  screws.reduced = false;
  CHECK_THROWS_WITH_AS(solve(c, screws), doctest::Contains("needs reduced = true"), InputError);
}
