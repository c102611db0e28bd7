#include <doctest/doctest.h>

#include "../support/elastic.hpp"
#include "algebra/dense/decompositions.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

Point linear_displacement(const Point& x) {
  return {0.3 * x[0] - 0.2 * x[1] + 0.5 * x[2], 0.1 * x[0] + 0.7 * x[1] - 0.4 * x[2],
          -0.6 * x[0] + 0.2 * x[1] + 0.9 * x[2]};
}

}  // namespace

TEST_CASE("patch test: a linear displacement on the boundary is reproduced inside, on distorted meshes") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      auto m = test::unit(dim, family, dim == 2 ? 6 : 3);
      test::distort(m, dim == 2 ? 0.04 : 0.06);
      const auto numbering = test::prescribe(
          m, [&](const Point& x, int) { return test::on_boundary(x, dim); }, linear_displacement);
      const auto material = test::steel(dim);
      const auto system = test::system_of(m, material, {}, {}, numbering);
      const auto u = test::solve(system, numbering), exact = test::nodal(m, linear_displacement);
      CHECK(test::largest_difference(u, exact) < 1e-12);
      // The stress is constant: the same in every cell.
      const auto stress = elasticity::cell_stress(m, material, u);
      for (const auto& s : stress)
        for (int v = 0; v < 6; ++v) CHECK(std::abs(s[v] - stress[0][v]) < 1e-12 * 210);
      // No force is needed at inner nodes.
      const auto force = elasticity::internal_force(m, material, {}, u);
      for (int n = 0; n < m.node_count(); ++n)
        if (!test::on_boundary(m.point(n), dim))
          for (int i = 0; i < dim; ++i) CHECK(std::abs(force[n * dim + i]) < 1e-12 * 210);
    }
}

TEST_CASE("patch test with tractions: the stress vector of a constant stress on all sides") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      auto m = test::unit(dim, family, dim == 2 ? 5 : 3);
      test::distort(m, 0.03);
      const auto material = test::steel(dim);
      const auto exact = test::nodal(m, linear_displacement);
      const auto s = elasticity::cell_stress(m, material, exact)[0];
      const double sigma[3][3] = {{s[0], s[5], s[4]}, {s[5], s[1], s[3]}, {s[4], s[3], s[2]}};
      std::vector<double> force(m.coordinates.size(), 0);
      for (const auto& [name, facets] : m.parts) {
        Point n = m.facet_area_vector(facets[0]);
        const double area = test::length(n);
        for (double& v : n) v /= area;
        test::add_traction(
            m, facets,
            [&](const Point&) {
              Point t{0, 0, 0};
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j) t[i] += sigma[i][j] * n[j];
              return t;
            },
            force);
      }
      CHECK(test::largest_difference(elasticity::internal_force(m, material, {}, exact), force) < 1e-12 * 210);
    }
}

TEST_CASE("the numbers of the stiffness: symmetric, rigid motions free, positive otherwise") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies) {
      auto m = test::unit(dim, family, 2);
      test::distort(m, 0.1);
      const auto free = test::all_free(m);
      const algebra::DenseMatrix K = test::full(elasticity::assemble(m, test::steel(dim), {}, free));
      const Eigen::VectorXd e = algebra::eigenvalues(K);
      const int rigid = dim == 2 ? 3 : 6;
      CHECK(e.head(rigid).cwiseAbs().maxCoeff() < 1e-12 * e.maxCoeff());
      CHECK(e[rigid] > 1e-4 * e.maxCoeff());
      // internal_force is the same operator.
      test::Random random(201);
      const algebra::Vector u = random.vector(static_cast<int>(K.rows()));
      const auto force = elasticity::internal_force(m, test::steel(dim), {}, {u.begin(), u.end()});
      CHECK((Eigen::Map<const algebra::Vector>(force.data(), u.size()) - K * u).norm() < 1e-13 * K.norm() * u.norm());
    }
}

TEST_CASE("the stiffness by λ and μ is that of the general formula") {
  for (int dim : {2, 3})
    for (const auto family : test::kAllFamilies)
      for (const auto plane : {elasticity::Plane::strain, elasticity::Plane::stress})
        for (const double nu : {-0.5, 0.0, 0.3, 0.49}) {
          auto m = test::unit(dim, family, 2);
          test::distort(m, 0.1);
          const auto free = test::all_free(m);
          elasticity::Hooke hooke = elasticity::isotropic(210, nu, dim, plane);
          REQUIRE(hooke.isotropic);
          const auto K = elasticity::assemble(m, test::MaterialField(hooke), {}, free);
          hooke.isotropic = false;
          CHECK((elasticity::assemble(m, test::MaterialField(hooke), {}, free) - K).norm() < 1e-14 * K.norm());
        }
}
