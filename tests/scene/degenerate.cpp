#include <doctest/doctest.h>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;

TEST_CASE("bodies that come to touch exactly, without pressure, settle at once") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const bool reduced : {true, false})
        for (const double gap : {0.1, 1e-4}) {
          const auto block = test::block("block", dim, family, 5, gap);
          auto top = test::part(block, "top");
          std::array<elasticity::ScalarField, 3> down;
          for (int i = 0; i < dim; ++i) down[i] = [=](const Point&) { return i == dim - 1 ? -gap : 0.0; };
          scene::displace(top, down);
          const auto scene = scene::make_scene({block});
          Point normal{0, 0, 0};
          normal[dim - 1] = 1;
          scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, normal}, {}, false);
          const auto s = test::solve(scene, reduced);
          REQUIRE_MESSAGE(s->result().converged, s->result().reason);
          CHECK(s->result().iterations <= 3);
          for (int n = 0; n < block->mesh->node_count(); ++n)
            CHECK(std::abs(s->displacement(0)[n * dim + dim - 1] + gap) < 1e-13);
        }
}

TEST_CASE("half of the contact pressed, half touching without force") {
  // Uniform pressure over two separate blocks side by side on a floor; only one is loaded.
  for (const auto family : test::kFamilies) {
    const auto loaded = test::block("loaded", 2, family, 6),
               idle = test::body("idle", test::rectangle(family, 6, 6, 2, 0, 3, 1));
    for (const auto& b : {loaded, idle}) test::fix(b, "left");
    test::press(loaded, "top", 5);
    const auto scene = scene::make_scene({loaded, idle});
    for (const auto& b : {loaded, idle})
      scene::add_contact(*scene, test::part(b, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
    const auto s = test::solve(scene);
    REQUIRE(s->result().converged);
    CHECK(s->result().reason == "active set confirmed");
    for (double v : s->displacement(1)) CHECK(std::abs(v) < 1e-15);
  }
}

TEST_CASE("an unloaded scene stays as it is") {
  const auto block = test::block("block", 2, mesh::Family::p1, 3);
  test::fix(block, "top");
  const auto scene = scene::make_scene({block});
  scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  const auto s = test::solve(scene);
  CHECK(s->result().converged);
  CHECK(s->energy() == 0);
  CHECK(s->error_estimate().relative == 0);
}

TEST_CASE("everything prescribed: no unknowns, no rows, still an answer") {
  const auto block = test::block("block", 2, mesh::Family::q1, 1);
  test::fix(block, "bottom");
  test::fix(block, "top");
  Monitor quiet;
  auto scene = scene::make_scene({block});
  CHECK(scene::solve(scene, {}, {}, quiet)->result().converged);
  scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  const auto s = scene::solve(scene, {}, {}, quiet);
  CHECK(s->result().converged);
  CHECK(s->contact(*scene->contacts[0]).nodes.size() == 2);
}

TEST_CASE("interference: a block pressed into the floor by its own position has the pressure of that compression") {
  for (const auto family : test::kFamilies) {
    const auto block = test::block("block", 2, family, 4);
    test::symmetric(block);
    test::slide(block, "top");
    const auto scene = scene::make_scene({block});
    const auto contact =
        scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0.01, 0}, {0, 1, 0}}, {}, true);
    const auto s = test::solve(scene);
    REQUIRE(s->result().converged);
    for (const auto& node : s->contact(*contact).nodes)
      CHECK(node.pressure == doctest::Approx(0.01 * 210 / (1 - 0.09)).epsilon(1e-11));
  }
}
