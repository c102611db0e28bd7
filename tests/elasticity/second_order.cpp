// Cells of order 2: what they reproduce, at which order they converge, curved sides.
#include <doctest/doctest.h>

#include "../support/elastic.hpp"
#include "../support/random.hpp"
#include "algebra/dense/quadrature.hpp"
#include "elasticity/interpolation.hpp"
#include "elasticity/kernel.hpp"
#include "moduli.hpp"

using namespace dotyk;
using mesh::Facet;
using mesh::Mesh;
using mesh::Point;
using std::numbers::pi;
using test::kE;
using test::kLambda;
using test::kMu;
using test::kNu;

namespace {

/// u_i = x·A_i x/2 + b_i·x, A_i symmetric.
struct Quadratic {
  double A[3][3][3] = {{{0.4, 0.2, -0.1}, {0.2, -0.6, 0.3}, {-0.1, 0.3, 0.5}},
                       {{-0.3, 0.1, 0.2}, {0.1, 0.8, -0.2}, {0.2, -0.2, 0.1}},
                       {{0.7, -0.4, 0.3}, {-0.4, 0.2, 0.1}, {0.3, 0.1, -0.9}}};
  double b[3][3] = {{0.3, -0.2, 0.5}, {0.1, 0.7, -0.4}, {-0.6, 0.2, 0.9}};
  int dim;

  double slope(int i, int k, const Point& x) const {
    double g = b[i][k];
    for (int l = 0; l < dim; ++l) g += A[i][k][l] * x[l];
    return g;
  }
  Point operator()(const Point& x) const {
    Point u{0, 0, 0};
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k) u[i] += (slope(i, k, x) + b[i][k]) * x[k] / 2;
    return u;
  }
  double sigma(int i, int j, const Point& x, double mu, double lambda) const {
    double trace = 0;
    for (int k = 0; k < dim; ++k) trace += slope(k, k, x);
    return mu * (slope(i, j, x) + slope(j, i, x)) + (i == j ? lambda * trace : 0);
  }
  Point force(double mu, double lambda) const {  // −div σ, constant
    Point f{0, 0, 0};
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) f[i] -= (lambda + mu) * A[j][i][j] + mu * A[i][j][j];
    return f;
  }
};

/// The displacement at a point of a cell.
Point value(const Mesh& m, const std::vector<double>& u, int cell, const Point& x) {
  std::array<double, mesh::kMostNodes> shape;
  REQUIRE(elasticity::shape_at(m, cell, x, 1e-9, shape));
  Point sum{0, 0, 0};
  for (int a = 0; a < m.topology().nodes; ++a)
    for (int i = 0; i < m.dimension(); ++i) sum[i] += shape[a] * u[m.cell(cell)[a] * m.dimension() + i];
  return sum;
}

}  // namespace

TEST_CASE("a quadratic displacement is reproduced exactly on straight cells, and its linear stress at every node") {
  for (int dim : {2, 3})
    for (const auto family : test::kSecondOrder)
      for (const bool tractions : {false, true}) {
        CAPTURE(dim);
        CAPTURE(test::name(family));
        auto m = test::unit(dim, family, dim == 2 ? 4 : 2);
        test::distort(m, 0.04);
        const Quadratic u{.dim = dim};
        std::vector<double> force(m.coordinates.size(), 0);
        elasticity::add_body_force(m, [&](const Point&) { return u.force(kMu, kLambda); }, force);
        if (tractions)
          elasticity::add_traction(m, m.parts.at("right"), [&](const elasticity::FacetPoint& p) {
            Point t{0, 0, 0};
            for (int i = 0; i < dim; ++i)
              for (int j = 0; j < dim; ++j) t[i] += u.sigma(i, j, p.x, kMu, kLambda) * p.normal[j];
            return t;
          }, force);
        const auto given = [&](const Point& x, int) {
          return test::on_boundary(tractions ? Point{std::min(x[0], 0.5), x[1], x[2]} : x, dim);  // but inside the right side
        };
        const auto numbering = test::prescribe(m, given, u);
        const auto material = test::steel(dim, kE, kNu);
        const auto solved = test::solve(test::system_of(m, material, {}, force, numbering), numbering);
        CHECK(test::largest_difference(solved, test::nodal(m, u)) < 1e-12);
        const auto stress = elasticity::nodal_stress(m, material, solved);
        for (int n = 0; n < m.node_count(); ++n) {
          const Point x = m.point(n);
          const auto at = [&](int i, int j) { return u.sigma(i, j, x, kMu, kLambda); };
          const elasticity::Stress exact = dim == 2 ? elasticity::Stress{at(0, 0), at(1, 1), kNu * (at(0, 0) + at(1, 1)), 0, 0, at(0, 1)}
                                                    : elasticity::Stress{at(0, 0), at(1, 1), at(2, 2), at(1, 2), at(0, 2), at(0, 1)};
          for (int v = 0; v < 6; ++v) CHECK(std::abs(stress[n][v] - exact[v]) < 1e-11);
        }
      }
}

TEST_CASE("curved cells pass the patch test") {
  const auto linear = [](const Point& x) {
    return Point{0.3 * x[0] - 0.2 * x[1] + 0.5 * x[2], 0.1 * x[0] + 0.7 * x[1] - 0.4 * x[2], -0.6 * x[0] + 0.2 * x[1] + 0.9 * x[2]};
  };
  for (const auto& [dim, family, n] : {std::tuple{2, mesh::Family::p2, 4}, {2, mesh::Family::q2, 4}, {3, mesh::Family::p2, 4},
                                       {3, mesh::Family::q2, 2}}) {
    auto m = test::unit(dim, family, n);
    test::curve(m, 0.03);
    const auto numbering = test::prescribe(m, [&](const Point& x, int) { return test::on_boundary(x, dim); }, linear);
    const auto u = test::solve_sparse(test::system_of(m, test::steel(dim), {}, {}, numbering), numbering);
    CAPTURE(dim);
    CAPTURE(test::name(family));
    CHECK(test::largest_difference(u, test::nodal(m, linear)) < 1e-12);
  }
}

namespace {

/// The greatest difference of the nodal forces of a random displacement of a cell, an edge or face of which lies on a circle
/// or sphere of radius 1 and spans an angle, from those by 20 Gauss points an axis; relative.
template <class E>
double error_of_nodal_forces(mesh::Element element, double angle) {
  Mesh m;
  m.element = element;
  std::vector<double> u;
  test::Random random(71);
  for (int a = 0; a < E::nodes; ++a) {
    const auto at = E::node(a);
    double fraction[3] = {0, 0, 0};
    for (int i = 0; i < E::dim; ++i) fraction[i] = E::simplex ? at[i] : (at[i] + 1) / 2;
    const double r = 1 + angle * fraction[1], s = angle * fraction[0], t = angle * fraction[2];
    const Point x{r * std::cos(s) * std::cos(t), r * std::sin(s) * std::cos(t), r * std::sin(t)};
    m.coordinates.insert(m.coordinates.end(), x.begin(), x.begin() + E::dim);
    m.cells.push_back(a);
    for (int i = 0; i < E::dim; ++i) u.push_back(random.between(-1, 1));
  }
  const auto material = test::steel(E::dim);
  const auto forces = elasticity::internal_force(m, material, {}, u);
  double x[E::nodes][E::dim];
  elasticity::cell_coordinates<E>(m, 0, x);
  std::vector<double> exact(u.size(), 0);
  const auto line = algebra::gauss(20);
  const int count = E::dim == 2 ? 400 : 8000;
  for (int q = 0; q < count; ++q) {
    typename E::Point xi;
    double weight = 1, left = 1;  // Duffy's collapsed coordinates of simplices
    for (int i = 0, k = q; i < E::dim; ++i, k /= 20) {
      const double s = line.points[k % 20];
      xi[i] = E::simplex ? left * s : 2 * s - 1;
      weight *= E::simplex ? left * line.weights[k % 20] : 2 * line.weights[k % 20];
      if (i + 1 < E::dim) left *= 1 - s;
    }
    double g[E::nodes][E::dim];
    const double w = elasticity::physical_gradient<E>(x, xi, g) * weight;
    const auto sigma = elasticity::stress_of<E::dim>(material.at(0), elasticity::gradient_of<E::dim>(m, 0, u, g));
    for (int a = 0; a < E::nodes; ++a)
      for (int i = 0; i < E::dim; ++i)
        for (int j = 0; j < E::dim; ++j) exact[a * E::dim + i] += w * sigma(i, j) * g[a][j];
  }
  double most = 0;
  for (const double f : exact) most = std::max(most, std::abs(f));
  return test::largest_difference(forces, exact) / most;
}

}  // namespace

TEST_CASE("nodal forces of coarse curved cells: quadrature leaves less than the cells themselves do") {
  using mesh::Element;
  const double angle = pi / 6;
  CHECK(error_of_nodal_forces<elasticity::TriangleP2>(Element::triangle_p2, angle) < 1e-3);
  CHECK(error_of_nodal_forces<elasticity::TetrahedronP2>(Element::tetrahedron_p2, angle) < 1e-3);
}

TEST_CASE("the area of a curved disc: order 4 for cells whose sides are parabolas, and loads carry it") {
  for (const auto family : test::kSecondOrder) {
    CAPTURE(test::name(family));
    const auto error = [&](int cells) {
      const Mesh m = test::disc(family, cells, 1, 1, 2);
      return std::abs(4 * pi - test::integral(m, [](const auto&) { return 1.0; }));
    };
    for (int cells : {2, 4, 8}) {
      const double order = std::log2(error(cells) / error(2 * cells));
      CAPTURE(cells);
      CAPTURE(order);
      CHECK(order > 3.85);
      CHECK(order < 4.1);
    }
    // By the divergence theorem from the boundary, too: both are exact for these polynomials.
    const Mesh m = test::disc(family, 3, 1, 1, 2);
    double area = 0;
    for (const Facet f : m.parts.at("boundary"))
      elasticity::for_each_facet_point(m, f, [&](const auto& p) { area += p.measure * (p.x[0] * p.normal[0] + p.x[1] * p.normal[1]) / 2; });
    CHECK(area == doctest::Approx(test::integral(m, [](const auto&) { return 1.0; })).epsilon(1e-13));
  }
}

TEST_CASE("facet points of curved facets: ∫n is the area vector, the lengths tend to the circle's at order 4") {
  for (const auto family : test::kSecondOrder) {
    std::vector<Mesh> meshes{test::disc(family, 2)};
    for (int dim : {2, 3}) {
      meshes.push_back(test::unit(dim, family, 2));
      mesh::transform(meshes.back(), [](const Point& x) { return Point{x[0] + 0.2 * x[1] * x[1], x[1] - 0.1 * x[0] * x[2], x[2] + 0.15 * std::sin(2 * x[0] + x[1])}; });
    }
    for (const Mesh& m : meshes)
      for (const Facet f : mesh::boundary(m)) {
        Point sum{0, 0, 0};
        double measure = 0;
        elasticity::for_each_facet_point(m, f, [&](const elasticity::FacetPoint& p) {
          double one = 0;
          Point x{0, 0, 0};
          for (int k = 0; k < p.nodes; ++k) {
            one += p.shape[k];
            for (int i = 0; i < 3; ++i) x[i] += p.shape[k] * m.point(m.facet_node(f, k))[i];
          }
          CHECK(one == doctest::Approx(1).epsilon(1e-14));
          CHECK(test::length(mesh::minus(x, p.x)) < 1e-14);
          CHECK(test::length(p.normal) == doctest::Approx(1).epsilon(1e-14));
          measure += p.measure;
          for (int i = 0; i < 3; ++i) sum[i] += p.measure * p.normal[i];
        });
        CHECK(test::length(mesh::minus(sum, m.facet_area_vector(f))) < 1e-14);
        CHECK(measure > test::length(sum) * (1 - 1e-14));
      }
    const auto error = [&](int cells) {
      const Mesh m = test::disc(family, cells);
      double length = 0;
      for (const Facet f : m.parts.at("boundary")) elasticity::for_each_facet_point(m, f, [&](const auto& p) { length += p.measure; });
      return std::abs(2 * pi - length);
    };
    CHECK(std::log2(error(3) / error(6)) == doctest::Approx(4).epsilon(0.05));
  }
}

TEST_CASE("loads of degree 2 do exact work on quadratic displacements, on straight cells") {
  // ∫ over the unit square or cube of x^a y^b z^c.
  const auto moment = [](int a, int b, int c) { return 1.0 / ((a + 1) * (b + 1) * (c + 1)); };
  for (int dim : {2, 3})
    for (const auto family : test::kSecondOrder) {
      CAPTURE(test::name(family));
      auto m = test::unit(dim, family, 2);
      if (mesh::simplices(family)) test::distort(m, 0.05);  // a quadrilateral's Jacobian takes two degrees
      std::vector<double> force(m.coordinates.size(), 0), pull(m.coordinates.size(), 0);
      elasticity::add_body_force(m, [](const Point& x) { return Point{x[0] * x[1], 1 - x[1] * x[1], 0}; }, force);
      test::add_traction(m, m.parts.at("right"), [](const Point& x) { return Point{x[1] * x[1], 2 * x[1], 0}; }, pull);
      double work = 0, done = 0;
      for (int n = 0; n < m.node_count(); ++n) {
        const Point x = m.point(n), u{x[0] * x[0], x[0] * x[1], 0};
        for (int i = 0; i < dim; ++i) work += force[n * dim + i] * u[i], done += pull[n * dim + i] * u[i];
      }
      CHECK(work == doctest::Approx(moment(3, 1, 0) + moment(1, 1, 0) - moment(1, 3, 0)).epsilon(1e-13));
      CHECK(done == doctest::Approx(1.0 / 3 + 2.0 / 3).epsilon(1e-13));
    }
}

TEST_CASE("a manufactured solution converges with order 3 in displacement and 2 in energy") {
  // u_i = a_i Π sin(π x_j); f = −div σ(u).
  const double amount[3] = {1, -0.5, 0.7};
  for (int dim : {2, 3})
    for (const auto family : test::kSecondOrder) {
      CAPTURE(dim);
      CAPTURE(test::name(family));
      const auto product = [&](const Point& x, int k, int l) {  // ∂_k∂_l of Π sin(π x_j); -1: none
        double p = 1;
        for (int j = 0; j < dim; ++j) {
          const int order = (k == j) + (l == j);
          p *= order == 0 ? std::sin(pi * x[j]) : order == 1 ? pi * std::cos(pi * x[j]) : -pi * pi * std::sin(pi * x[j]);
        }
        return p;
      };
      double whole = 0;  // a(u, u) = ∫ f u: sines and cosines squared give ½ each axis
      for (int i = 0; i < dim; ++i) whole += amount[i] * amount[i] * pi * pi * ((kLambda + kMu) + dim * kMu) / (1 << dim);
      const auto errors = [&](int n) {
        auto m = test::unit(dim, family, n);
        const auto numbering = test::prescribe(m, [&](const Point& x, int) { return test::on_boundary(x, dim); }, [](const Point&) { return Point{0, 0, 0}; });
        std::vector<double> load(m.coordinates.size(), 0);
        elasticity::add_body_force(m, [&](const Point& x) {
          Point f{0, 0, 0};
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j) f[i] -= (kLambda + kMu) * amount[j] * product(x, i, j) + kMu * amount[i] * product(x, j, j);
          return f;
        }, load);
        const auto system = test::system_of(m, test::steel(dim, kE, kNu), {}, load, numbering);
        const auto u = test::solve_sparse(system, numbering);
        double work = 0;  // a(u_h, u_h)
        for (std::size_t k = 0; k < u.size(); ++k) work += load[k] * u[k];
        const double square = test::integral(m, [&](const elasticity::CellPoint& p) {
          const Point v = value(m, u, p.cell, p.x);
          double sum = 0;
          for (int i = 0; i < dim; ++i) sum += std::pow(v[i] - amount[i] * product(p.x, -1, -1), 2);
          return sum;
        });
        return std::pair{std::sqrt(square), std::sqrt(std::abs(whole - work))};
      };
      const int n = dim == 2 ? 12 : 4;
      const auto coarse = errors(n), fine = errors(2 * n);
      const double order = std::log2(coarse.first / fine.first), energy_order = std::log2(coarse.second / fine.second);
      CAPTURE(order);
      CAPTURE(energy_order);
      CHECK(order > 2.85);  // 3 in the limit
      CHECK(order < 3.2);
      CHECK(energy_order > 1.85);  // 2 in the limit
      CHECK(energy_order < 2.1);
    }
}

TEST_CASE("nodal stress of a smooth displacement is of order 2 at every node") {
  for (int dim : {2, 3})
    for (const auto family : test::kSecondOrder) {
      CAPTURE(test::name(family));
      const auto error = [&](int n) {
        auto m = test::unit(dim, family, n);
        test::curve(m, 0.02);
        const auto u = [](const Point& x) { return Point{std::sin(2 * x[0]) * std::cos(x[1]), std::exp(x[0] - x[1]) + x[2] * x[2] * x[2], std::cos(x[0] + 2 * x[2])}; };
        const auto stress = elasticity::nodal_stress(m, test::steel(dim, kE, kNu), test::nodal(m, u));
        double worst = 0;
        for (int k = 0; k < m.node_count(); ++k) {
          const Point x = m.point(k);
          const double exx = 2 * std::cos(2 * x[0]) * std::cos(x[1]), eyy = -std::exp(x[0] - x[1]),
                       ezz = dim == 3 ? -2 * std::sin(x[0] + 2 * x[2]) : 0;
          worst = std::max(worst, std::abs(stress[k][0] - (kLambda * (exx + eyy + ezz) + 2 * kMu * exx)));
        }
        return worst;
      };
      const int n = dim == 2 ? 16 : 8;
      const double order = std::log2(error(n) / error(2 * n));
      CAPTURE(order);
      CHECK(order > 1.8);
    }
}

TEST_CASE("shape functions at a point of a curved cell: 1 in sum, they reproduce the point and mapped quadratics") {
  test::Random random(232);
  for (const auto family : test::kSecondOrder) {
    std::vector<Mesh> meshes{test::disc(family, 2, 1, -1, 0.5)};
    for (int dim : {2, 3}) {
      meshes.push_back(test::unit(dim, family, 2));
      test::curve(meshes.back(), 0.05);
    }
    for (const Mesh& m : meshes) {
      const int dim = m.dimension();
      // The facet points of all cells, and the load points inside.
      test::integral(m, [&](const elasticity::CellPoint& p) {
        std::array<double, mesh::kMostNodes> shape;
        REQUIRE(elasticity::shape_at(m, p.cell, p.x, 1e-9, shape));
        double one = 0;
        Point x{0, 0, 0};
        for (int a = 0; a < m.topology().nodes; ++a) {
          one += shape[a];
          for (int i = 0; i < dim; ++i) x[i] += shape[a] * m.node(m.cell(p.cell)[a])[i];
        }
        CHECK(one == doctest::Approx(1).epsilon(1e-13));
        CHECK(test::length(mesh::minus(x, p.x)) < 1e-13);
        CHECK_FALSE(elasticity::shape_at(m, p.cell, {p.x[0] + 5, p.x[1], p.x[2]}, 1e-6, shape));
        return 0.0;
      });
      for (int c = 0; c < m.cell_count(); ++c)
        for (int a = 0; a < m.topology().nodes; ++a) {  // at a node its own function alone
          std::array<double, mesh::kMostNodes> shape;
          REQUIRE(elasticity::shape_at(m, c, m.point(m.cell(c)[a]), 1e-9, shape));
          for (int b = 0; b < m.topology().nodes; ++b) CHECK(std::abs(shape[b] - (a == b)) < 1e-11);
        }
    }
  }
}
