#include <doctest/doctest.h>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;
using test::part;

TEST_CASE("supports that contradict each other at a node are refused, naming both parts") {
  const auto contradict = [] {
    const auto block = test::block("block", 2, mesh::Family::p1, 2);
    auto left = part(block, "left"), bottom = part(block, "bottom");
    scene::fix(left, {true, true, true});
    scene::displace(bottom, {nullptr, [](const Point&) { return 0.1; }, nullptr});
    test::solve(scene::make_scene({block}));
  };
  CHECK_THROWS_WITH_AS(contradict(), doctest::Contains("contradictory supports on 'block': at the node (0, 0)"),
                       InputError);
  CHECK_THROWS_WITH_AS(contradict(), doctest::Contains("'left' prescribes uy = 0 and part 'bottom' prescribes 0.1"),
                       InputError);
}

TEST_CASE("supports that agree where they meet are fine") {
  const auto block = test::block("block", 2, mesh::Family::p1, 2);
  auto left = part(block, "left"), bottom = part(block, "bottom");
  scene::displace(left, {[](const Point& x) { return x[1]; }, nullptr, nullptr});
  scene::fix(bottom, {true, true, false});
  CHECK_NOTHROW(test::solve(scene::make_scene({block})));
}

TEST_CASE("a slide along no axis contradicts a prescribed displacement off its side") {
  const auto contradict = [] {
    auto m = test::rectangle(mesh::Family::p1, 2, 2);
    mesh::transform(m, [](const Point& x) { return Point{x[0] + 0.5 * x[1], x[1], 0}; });
    const auto block = test::body("wedge", std::move(m));
    auto left = part(block, "left"), bottom = part(block, "bottom");
    scene::displace(bottom, {[](const Point&) { return 0.1; }, [](const Point&) { return 0.0; }, nullptr});
    scene::slide(left);
    test::solve(scene::make_scene({block}));
  };
  CHECK_THROWS_WITH_AS(contradict(), doctest::Contains("contradictory supports on 'wedge'"), InputError);
}

TEST_CASE("a slide leaves motion along the side free and stops motion across it") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto block = test::block("block", dim, family, 2);
      test::slide(block, "left");
      const auto numbering = scene::number(*block);
      for (int n = 0; n < block->mesh->node_count(); ++n)
        for (int i = 0; i < dim; ++i)
          CHECK((numbering.unknown[n * dim + i] < 0) == (i == 0 && block->mesh->node(n)[0] == 0));
    }
}

TEST_CASE("a slide over an edge holds both normals at it") {
  const auto block = test::block("block", 2, mesh::Family::p1, 2);
  auto corner =
      scene::chosen_part(block, "corner", [](const Point& x, const Point&) { return x[0] == 0 || x[1] == 0; });
  scene::slide(corner);
  const auto numbering = scene::number(*block);
  CHECK(numbering.unknown[0] < 0);
  CHECK(numbering.unknown[1] < 0);
  CHECK(block->slides.empty());
}

TEST_CASE("a slide on a circle lets it turn but not move") {
  const auto disc = test::body("disc", test::disc(mesh::Family::p1, 4));
  test::slide(disc, "boundary");
  test::pull(disc, "boundary", [](const Point& x) { return Point{-x[1], x[0], 0}; });  // a torque
  CHECK_THROWS_WITH_AS(test::solve(scene::make_scene({disc})), doctest::Contains("'disc': rotation about (0, 0)"),
                       InputError);
}

TEST_CASE("a load function that throws leaves the body as it was") {
  const auto block = test::block("block", 2, mesh::Family::p1, 3);
  test::press(block, "top", 1);
  const auto before = block->force;
  auto right = part(block, "right");
  int calls = 0;
  const auto bad = [&](const Point&) -> Point {
    if (++calls == 4) throw std::runtime_error("user's");
    return {1, 1, 0};
  };
  CHECK_THROWS(scene::load(right, bad));
  CHECK(block->force == before);
  CHECK(scene::load_arrows(*block).size() == 3);
}

TEST_CASE("springs refuse negative stiffness with its place, and take none where there is none") {
  const auto block = test::block("block", 2, mesh::Family::p1, 2);
  auto right = part(block, "right");
  CHECK_THROWS_WITH_AS(scene::spring(right, {[](const Point&) { return -1.0; }, nullptr, nullptr}),
                       doctest::Contains("stiffness is -1 at (1, "), InputError);
  CHECK(block->springs.empty());
}
