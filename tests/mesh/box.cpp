#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "../support/meshes.hpp"
#include "base/error.hpp"

using namespace dotyk;

TEST_CASE("a box has the nodes, cells and volume it should") {
  for (const auto family : test::kAllFamilies)
    for (int n : {1, 2, 4}) {
      const auto m = test::box(family, n, 2 * n, 3, {-1, 0, 1}, {1, 2, 4});
      const int order = m.topology().order;
      CHECK(m.node_count() == (order * n + 1) * (order * 2 * n + 1) * (order * 3 + 1));
      CHECK(m.cell_count() == n * 2 * n * 3 * (mesh::simplices(family) ? 6 : 1));
      CHECK(test::measure(m) == doctest::Approx(12).epsilon(1e-14));
      for (int c = 0; c < m.cell_count(); ++c) CHECK(test::measure(m, c) == doctest::Approx(12.0 / m.cell_count()));
      CHECK_NOTHROW(mesh::check(m, "box"));
    }
}

TEST_CASE("six tetrahedra share the diagonal of their cell from its least to its greatest corner") {
  const auto m = test::box(mesh::Family::p1, 2, 1, 1, {0, 0, 0}, {2, 1, 1});
  for (int c = 0; c < m.cell_count(); ++c) {
    const double x = c / 6;
    int ends = 0;
    for (int a = 0; a < 4; ++a) {
      const auto p = m.point(m.cell(c)[a]);
      ends += p == mesh::Point{x, 0, 0} || p == mesh::Point{x + 1, 1, 1};
    }
    CHECK(ends == 2);
  }
}

TEST_CASE("meshes conform: every inner facet belongs to two cells, with opposite orientation") {
  std::vector<mesh::Mesh> meshes;
  for (const auto family : test::kAllFamilies) {
    meshes.push_back(test::rectangle(family, 4, 3));
    meshes.push_back(test::box(family, 3, 2, 4));
    for (int cells : {1, 2, 5}) meshes.push_back(test::disc(family, cells));
  }
  for (const auto& m : meshes) {
    std::map<std::vector<int>, std::vector<mesh::Facet>> owners;
    for (int c = 0; c < m.cell_count(); ++c)
      for (int l = 0; l < m.topology().facets; ++l) {
        std::vector<int> key;
        for (int k = 0; k < m.topology().nodes_per_facet; ++k) key.push_back(m.facet_node({c, l}, k));
        std::sort(key.begin(), key.end());
        owners[key].push_back({c, l});
      }
    std::size_t single = 0;
    for (const auto& [key, facets] : owners) {
      REQUIRE(facets.size() <= 2);
      if (facets.size() == 1) {
        ++single;
        continue;
      }
      const auto n = m.facet_area_vector(facets[0]), o = m.facet_area_vector(facets[1]);
      CHECK(std::hypot(n[0] + o[0], n[1] + o[1], n[2] + o[2]) < 1e-14);
    }
    CHECK(mesh::boundary(m).size() == single);
  }
}

TEST_CASE("a box refuses no cells and ends in the wrong order") {
  CHECK_THROWS_WITH_AS(test::box(mesh::Family::p1, 1, 1, 0), "cells along z is 0; it must be at least 1", InputError);
  CHECK_THROWS_AS(test::box(mesh::Family::q1, 1, 1, 1, {0, 0, 0}, {1, -1, 1}), InputError);
}
