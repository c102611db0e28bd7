#include "elasticity/interpolation.hpp"

#include <doctest/doctest.h>

#include "../support/elastic.hpp"

using namespace dotyk;
using mesh::Point;

TEST_CASE("shape functions at a point: a partition of unity that reproduces the point") {
  test::Random random(231);
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      auto m = test::unit(dim, family, 3);
      test::distort(m, 0.08);
      const int nodes = m.topology().nodes;
      for (int c = 0; c < m.cell_count(); ++c) {
        // A random point inside: a convex combination of the corners.
        Point x{0, 0, 0};
        double weight[8], sum = 0;
        const int corners = m.topology().corners;
        for (int a = 0; a < corners; ++a) sum += weight[a] = random.between(0.05, 1);
        for (int a = 0; a < corners; ++a)
          for (int i = 0; i < dim; ++i) x[i] += weight[a] / sum * m.node(m.cell(c)[a])[i];
        std::array<double, mesh::kMostNodes> shape;
        REQUIRE(elasticity::shape_at(m, c, x, 1e-9, shape));
        Point y{0, 0, 0};
        double one = 0;
        for (int a = 0; a < nodes; ++a) {
          one += shape[a];
          if (m.topology().order == 1) CHECK(shape[a] > -1e-9);
          for (int i = 0; i < dim; ++i) y[i] += shape[a] * m.node(m.cell(c)[a])[i];
        }
        CHECK(one == doctest::Approx(1).epsilon(1e-14));
        CHECK(test::length({x[0] - y[0], x[1] - y[1], x[2] - y[2]}) < 1e-13);
        // At a node it is that node's own function.
        REQUIRE(elasticity::shape_at(m, c, m.point(m.cell(c)[1]), 1e-9, shape));
        CHECK(shape[1] == doctest::Approx(1).epsilon(1e-12));
        // Far outside it is refused.
        CHECK_FALSE(elasticity::shape_at(m, c, {x[0] + 2, x[1], x[2]}, 1e-6, shape));
        CHECK_FALSE(elasticity::shape_at(m, c, {x[0] + 1e6, x[1], x[2]}, 1e-6, shape));
      }
    }
}

TEST_CASE("slack lets a point a little outside through") {
  const auto m = test::rectangle(mesh::Family::q1, 1, 1);
  std::array<double, mesh::kMostNodes> shape;
  CHECK(elasticity::shape_at(m, 0, {1 + 1e-8, 0.5, 0}, 1e-6, shape));
  CHECK_FALSE(elasticity::shape_at(m, 0, {1 + 1e-5, 0.5, 0}, 1e-6, shape));
}
