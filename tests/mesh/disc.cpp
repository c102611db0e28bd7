#include <doctest/doctest.h>

#include "../support/meshes.hpp"
#include "base/error.hpp"

using namespace dotyk;
using std::numbers::pi;

TEST_CASE("a disc is valid for every number of cells, its boundary on the circle and closed") {
  for (const auto family : test::kFamilies)
    for (int cells = 1; cells <= 12; ++cells) {
      const auto m = test::disc(family, cells, 3, -2, 0.5);
      CHECK_NOTHROW(mesh::check(m, "disc"));
      for (int c = 0; c < m.cell_count(); ++c) CHECK(mesh::least_jacobian(m, c) > 0);
      const auto& part = m.parts.at("boundary");
      CHECK(static_cast<int>(part.size()) == (family == mesh::Family::p1 ? 6 : 4) * cells);
      CHECK(part.size() == mesh::boundary(m).size());
      mesh::Point sum{0, 0, 0};
      for (const auto f : part) {
        for (int k = 0; k < 2; ++k) {
          const double* p = m.node(m.facet_node(f, k));
          CHECK(std::abs(std::hypot(p[0] - 3, p[1] + 2) - 0.5) < 1e-15);
        }
        const auto n = m.facet_area_vector(f), x = m.facet_centre(f);
        CHECK(n[0] * (x[0] - 3) + n[1] * (x[1] + 2) > 0);  // outward
        for (int i = 0; i < 2; ++i) sum[i] += n[i];
      }
      CHECK(test::length(sum) < 1e-15);
    }
}

TEST_CASE("the area of a disc tends to πr² with order 2") {
  for (const auto family : test::kFamilies) {
    const auto error = [&](int cells) { return 4 * pi - test::measure(test::disc(family, cells, 1, 1, 2)); };
    for (int cells : {4, 8, 16}) {
      const double order = std::log2(error(cells) / error(2 * cells));
      CHECK(order > 1.95);  // 2 in the limit: n edges of a circle miss 2π³r²/3n² of it
      CHECK(order < 2.05);
    }
  }
}

TEST_CASE("cells of a disc stay well shaped") {
  // Least angle measure: the Jacobian against the square of the longest edge, no worse for finer meshes.
  for (const auto family : test::kFamilies)
    for (int cells : {2, 6, 12, 40}) {
      const auto m = test::disc(family, cells);
      double worst = 1;
      for (int c = 0; c < m.cell_count(); ++c) {
        double h = 0;
        for (int l = 0; l < m.topology().facets; ++l) h = std::max(h, test::length(m.facet_area_vector({c, l})));
        worst = std::min(worst, mesh::least_jacobian(m, c) / (h * h));
      }
      CHECK(worst > 0.2);
    }
}

TEST_CASE("P1 discs of an even number of cells have a node at the lowest point; all are symmetric about the vertical") {
  for (int cells : {1, 4, 5}) {
    const auto m = test::disc(mesh::Family::p1, cells);
    bool lowest = false;
    for (int i = 0; i < m.node_count(); ++i) {
      const double* p = m.node(i);
      lowest = lowest || std::hypot(p[0], p[1] + 1) < 1e-15;
      bool mirrored = false;
      for (int j = 0; j < m.node_count(); ++j)
        mirrored = mirrored || std::hypot(m.node(j)[0] + p[0], m.node(j)[1] - p[1]) < 1e-14;
      CHECK(mirrored);
    }
    CHECK(lowest == (cells % 2 == 0));
  }
}

TEST_CASE("a disc refuses no cells and a radius that is not positive") {
  CHECK_THROWS_WITH_AS(test::disc(mesh::Family::p1, 0), "cells is 0; it must be at least 1", InputError);
  CHECK_THROWS_AS(test::disc(mesh::Family::q1, 3, 0, 0, 0), InputError);
  CHECK_THROWS_AS(test::disc(mesh::Family::q1, 3, 0, 0, -1), InputError);
  CHECK_THROWS_AS(test::disc(mesh::Family::q1, 3, 0, 0, NAN), InputError);
}
