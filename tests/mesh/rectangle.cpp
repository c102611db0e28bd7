#include <doctest/doctest.h>

#include "../support/meshes.hpp"
#include "base/error.hpp"

using namespace dotyk;

TEST_CASE("a rectangle has the nodes, cells and area it should") {
  for (const auto family : test::kAllFamilies)
    for (int nx : {1, 3, 8})
      for (int ny : {1, 5}) {
        const auto m = test::rectangle(family, nx, ny, -1, 2, 3, 5);
        const int order = m.topology().order;
        CHECK(m.node_count() == (order * nx + 1) * (order * ny + 1));
        CHECK(m.cell_count() == nx * ny * (mesh::simplices(family) ? 2 : 1));
        CHECK(test::measure(m) == doctest::Approx(12).epsilon(1e-14));
        for (int c = 0; c < m.cell_count(); ++c) CHECK(test::measure(m, c) == doctest::Approx(12.0 / m.cell_count()));
        CHECK_NOTHROW(mesh::check(m, "rectangle"));
        CHECK(m.size() == 4);
      }
}

TEST_CASE("P1 cells of a rectangle are cut from lower left to upper right") {
  const auto m = test::rectangle(mesh::Family::p1, 3, 2, 0, 0, 3, 2);
  for (int k = 0; k < 6; ++k) {
    // Both triangles of a cell own the corners (i, j) and (i + 1, j + 1).
    const double x = k % 3, y = k / 3;
    for (int c : {2 * k, 2 * k + 1}) {
      bool low = false, high = false;
      for (int a = 0; a < 3; ++a) {
        const double* p = m.node(m.cell(c)[a]);
        low = low || (p[0] == x && p[1] == y);
        high = high || (p[0] == x + 1 && p[1] == y + 1);
      }
      CHECK(low);
      CHECK(high);
    }
  }
}

TEST_CASE("the ends of a rectangle are where they were asked, to the last bit") {
  const auto m = test::rectangle(mesh::Family::q1, 7, 3, 0.1, 0.3, 0.7, 0.9);
  CHECK(m.node(0)[0] == 0.1);
  CHECK(m.node(m.node_count() - 1)[0] == 0.7);
  CHECK(m.node(m.node_count() - 1)[1] == 0.9);
}

TEST_CASE("a rectangle refuses no cells and ends in the wrong order") {
  CHECK_THROWS_WITH_AS(test::rectangle(mesh::Family::p1, 0, 2), "cells along x is 0; it must be at least 1",
                       InputError);
  CHECK_THROWS_WITH_AS(test::rectangle(mesh::Family::q1, 2, -1), "cells along y is -1; it must be at least 1",
                       InputError);
  CHECK_THROWS_WITH_AS(test::rectangle(mesh::Family::p1, 2, 2, 0, 1, 1, 1),
                       "'to' must exceed 'from' along y (from 1 to 1)", InputError);
  CHECK_THROWS_AS(test::rectangle(mesh::Family::p1, 2, 2, 2, 0, 1, 1), InputError);
  CHECK_THROWS_AS(test::rectangle(mesh::Family::p1, 2, 2, NAN, 0, 1, 1), InputError);
  CHECK_THROWS_AS(test::rectangle(mesh::Family::p1, 2, 2, 0, 0, INFINITY, 1), InputError);
}
