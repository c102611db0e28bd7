#include <doctest/doctest.h>

#include "../support/random.hpp"
#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

struct OnFloor {
  std::shared_ptr<scene::Body> block;
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
};

/// A block on a rigid floor; its bottom cannot move along the floor, but may lift and tip.
OnFloor on_floor(int dim, mesh::Family family, bool held_along = true) {
  OnFloor s;
  s.block = test::block("block", dim, family, 4);
  if (held_along)
    test::fix(s.block, "bottom",
              dim == 2 ? std::array<bool, 3>{true, false, false} : std::array<bool, 3>{true, true, false});
  s.scene = scene::make_scene({s.block});
  Point normal{0, 0, 0};
  normal[dim - 1] = 1;
  s.contact =
      scene::add_contact(*s.scene, test::part(s.block, "bottom"), contact::RigidPlane{{0, 0, 0}, normal}, {}, false);
  return s;
}

/// A traction on the top with resultant −1 acting at x.
elasticity::VectorField load_at(int dim, double x) {
  // t = a + b s on [0, 1]: a + b/2 = 1, a/2 + b/3 = x.
  const double b = 12 * (x - 0.5), a = 1 - b / 2;
  return [=](const Point& p) {
    Point t{0, 0, 0};
    t[dim - 1] = -(a + b * p[0]);
    return t;
  };
}

}  // namespace

TEST_CASE("a block held by contact alone: force and moment of the contact are those of the load") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const bool reduced : {true, false})
        for (double x : {0.5, 0.3, 0.15, 0.9}) {
          auto s = on_floor(dim, family);
          test::pull(s.block, "top", load_at(dim, x));
          const auto solution = test::solve(s.scene, reduced);
          REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
          double force = 0, moment = 0;
          for (const auto& node : solution->contact(*s.contact).nodes) {
            CHECK(node.force >= 0);
            CHECK(node.gap > -1e-12);
            force += node.force;
            moment += node.force * node.x[0];
          }
          CHECK(force == doctest::Approx(1).epsilon(1e-10));
          CHECK(moment == doctest::Approx(x).epsilon(1e-9));
          CHECK(solution->residual().equilibrium < 1e-11);
        }
}

TEST_CASE("a free block equals the one that supports hold where these carry nothing") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      auto free = on_floor(dim, family, false);
      // Uniform pressure, σ = −p: the bottom may spread, symmetry planes carry nothing.
      for (const char* side : {"left", "front"})
        if (dim == 3 || std::string(side) == "left") test::slide(free.block, side);
      test::press(free.block, "top", 2);
      const auto s = test::solve(free.scene);
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      for (const auto& node : s->contact(*free.contact).nodes)
        CHECK(node.pressure == doctest::Approx(2).epsilon(1e-11));

      auto held = test::block("block", dim, family, 4);
      test::symmetric(held);
      test::slide(held, "bottom");
      test::press(held, "top", 2);
      Monitor quiet;
      const auto linear = scene::solve(scene::make_scene({held}), {}, {}, quiet);
      double difference = 0;
      for (std::size_t k = 0; k < linear->displacement(0).size(); ++k)
        difference = std::max(difference, std::abs(linear->displacement(0)[k] - s->displacement(0)[k]));
      CHECK(difference < 1e-13);
    }
}

TEST_CASE("a load that tips the block, lifts it, or pushes it along the floor is refused") {
  for (int dim : {2, 3})
    for (const bool reduced : {true, false}) {
      auto tips = on_floor(dim, mesh::Family::p1);
      test::pull(tips.block, "top", load_at(dim, 1.2));
      CHECK_THROWS_WITH_AS(test::solve(tips.scene, reduced),
                           doctest::Contains(dim == 2 ? "not held: nothing stops 'block': clockwise rotation" : "not held: nothing stops 'block': rotation about the axis along y"),
                           InputError);
      auto lifts = on_floor(dim, mesh::Family::p1);
      test::press(lifts.block, "top", -1);
      CHECK_THROWS_WITH_AS(test::solve(lifts.scene, reduced),
                           doctest::Contains("not held: nothing stops 'block': translation along"), InputError);
      auto slips = on_floor(dim, mesh::Family::p1, false);
      test::pull(slips.block, "top", [&](const Point&) { return dim == 2 ? Point{0.1, -1, 0} : Point{0.1, 0, -1}; });
      CHECK_THROWS_WITH_AS(test::solve(slips.scene, reduced), doctest::Contains("translation along x"), InputError);
    }
}

TEST_CASE("a block that nothing holds along the floor and no load moves is solved up to that") {
  auto s = on_floor(2, mesh::Family::p1, false);
  test::press(s.block, "top", 1);
  const auto solution = test::solve(s.scene);
  REQUIRE(solution->result().converged);
  CHECK(solution->result().reason.find("unique up to 'block': translation along") != std::string::npos);
  CHECK(solution->residual().equilibrium < 1e-11);
}

TEST_CASE("a body without any support or contact is refused by name") {
  const auto block = test::block("lid", 2, mesh::Family::q1, 2);
  CHECK_THROWS_WITH_AS(test::solve(scene::make_scene({block})),
                       doctest::Contains("'lid' is not held: nothing stops its translation along x"), InputError);
}

TEST_CASE("a block that falls across a gap lands on it") {
  for (const auto family : test::kFamilies) {
    const auto block = test::block("block", 2, family, 4);
    test::fix(block, "bottom", {true, false, false});
    test::pull(block, "top", load_at(2, 0.4));
    const auto scene = scene::make_scene({block});
    const auto contact = scene::add_contact(*scene, test::part(block, "bottom"),
                                            contact::RigidPlane{{0, -0.5, 0}, {0, 1, 0}}, {}, false);
    const auto s = test::solve(scene);
    REQUIRE_MESSAGE(s->result().converged, s->result().reason);
    CHECK(s->contact(*contact).force[1] == doctest::Approx(1).epsilon(1e-10));
    CHECK(s->contact(*contact).closed > 0);
  }
}

TEST_CASE("stacks of free blocks under random loads are solved exactly where statics allows it, else refused") {
  test::Random random(501);
  Monitor quiet;
  int solved = 0, refused = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const int dim = trial % 4 == 3 ? 3 : 2, n = dim == 2 ? 6 : 3, count = 1 + trial % 3;
    const double apart = trial % 5 == 0 ? 0.01 : 0;  // gaps between the blocks
    std::vector<std::shared_ptr<scene::Body>> bodies;
    for (int b = 0; b < count; ++b) {
      bodies.push_back(test::block("block " + std::to_string(b), dim, test::kFamilies[trial % 2], n, b * (1 + apart),
                                   std::pow(10, random.between(0, 3))));
      test::fix(bodies.back(), "bottom",
                dim == 2 ? std::array<bool, 3>{true, false, false} : std::array<bool, 3>{true, true, false});
    }
    const double tilt = random.between(-4, 4), wave = random.between(2, 20), phase = random.between(0, 6);
    test::pull(bodies.back(), "top", [=](const Point& x) {
      Point t{0.5 * std::cos(phase), 0, 0};
      t[dim - 1] =
          -1 - 2 * std::sin(wave * x[0] + phase) - tilt * (x[0] - 0.5) + (dim == 3 ? 0.3 * std::sin(wave * x[1]) : 0);
      return t;
    });
    // Where the resultant passes through the bottom of the block that is loaded; the blocks below hand it on.
    double down = 0, at[2] = {0, 0};
    const scene::Body& top = *bodies.back();
    for (int k = 0; k < top.mesh->node_count(); ++k) {
      const Point x = top.mesh->point(k);
      const double* f = &top.force[k * dim];
      down -= f[dim - 1];
      for (int i = 0; i + 1 < dim; ++i) at[i] += (x[dim - 1] - (count - 1) * (1 + apart)) * f[i] - x[i] * f[dim - 1];
    }
    bool possible = down > 0;
    for (int i = 0; i + 1 < dim; ++i) possible = possible && at[i] > 0 && at[i] < down;

    const auto scene = scene::make_scene(bodies);
    Point normal{0, 0, 0};
    normal[dim - 1] = 1;
    const auto floor =
        scene::add_contact(*scene, test::part(bodies[0], "bottom"), contact::RigidPlane{{0, 0, 0}, normal}, {}, false);
    for (int b = 1; b < count; ++b)
      scene::add_contact(*scene, test::part(bodies[b], "bottom"), test::part(bodies[b - 1], "top"), {});
    INFO("trial ", trial, ": down ", down, " at ", at[0] / down);
    if (!possible) {
      ++refused;
      CHECK_THROWS_WITH_AS(test::solve(scene, trial % 7 > 2), doctest::Contains("not held"), InputError);
      continue;
    }
    ++solved;
    const auto s = test::solve(scene, trial % 7 > 2);
    REQUIRE_MESSAGE(s->result().converged, s->result().reason);
    CHECK(s->residual().equilibrium < 1e-10);
    CHECK(s->residual().penetration < 1e-10);
    CHECK(s->residual().law < 1e-9);
    CHECK(s->contact(*floor).force[dim - 1] == doctest::Approx(down).epsilon(1e-9));
  }
  CHECK(solved > 40);
  CHECK(refused > 10);
}
