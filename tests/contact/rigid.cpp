#include "contact/rigid.hpp"

#include <doctest/doctest.h>

#include "../support/meshes.hpp"
#include "base/error.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;

TEST_CASE("a rigid gap: its own normal and value at every node, one row a node") {
  const auto m = test::rectangle(Family::p1, 4, 2);
  const auto rows = contact::against(
      m, m.parts.at("top"), contact::RigidGap{{0, 1, 0}, [](const Point& x) { return x[0] * x[0] - 0.1; }},
      [](const Point&) { return 2.0; }, false);
  CHECK(rows.size() == 5);
  double weight = 0;
  for (const auto& r : rows) {
    const double x = m.node(r.node)[0];
    CHECK(r.gap == doctest::Approx(x * x + 1.9));
    CHECK(r.partners.empty());
    CHECK(r.normal == Point{0, 1, 0});
    weight += r.weight;
  }
  CHECK(weight == doctest::Approx(1));
  // A negative rigid gap presses in: that is its meaning, not a mistake.
  CHECK_NOTHROW(contact::against(m, m.parts.at("top"), contact::RigidGap{{0, 1, 0}, [](const Point&) { return -0.1; }},
                                 {}, false));
}

TEST_CASE("a rigid plane: the distance to it, the normal towards it") {
  const double s = std::sqrt(0.5);
  for (const auto family : test::kFamilies) {
    const auto m = test::box(family, 2, 2, 2);
    for (const auto& r :
         contact::against(m, m.parts.at("bottom"), contact::RigidPlane{{0, 0, -0.5}, {0, 0, 1}}, {}, false)) {
      CHECK(r.gap == doctest::Approx(0.5));
      CHECK(r.normal == Point{0, 0, -1});
    }
    for (const auto& r :
         contact::against(m, m.parts.at("bottom"), contact::RigidPlane{{-1, 0, 0}, {s, 0, s}}, {}, false)) {
      CHECK(r.gap == doctest::Approx(s * (m.node(r.node)[0] + 1)));
      CHECK(r.normal == Point{-s, 0, -s});
    }
  }
}

TEST_CASE("a rigid ball: the distance along the line to its centre") {
  for (const auto family : test::kFamilies) {
    const auto m = test::rectangle(family, 6, 2);
    for (const auto& r : contact::against(m, m.parts.at("top"), contact::RigidBall{{0.5, 2, 0}, 1}, {}, false)) {
      const Point x = m.point(r.node);
      const double distance = std::hypot(x[0] - 0.5, 1.0);
      CHECK(r.gap == doctest::Approx(distance - 1));
      CHECK(r.normal[0] == doctest::Approx((0.5 - x[0]) / distance));
      CHECK(r.normal[1] == doctest::Approx(1 / distance));
    }
  }
}

TEST_CASE("an obstacle that penetrates at rest is refused with depth and place, unless that is meant") {
  const auto m = test::rectangle(Family::p1, 4, 2);
  const contact::RigidPlane plane{{0, 0.9, 0}, {0, -1, 0}};
  const contact::RigidBall ball{{0.5, 1.5, 0}, 0.75};
  CHECK_THROWS_WITH_AS(contact::against(m, m.parts.at("top"), plane, {}, false),
                       doctest::Contains("the rigid plane penetrates the part by 0.1 at "), InputError);
  CHECK_THROWS_WITH_AS(contact::against(m, m.parts.at("top"), ball, {}, false),
                       doctest::Contains("the rigid ball penetrates the part by 0.25 at (0.5, 1)"), InputError);
  // A normal that points the wrong way puts the body inside the half-space: said so.
  CHECK_THROWS_WITH_AS(contact::against(m, m.parts.at("top"), contact::RigidPlane{{0, 1.2, 0}, {0, 1, 0}}, {}, false),
                       doctest::Contains("its normal must point out of the rigid half-space"), InputError);
  CHECK(contact::against(m, m.parts.at("top"), plane, {}, true).size() == 5);
  CHECK(contact::against(m, m.parts.at("top"), ball, {}, true).size() == 5);
  // Touching is no penetration, rounding included.
  CHECK_NOTHROW(contact::against(m, m.parts.at("top"), contact::RigidPlane{{0, 1 - 1e-12, 0}, {0, -1, 0}}, {}, false));
  CHECK_NOTHROW(contact::against(m, m.parts.at("top"), contact::RigidBall{{0.5, 1.5, 0}, 0.5}, {}, false));
  // An added gap lifts the obstacle out.
  CHECK_NOTHROW(contact::against(
      m, m.parts.at("top"), plane, [](const Point&) { return 0.2; }, false));
}

TEST_CASE("a shape behind the part is refused: its pressure would pull the part outwards") {
  const auto m = test::rectangle(Family::p1, 4, 2);
  const contact::RigidPlane inside{{0, 0.9999, 0}, {0, 1, 0}}, far_behind{{0, -3, 0}, {0, 1, 0}};
  const double s = std::sqrt(0.5);
  for (const bool interference : {false, true})
    for (const auto& plane : {inside, far_behind, contact::RigidPlane{{0, -3, 0}, {s, s, 0}}})
      CHECK_THROWS_WITH_AS(contact::against(m, m.parts.at("top"), plane, {}, interference),
                           doctest::Contains("the rigid plane lies behind the part: at (0, 1)"), InputError);
  // Overlap does not hide it.
  CHECK_THROWS_WITH_AS(contact::against(m, m.parts.at("top"), contact::RigidPlane{{0, 1.2, 0}, {0, 1, 0}}, {}, true),
                       doctest::Contains("lies behind the part"), InputError);
  const auto gap = [](Point normal) { return contact::RigidGap{normal, [](const Point&) { return 0.1; }}; };
  CHECK_THROWS_WITH_AS(contact::against(m, m.parts.at("top"), gap({0, -1, 0}), {}, false),
                       doctest::Contains("the rigid gap lies behind the part: its normal points into the body"), InputError);
  // Sides that the shape is beside, and the whole boundary, which is nearest where it faces the shape, stay.
  CHECK_NOTHROW(contact::against(m, m.parts.at("left"), far_behind, {}, false));
  CHECK_NOTHROW(contact::against(m, m.parts.at("left"), gap({0, 1, 0}), {}, false));
  std::vector<mesh::Facet> all;
  for (const auto& [name, facets] : m.parts) all.insert(all.end(), facets.begin(), facets.end());
  CHECK_NOTHROW(contact::against(m, all, far_behind, {}, false));
  CHECK_NOTHROW(contact::against(m, all, gap({0, -1, 0}), {}, false));
}

TEST_CASE("a corner of the body may touch a plane, though the part that it belongs to faces away") {
  auto m = test::rectangle(Family::p1, 2, 2);
  mesh::transform(m, [](const Point& x) { return Point{x[0] - 0.2 * x[1], x[1], 0}; });  // leans: the left side faces down, the right one up
  const contact::RigidPlane floor{{0, -1, 0}, {0, 1, 0}};
  CHECK_NOTHROW(contact::against(m, m.parts.at("left"), floor, {}, false));
  CHECK_NOTHROW(contact::against(m, m.parts.at("right"), floor, {}, false));
}

TEST_CASE("a ball whose centre lies on the part, and gaps that are no numbers, are refused") {
  const auto m = test::rectangle(Family::p1, 4, 2);
  CHECK_THROWS_AS(contact::against(m, m.parts.at("top"), contact::RigidBall{{0.5, 1, 0}, 0.1}, {}, true), InputError);
  CHECK_THROWS_WITH_AS(
      contact::against(m, m.parts.at("top"), contact::RigidGap{{0, 1, 0}, [](const Point&) { return NAN; }}, {}, false),
      doctest::Contains("the gap is nan at (0, 1)"), InputError);
}
