#include "shape/derivative/boundary_motion.hpp"

#include <doctest/doctest.h>

#include "../support/scenes.hpp"
#include "base/error.hpp"
#include "shape/design/bspline.hpp"

using namespace dotyk;
using mesh::Point;
using shape::BoundaryMotion;
using shape::bspline_motion;
using shape::ControlPoints;

namespace {

scene::Part side(const std::string& name, mesh::Family family = mesh::Family::q1) {
  return test::part(test::body("block", test::rectangle(family, 8, 4, 1, 2, 5, 4)), name);
}

scene::Part rim(mesh::Family family) { return test::part(test::body("disc", test::disc(family, 5, 3, -1, 2)), "boundary"); }

ControlPoints points(int count, std::optional<Point> direction = {}, int degree = 3) { return {{count, count}, degree, direction}; }

}  // namespace

TEST_CASE("a chain runs with the body on its left, whatever the order of its facets") {
  for (const auto family : test::kFamilies) {
    auto bottom = side("bottom", family);
    std::reverse(bottom.facets.begin(), bottom.facets.end());
    std::swap(bottom.facets[2], bottom.facets[5]);
    const auto chain = shape::chain_of(bottom), top = shape::chain_of(side("top", family)), circle = shape::chain_of(rim(family));
    CHECK_FALSE(chain.closed);
    CHECK(chain.total == doctest::Approx(4));
    REQUIRE(chain.nodes.size() == 9);
    for (int k = 0; k < 9; ++k) CHECK(bottom.body->mesh->node(chain.nodes[k])[0] == doctest::Approx(1 + 0.5 * k));
    for (int k = 0; k < 9; ++k) CHECK(chain.length[k] == doctest::Approx(0.5 * k));
    CHECK(bottom.body->mesh->node(top.nodes.front())[0] == 5);
    CHECK(bottom.body->mesh->node(top.nodes.back())[0] == 1);
    CHECK(circle.closed);
    CHECK(circle.nodes.size() == rim(family).facets.size());
  }
}

TEST_CASE("parts that are no chain are refused, by name") {
  auto two = side("bottom");
  const auto top = test::part(two.body, "top");
  two.facets.insert(two.facets.end(), top.facets.begin(), top.facets.end());
  CHECK_THROWS_WITH_AS(shape::chain_of(two), "'block' bottom falls into 2 pieces; a part that B-splines move must be one chain of edges", InputError);
  auto gap = side("bottom");
  gap.facets.erase(gap.facets.begin() + 3);
  CHECK_THROWS_AS(shape::chain_of(gap), InputError);
  auto twice = side("bottom");
  twice.facets.push_back(twice.facets.front());
  CHECK_THROWS_AS(shape::chain_of(twice), InputError);
  auto ring = test::body("ring", test::without(test::rectangle(mesh::Family::q1, 5, 5), [](const Point& x) { return std::hypot(x[0] - 0.5, x[1] - 0.5) < 0.2; }));
  CHECK_THROWS_WITH_AS(shape::chain_of(scene::chosen_part(ring, "all", [](auto&, auto&) { return true; })),
                       "'ring' all falls into pieces; a part that B-splines move must be one chain of edges", InputError);
}

TEST_CASE("control points moved together move a side as one; the end ones move its ends alone") {
  const auto part = side("bottom");
  const BoundaryMotion m = bspline_motion(part, points(6, Point{0, 2, 0}));
  CHECK(m.variables() == 6);
  REQUIRE(m.nodes.size() == 9);
  const auto chain = shape::chain_of(part);
  for (std::size_t a = 0; a < m.nodes.size(); ++a) {
    Point sum{0, 0, 0};
    for (int v = 0; v < 6; ++v)
      for (int i = 0; i < 3; ++i) sum[i] += m.velocity(a, v)[i];
    CHECK(sum[0] == 0);
    CHECK(sum[1] == doctest::Approx(2));
    const bool first = m.nodes[a] == chain.nodes.front(), last = m.nodes[a] == chain.nodes.back();
    CHECK((m.velocity(a, 0)[1] == doctest::Approx(2)) == first);
    CHECK((m.velocity(a, 5)[1] == doctest::Approx(2)) == last);
  }
}

TEST_CASE("normals point outward: a disc grows, also where its facets begin elsewhere; a corner takes the mean by size") {
  for (const auto family : test::kFamilies) {
    const auto part = rim(family);
    const BoundaryMotion m = bspline_motion(part, points(7));
    for (std::size_t a = 0; a < m.nodes.size(); ++a) {
      const double* x = part.body->mesh->node(m.nodes[a]);
      CHECK(m.weight.row(static_cast<Eigen::Index>(a)).sum() == doctest::Approx(1));
      CHECK(m.direction[a][0] == doctest::Approx((x[0] - 3) / 2).epsilon(1e-6));  // equal facets of a circle: exactly radial
      CHECK(m.direction[a][1] == doctest::Approx((x[1] + 1) / 2).epsilon(1e-6));
    }
  }
  const auto block = side("bottom").body;
  const auto corner = scene::chosen_part(block, "corner", [](const Point& x, const Point&) { return x[1] < 2.01 || x[0] > 4.99; });
  const BoundaryMotion m = bspline_motion(corner, points(4));
  for (std::size_t a = 0; a < m.nodes.size(); ++a)
    if (block->mesh->node(m.nodes[a])[0] == 5 && block->mesh->node(m.nodes[a])[1] == 2) {
      CHECK(m.direction[a][0] == doctest::Approx(std::sqrt(0.5)));
      CHECK(m.direction[a][1] == doctest::Approx(-std::sqrt(0.5)));
    }
}

TEST_CASE("in space the products of B-splines along the two longest extents: a partition of unity, linear along both axes") {
  for (const auto family : test::kFamilies) {
    const auto part = test::part(test::body("box", test::box(family, 4, 6, 3, {0, 0, 0}, {1, 3, 2})), "top");
    ControlPoints p = points(5);
    p.count[1] = 2, p.degree = 1;
    const BoundaryMotion m = bspline_motion(part, p);
    REQUIRE(m.variables() == 10);
    for (std::size_t a = 0; a < m.nodes.size(); ++a) {
      const double* x = part.body->mesh->node(m.nodes[a]);
      double along = 0, across = 0, sum = 0;  // degree 1: control points at 0, ¾, 1½, 2¼, 3 along y; 0 and 1 along x
      for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 5; ++j) {
          const double w = m.velocity(a, j + 5 * k)[2];
          sum += w, along += w * 0.75 * j, across += w * k;
        }
      CHECK(sum == doctest::Approx(1));
      CHECK(along == doctest::Approx(x[1]));
      CHECK(across == doctest::Approx(x[0]));
      CHECK(m.direction[a][2] == doctest::Approx(1));
    }
  }
}

TEST_CASE("tied variables move control points together; bad directions and counts are refused") {
  const auto part = side("bottom");
  const BoundaryMotion all = bspline_motion(part, points(6)), tied = shape::combined(all, shape::symmetric_ties(6));
  CHECK(tied.variables() == 3);
  for (std::size_t a = 0; a < all.nodes.size(); ++a)
    CHECK(tied.velocity(a, 1)[1] == doctest::Approx(all.velocity(a, 1)[1] + all.velocity(a, 4)[1]));
  CHECK_THROWS_AS(shape::combined(all, shape::symmetric_ties(5)), InputError);
  CHECK_THROWS_WITH_AS(bspline_motion(part, points(6, Point{0, 0, 0})),
                       "the direction in which control points of 'block' bottom move is (0, 0); it must be a vector of the plane other than zero", InputError);
  CHECK_THROWS_AS(bspline_motion(part, points(6, Point{0, 0, 1})), InputError);
  CHECK_THROWS_AS(bspline_motion(part, points(3)), InputError);
}
