#include <doctest/doctest.h>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Point;

TEST_CASE("parts: unknown names list the known, empty choices and empty parts are refused") {
  const auto block = test::block("block", 2, mesh::Family::p1, 2);
  CHECK_THROWS_WITH_AS(test::part(block, "topp"),
                       doctest::Contains("'block' has no part 'topp'; it has bottom, left, right, top"), InputError);
  CHECK_THROWS_WITH_AS(scene::chosen_part(block, "none", [](const Point&, const Point&) { return false; }),
                       doctest::Contains("part 'none' of 'block' is empty"), InputError);
  auto m = test::rectangle(mesh::Family::p1, 1, 1);
  m.parts["hole"] = {};
  CHECK_THROWS_AS(test::part(test::body("b", std::move(m)), "hole"), InputError);
}

TEST_CASE("bodies: a material of the other dimension, no cells, an inverted cell") {
  const auto mesh = std::make_shared<const mesh::Mesh>(test::rectangle(mesh::Family::p1, 2, 2));
  const elasticity::MaterialField solid(elasticity::isotropic(1, 0.3, 3, elasticity::Plane::strain));
  CHECK_THROWS_WITH_AS(scene::make_body("b", mesh, solid, {}), doctest::Contains("is for 3-D, its mesh is 2-D"),
                       InputError);
  CHECK_THROWS_AS(test::body("b", mesh::Mesh{}), InputError);
  auto inverted = *mesh;
  std::swap(inverted.cells[0], inverted.cells[1]);
  CHECK_THROWS_WITH_AS(test::body("b", inverted), doctest::Contains("body 'b': cell 1"), InputError);
}

TEST_CASE("scenes: none, twice the same body, equal names, mixed dimensions, parts of other bodies") {
  const auto a = test::block("a", 2, mesh::Family::p1, 2), b = test::block("b", 2, mesh::Family::p1, 2, 1);
  CHECK_THROWS_AS(scene::make_scene({}), InputError);
  CHECK_THROWS_WITH_AS(scene::make_scene({a, a}), doctest::Contains("'a' is given twice"), InputError);
  CHECK_THROWS_WITH_AS(scene::make_scene({a, test::block("a", 2, mesh::Family::p1, 1)}),
                       doctest::Contains("two bodies are named 'a'"), InputError);
  CHECK_THROWS_AS(scene::make_scene({a, test::block("c", 3, mesh::Family::p1, 1)}), InputError);
  const auto scene = scene::make_scene({a});
  CHECK_THROWS_WITH_AS(scene::add_contact(*scene, test::part(a, "top"), test::part(b, "bottom"), {}),
                       doctest::Contains("belongs to 'b', which is not in this scene"), InputError);
  CHECK(scene->contacts.empty());
}

TEST_CASE("the plan says what is free, how much there is, and by what method") {
  const auto block = test::block("block", 2, mesh::Family::p1, 4);
  const auto scene = scene::make_scene({block});
  CHECK(scene::plan(*scene).find("no solution: 'block' is not held: nothing stops its translation along x") != std::string::npos);
  test::fix(block, "top");
  CHECK(scene::plan(*scene).find("one linear solve of 40 unknowns") != std::string::npos);
  scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  CHECK(scene::plan(*scene).find("pdas on 5 condensed rows") != std::string::npos);
  CHECK(scene::describe(*scene).find("contact of 'block' bottom with a rigid plane: 5 rows") != std::string::npos);
}

TEST_CASE("a contact that is not of the scene as solved is refused") {
  const auto block = test::block("block", 2, mesh::Family::p1, 2);
  test::fix(block, "top");
  const auto scene = scene::make_scene({block});
  scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  const auto s = test::solve(scene);
  const auto later =
      scene::add_contact(*scene, test::part(block, "left"), contact::RigidPlane{{-1, 0, 0}, {1, 0, 0}}, {}, false);
  CHECK_NOTHROW(s->contact(*scene->contacts[0]));
  CHECK_THROWS_WITH_AS(s->contact(*later), doctest::Contains("is not part of the scene that was solved"), InputError);
}
