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

// Along the line to the centre, as it once was, an approach counts as a slip of the slope times it, and friction as motion that there is none.
TEST_CASE("a rigid ball on a flat part: its normal, and the gap of a gap function; so a deep ball, and one far away") {
  for (const auto family : test::kAllFamilies)
    for (const int dimension : {2, 3})
      for (const double height : {1.0, 0.9, 1.4}) {
        const auto m = dimension == 2 ? test::rectangle(family, 6, 2) : test::box(family, 4, 4, 2);
        const auto& top = m.parts.at("top");
        Point centre{0.5, 0.4, 0}, up{0, 0, 0};
        centre[dimension - 1] = 1 + height, up[dimension - 1] = 1;
        const auto gap = [&](const Point& x) {
          return height - std::sqrt(1 - std::pow(x[0] - centre[0], 2) - (dimension == 2 ? 0 : std::pow(x[1] - centre[1], 2)));
        };
        const auto rows = contact::against(m, top, contact::RigidBall{centre, 1}, {}, true);
        const auto known = contact::against(m, top, contact::RigidGap{up, gap}, {}, true);
        REQUIRE(rows.size() == known.size());
        for (std::size_t k = 0; k < rows.size(); ++k) {
          const Point x = m.point(rows[k].node);
          CHECK(rows[k].normal == up);
          CHECK(rows[k].turn < 1e-9);
          if (std::hypot(x[0] - centre[0], dimension == 2 ? 0 : x[1] - centre[1]) < 0.55)  // whose own nodes, of order 2, are before 0.8 R
            CHECK(rows[k].gap == doctest::Approx(known[k].gap).epsilon(1e-12));
        }
      }
}

TEST_CASE("a rigid ball: the line to its centre where the part has no normal, or one that looks away") {
  for (const auto family : test::kFamilies) {
    const auto m = test::rectangle(family, 6, 6);
    std::vector<mesh::Facet> all;
    for (const auto& [name, facets] : m.parts)
      if (name != "boundary") all.insert(all.end(), facets.begin(), facets.end());
    for (const auto& r : contact::against(m, all, contact::RigidBall{{0.5, 2, 0}, 0.8}, {}, false)) {
      const Point x = m.point(r.node);
      if (x[1] == 1 && x[0] > 0 && x[0] < 1) continue;
      const double distance = std::hypot(x[0] - 0.5, x[1] - 2);
      CHECK(r.gap == doctest::Approx(distance - 0.8));
      CHECK(r.normal[0] == doctest::Approx((0.5 - x[0]) / distance));
      CHECK(r.normal[1] == doctest::Approx((2 - x[1]) / distance));
    }
  }
}

TEST_CASE("a rigid ball on a curved part: the normal of the common tangent plane; in a hollow that of the flatter side") {
  for (const auto family : {Family::p1, Family::q2})
    for (const int dimension : {2, 3}) {
      struct Case {
        double k, slope;  ///< curvature of the part (below 0: bulging), slope of the normal a distance from the axis
      };
      const double radius = 5, K = 1 / radius;
      for (const Case c : {Case{-0.2, 0}, {-0.4, 0}, {0.1, -2 * 0.1 * 0.2 / 0.3}, {0.16, -2 * 0.16 * 0.2 / 0.36}}) {
        for (const int n : {8, 16}) {
          if (dimension == 3 && n > 8) continue;
          auto m = dimension == 2 ? test::rectangle(family, n, 2, -1, -1, 1, 0) : test::box(family, n, n, 2, {-1, -1, -1}, {1, 1, 0});
          mesh::transform(m, [&](Point x) {
            const double square = x[0] * x[0] + (dimension == 2 ? 0 : x[1] * x[1]);
            return x[dimension - 1] += c.k / 2 * square, x;
          });
          Point centre{0, 0, 0};
          centre[dimension - 1] = radius;
          double most = 0;
          for (const auto& r : contact::against(m, m.parts.at("top"), contact::RigidBall{centre, radius}, {}, true)) {
            const Point x = m.point(r.node);
            if (std::abs(x[0]) > 0.6 || (dimension == 3 && std::abs(x[1]) > 0.6)) continue;
            Point n0{c.slope * x[0], dimension == 2 ? 1 : c.slope * x[1], 0};
            if (dimension == 3) n0[2] = 1;
            most = std::max(most, mesh::length(mesh::minus(r.normal, mesh::unit(n0))));
            const double square = x[0] * x[0] + (dimension == 2 ? 0 : x[1] * x[1]);
            const double mean = family == Family::p1 ? 1e-12 : (K - c.k) / 8 * (2.0 / n) * (2.0 / n);  // of order 2: of a parabola's values around x
            CHECK(std::abs(r.gap - (K - c.k) / 2 * square) < 0.01 * square + (dimension - 1) * mean);
          }
          CHECK(most < 0.08 * std::abs(c.k));  // of slopes up to 0.6 (0.85) k; the line to the centre is off by 0.6 K
        }
      }
    }
}

TEST_CASE("the gap along a direction: up to the ball exactly, its sign that of the distance, its derivative by differences") {
  const contact::RigidBall ball{{0.3, -0.2, 0.4}, 0.7};
  for (const double rho : {0.0, 0.3, 0.79, 0.81, 1.1, 3.0})
    for (const double c : {0.05, 0.4, 1.2, 2.0}) {
      const Point n = mesh::unit({0.2, 0.3, 0.9}), across = mesh::unit(mesh::cross(n, {1, 0, 0}));
      const auto at = [&](double out, double far) {
        return mesh::minus(ball.center, mesh::plus(mesh::times(0.7 * far, n), mesh::times(0.7 * out, across)));
      };
      const Point x = at(rho, c);
      const double gap = contact::ball_gap(ball, x, n);
      CHECK((gap > 0) == (std::hypot(rho, c) > 1));
      if (rho < 0.8)
        CHECK(mesh::length(mesh::minus(mesh::plus(x, mesh::times(gap, n)), ball.center)) == doctest::Approx(0.7).epsilon(1e-14));
      const Point v{0.3, -0.8, 0.5}, turned = mesh::times(0.6, across);
      const auto later = [&](double t) {
        return contact::ball_gap(ball, mesh::plus(x, mesh::times(t, v)), mesh::unit(mesh::plus(n, mesh::times(t, turned))));
      };
      const double h = 1e-5;
      CHECK(contact::ball_gap_derivative(ball, x, n, v, turned) == doctest::Approx((later(h) - later(-h)) / (2 * h)).epsilon(1e-7));
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
