#include <doctest/doctest.h>

#include <cmath>

#include "../support/scenes.hpp"
#include "problem/solvability.hpp"
#include "scene/model/model.hpp"

using namespace dotyk;
using mesh::Point;
using test::friction;

namespace {

bool solvable(const std::shared_ptr<scene::Scene>& s) {
  Monitor quiet;
  problem::Clock clock;
  const auto model = scene::build(*s, clock, quiet);
  return problem::solvability(problem::rigid_motions(model.problem), model.problem).verdict !=
         problem::Solvability::Verdict::unsolvable;
}

/// A ladder between floor y = 0 and wall x = 0: foot from D to 1.1 D, head from H to 1.1 H. The load is one
/// on the upper side, so that its resultant is at x = at.
struct Ladder {
  static constexpr double D = 1.5, H = 3, wide = 1.1;
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> floor, wall;

  Ladder(double mu_floor, double mu_wall, double at, int n = 12) {
    mesh::Mesh m = test::rectangle(mesh::Family::q1, n, 1);
    mesh::transform(m, [](const Point& x) {
      const double far = 1 + (wide - 1) * (1 - x[1]);
      return Point{D * far * (1 - x[0]), H * far * x[0], 0};
    });
    const auto body = test::body("ladder", std::move(m), 1e6);
    // Density a + b s along the upper side, s = 1 - x/(D wide): total 1, mean of s as asked.
    const double mean = 1 - at / (D * wide), b = 12 * (mean - 0.5), a = 1 - b / 2;
    const double length = wide * std::hypot(D, H);
    test::pull(body, "bottom", [=](const Point& x) { return Point{0, -(a + b * (1 - x[0] / (D * wide))) / length, 0}; });
    scene = scene::make_scene({body});
    const auto lean = [&](const char* part, Point normal, double mu) {
      return scene::add_contact(*scene, test::part(body, part), contact::RigidPlane{{0, 0, 0}, normal}, {}, false,
                                friction(&problem::laws::coulomb, mu));
    };
    floor = lean("left", {0, 1, 0}, mu_floor);
    wall = lean("right", {1, 0, 0}, mu_wall);
  }
  /// The least x of the load that floor and wall carry (scripts/examples/ladder.lua derives it).
  static double limit(double mu_floor, double mu_wall) { return (D - mu_floor * wide * H) / (1 + mu_floor * mu_wall); }
};

}  // namespace

TEST_CASE("a ladder stands exactly while the load is farther from the wall than the closed form") {
  for (const double mu_floor : {0.1, 0.25, 0.4})
    for (const double mu_wall : {0.0, 0.2, 0.6}) {
      const double limit = Ladder::limit(mu_floor, mu_wall);
      REQUIRE(limit > 0.1);
      CHECK(solvable(Ladder(mu_floor, mu_wall, limit * (1 + 1e-7)).scene));
      CHECK(!solvable(Ladder(mu_floor, mu_wall, limit * (1 - 1e-7)).scene));
    }
}

TEST_CASE("an elastic ladder held by friction alone: forces and moment balance, friction within its cones") {
  for (const double mu_wall : {0.0, 0.3})
    for (const double beyond : {1.001, 1.2, 2.0}) {
      const double at = beyond * Ladder::limit(0.4, mu_wall);
      const Ladder ladder(0.4, mu_wall, at);
      Monitor quiet;
      const auto s = scene::solve(ladder.scene, {}, {}, quiet);
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      double fx = 0, fy = 0, moment = 0;
      for (const auto& contact : {ladder.floor, ladder.wall}) {
        const double mu = contact == ladder.floor ? 0.4 : mu_wall;
        for (const auto& node : s->contact(*contact).nodes) {
          double f[2];
          for (int i = 0; i < 2; ++i) f[i] = -node.force * node.normal[i] + node.shear[i] * node.weight;
          fx += f[0];
          fy += f[1];
          moment += node.x[0] * f[1] - node.x[1] * f[0];
          CHECK(node.force >= 0);
          CHECK(std::hypot(node.shear[0], node.shear[1]) * node.weight <= mu * node.force + 1e-10);
        }
      }
      CHECK(std::abs(fx) < 1e-10);
      CHECK(std::abs(fy - 1) < 1e-10);
      CHECK(std::abs(moment - at) < 1e-10);
      CHECK(s->residual().equilibrium < 1e-10);
    }
}

TEST_CASE("a block between two walls is held up by given friction alone, up to 2 g A") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const double part : {0.3, 0.95, 1 + 1e-6}) {
        const double g = 0.7;
        const auto block = test::block("block", dim, family, dim == 2 ? 8 : 4);
        const auto down = [=](const Point&) { return dim == 2 ? Point{0, -2 * g * part, 0} : Point{0, 0, -2 * g * part}; };
        scene::load_volume(*block, down);
        const auto scene = scene::make_scene({block});
        std::vector<std::shared_ptr<const scene::Contact>> walls;
        for (const double side : {-1.0, 1.0})
          walls.push_back(scene::add_contact(*scene, test::part(block, side < 0 ? "left" : "right"),
                                             contact::RigidGap{{side, 0, 0}, [](const Point&) { return -0.001; }}, {}, false,
                                             friction(&problem::laws::friction, g)));
        CHECK(solvable(scene) == (part < 1));
        if (part > 1) continue;
        Monitor quiet;
        const auto s = scene::solve(scene, {}, {}, quiet);
        REQUIRE_MESSAGE(s->result().converged, s->result().reason);
        Point sum{0, 0, 0};
        for (const auto& wall : walls) {
          const auto c = s->contact(*wall);
          CHECK(c.max_pressure > 0);
          for (int i = 0; i < dim; ++i) sum[i] += c.force[i];
        }
        for (int i = 0; i < dim; ++i) CHECK(std::abs(sum[i] - (i == dim - 1 ? 2 * g * part : 0)) < 1e-10);
      }
}
