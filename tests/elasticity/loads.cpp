#include <doctest/doctest.h>

#include "../support/elastic.hpp"
#include "elasticity/load.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

/// Σ nodal force · u(x), the work of a load on a displacement that the elements contain.
double work(const mesh::Mesh& m, const std::vector<double>& force, const elasticity::VectorField& u) {
  double sum = 0;
  for (int n = 0; n < m.node_count(); ++n)
    for (int i = 0; i < m.dimension(); ++i) sum += force[n * m.dimension() + i] * u(m.point(n))[i];
  return sum;
}

Point tilt(const Point& x) { return {0, x[0], 0}; }
Point shift(const Point&) { return {0, 1, 0}; }

}  // namespace

TEST_CASE("a body force that is linear does exact work on linear displacements") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      auto m = test::unit(dim, family, 3);
      if (mesh::simplices(family)) test::distort(m, 0.05);
      std::vector<double> force(m.coordinates.size(), 0);
      elasticity::add_body_force(
          m,
          [](const Point& x) {
            return Point{7, 2 + 3 * x[0], 1};
          },
          force);
      CHECK(work(m, force, shift) == doctest::Approx(3.5).epsilon(1e-13));  // 2 + 3/2
      CHECK(work(m, force, tilt) == doctest::Approx(2.0).epsilon(1e-13));   // 2/2 + 3/3
      CHECK(work(m, force, [](const Point& x) { return Point{x[1], 0, 0}; }) == doctest::Approx(3.5).epsilon(1e-13));
    }
}

TEST_CASE("tractions that are linear do exact work on linear displacements") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      const auto m = test::unit(dim, family, 3);
      std::vector<double> force(m.coordinates.size(), 0);
      test::add_traction(
          m, m.parts.at("top"),
          [](const Point& x) {
            return Point{0, 2 + 3 * x[0], 0};
          },
          force);
      CHECK(work(m, force, shift) == doctest::Approx(3.5).epsilon(1e-13));
      CHECK(work(m, force, tilt) == doctest::Approx(2.0).epsilon(1e-13));
      for (int n = 0; n < m.node_count(); ++n)
        if (m.node(n)[dim - 1] < 1) CHECK(force[n * dim + 1] == 0);
    }
}

TEST_CASE("pressure pushes inwards; on a closed boundary it balances, and its virial is −dim·p·volume") {
  std::vector<mesh::Mesh> meshes;
  for (const auto family : test::kAllFamilies) {
    meshes.push_back(test::disc(family, 5, 1, 2, 0.7));
    for (int dim : {2, 3}) {
      meshes.push_back(test::unit(dim, family, 3));
      test::distort(meshes.back(), 0.05);
      mesh::transform(meshes.back(), [](const Point& x) {
        return Point{x[0] + 0.3 * x[1], x[1] - 0.2 * x[2], x[2] + 0.1 * x[0]};
      });
    }
  }
  for (const auto& m : meshes) {
    const int dim = m.dimension();
    std::vector<double> force(m.coordinates.size(), 0);
    test::add_pressure(
        m, mesh::boundary(m), 2, force);
    for (int i = 0; i < dim; ++i) {
      double sum = 0, virial = 0;
      for (int n = 0; n < m.node_count(); ++n) {
        sum += force[n * dim + i];
        virial += force[n * dim + i] * m.node(n)[i];
      }
      CHECK(std::abs(sum) < 1e-13);
      const double volume = m.topology().order == 1 ? test::measure(m) : test::integral(m, [](const auto&) { return 1.0; });
      CHECK(virial == doctest::Approx(-2 * volume).epsilon(1e-12));
    }
  }
}

TEST_CASE("facet points: weights sum to the measure, normals point outwards") {
  for (const auto family : test::kFamilies) {
    const auto m = test::disc(family, 3);
    for (const auto f : m.parts.at("boundary")) {
      double sum = 0;
      elasticity::for_each_facet_point(m, f, [&](const elasticity::FacetPoint& p) {
        sum += p.measure;
        CHECK(p.x[0] * p.normal[0] + p.x[1] * p.normal[1] > 0);
        CHECK(test::length(p.normal) == doctest::Approx(1));
      });
      CHECK(sum == doctest::Approx(test::length(m.facet_area_vector(f))));
    }
  }
}
