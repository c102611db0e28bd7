#include <doctest/doctest.h>

#include <numeric>

#include "../support/elastic.hpp"
#include "elasticity/error_estimate.hpp"

using namespace dotyk;
using elasticity::Stress;
using mesh::Point;

namespace {

Stress linear_stress(const Point& x) {
  Stress s;
  for (int v = 0; v < 6; ++v) s[v] = v - 2 + (1 + v) * x[0] - 3 * x[1] + 0.5 * v * x[2];
  return s;
}

/// Greatest error of the recovered nodal stress from centre values of a linear field.
double error(const mesh::Mesh& m) {
  std::vector<Stress> at_centres;
  for (int c = 0; c < m.cell_count(); ++c) at_centres.push_back(linear_stress(m.cell_centre(c)));
  const auto recovered = elasticity::recover_stress(m, at_centres);
  double worst = 0;
  for (int n = 0; n < m.node_count(); ++n)
    for (int v = 0; v < 6; ++v) worst = std::max(worst, std::abs(recovered[n][v] - linear_stress(m.point(n))[v]));
  return worst;
}

}  // namespace

TEST_CASE("recovery reproduces linear stress at every node, the boundary's included") {
  for (const auto family : test::kFamilies) {
    for (int dim : {2, 3}) {
      auto m = test::unit(dim, family, dim == 2 ? 6 : 4);
      CHECK(error(m) < 1e-12);
      test::distort(m, 0.04);
      CHECK(error(m) < 1e-12);
    }
    CHECK(error(test::disc(family, 4)) < 1e-12);
    CHECK(error(test::rectangle(family, 2, 2)) < 1e-12);
    CHECK(error(test::box(family, 2, 2, 2)) < 1e-12);
  }
}

TEST_CASE("recovery reproduces linear stress on meshes of slender cells") {
  for (const auto family : test::kFamilies)
    for (double thin : {0.1, 1e-2, 1e-4}) {
      CHECK(error(test::rectangle(family, 6, 6, 0, 0, 1, thin)) < 1e-11);
      CHECK(error(test::box(family, 4, 4, 4, {0, 0, 0}, {1, thin, 1})) < 1e-11);
    }
}

TEST_CASE("recovery does not depend on the unit of length or the place") {
  for (const auto family : test::kFamilies)
    for (double size : {1e-6, 1e6}) {
      const auto m = test::rectangle(family, 5, 5, 3 * size, 0, 4 * size, size);
      std::vector<Stress> at_centres;
      for (int c = 0; c < m.cell_count(); ++c) {
        const Point x = m.cell_centre(c);
        at_centres.push_back(linear_stress({x[0] / size, x[1] / size, 0}));
      }
      const auto recovered = elasticity::recover_stress(m, at_centres);
      for (int n = 0; n < m.node_count(); ++n)
        CHECK(std::abs(recovered[n][0] - linear_stress({m.node(n)[0] / size, m.node(n)[1] / size, 0})[0]) < 1e-11);
    }
}

TEST_CASE("a single cell, and one row of cells, recover at least a constant stress") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const auto& m :
           {test::unit(dim, family, 1), dim == 2 ? test::rectangle(family, 5, 1) : test::box(family, 5, 1, 1)}) {
        const Stress one{1, 2, 3, 4, 5, 6};
        const auto recovered = elasticity::recover_stress(m, std::vector<Stress>(m.cell_count(), one));
        for (const auto& s : recovered)
          for (int v = 0; v < 6; ++v) CHECK(s[v] == doctest::Approx(one[v]));
      }
}

TEST_CASE("the error estimate of a linear displacement is zero") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      auto m = test::unit(dim, family, 3);
      test::distort(m, 0.04);
      const auto material = test::steel(dim);
      const auto u = test::nodal(m, [](const Point& x) { return Point{x[0] + 2 * x[1], x[1] - x[2], 3 * x[0]}; });
      const auto e = elasticity::estimate_error(m, material, u, {}, {});
      const double whole = std::reduce(e.solution.begin(), e.solution.end());
      for (const auto& cell : e.cells) CHECK(cell.sum() < 1e-22 * whole);
      CHECK(whole > 0);
    }
}
