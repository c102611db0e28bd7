#include <doctest/doctest.h>

#include "../support/plates.hpp"
#include "../support/random.hpp"
#include "algebra/dense/decompositions.hpp"

using namespace dotyk;
using namespace dotyk::plate;
using Eigen::Vector2d;
using test::kElements;

namespace {

using Jet = Eigen::Matrix<double, 6, 1>;  // u, ∂x u, ∂y u, ∂xx u, ∂yy u, 2∂xy u

/// xᵐyⁿ about (0.3, −0.2).
Jet monomial(int m, int n, const Vector2d& at) {
  const double x = at[0] - 0.3, y = at[1] + 0.2;
  const auto d = [](double t, int power, int times) {
    double factor = 1;
    for (int i = 0; i < times; ++i) factor *= power - i;
    return factor == 0 ? 0.0 : factor * std::pow(t, power - times);
  };
  Jet v;
  v << d(x, m, 0) * d(y, n, 0), d(x, m, 1) * d(y, n, 0), d(x, m, 0) * d(y, n, 1), d(x, m, 2) * d(y, n, 0), d(x, m, 0) * d(y, n, 2), 2 * d(x, m, 1) * d(y, n, 1);
  return v;
}

/// Two triangles with an edge in common, of random shapes: none with an angle below about 10°.
test::Mesh pair(test::Random& random) {
  test::Mesh m;
  m.element = mesh::Element::triangle_p1;
  m.coordinates = {0, 0, 1 + random.between(0, 1), random.between(-0.5, 0.5), random.between(-0.5, 1.5), random.between(0.5, 2), random.between(-0.5, 1.5), -random.between(0.7, 2)};
  m.cells = {0, 1, 2, 1, 0, 3};
  return m;
}

Barycentric inner(test::Random& random) {
  const double a = random.between(0, 1), b = random.between(0, 1);
  return a + b < 1 ? Barycentric{a, b, 1 - a - b} : Barycentric{1 - a, 1 - b, a + b - 1};
}

Eigen::MatrixXd rows(const Shape& shape) {
  Eigen::MatrixXd out(6, shape.value.cols());
  out << shape.value, shape.gradient, shape.curvature;
  return out;
}

/// What the freedoms of a cell are of a deflection: functionals applied to `values(point)`, 6 × columns.
template <class Field>
Eigen::MatrixXd freedoms(Element element, const Triangle& t, const Field& values) {
  const int per_vertex = element == Element::morley ? 1 : 3;
  const Eigen::MatrixXd first = values(Barycentric(1, 0, 0));
  Eigen::MatrixXd out(3 * per_vertex + 3, first.cols());
  for (int k = 0; k < 3; ++k) {
    out.middleRows(per_vertex * k, per_vertex) = values(Barycentric(Barycentric::Unit(k))).topRows(per_vertex);
    const Barycentric middle = (Barycentric::Unit(k) + Barycentric::Unit((k + 1) % 3)) / 2;
    out.row(3 * per_vertex + k) = t.sign[k] * t.normal[k].transpose() * values(middle).middleRows(1, 2);
  }
  return out;
}

template <class Check>
void each_triangle(const Check& check) {
  test::Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const test::Mesh m = pair(random);
    const Edges edges = find_edges(m);
    for (int c = 0; c < 2; ++c) check(triangle(m, edges, c), random);
  }
}

/// ∫ over the triangle (0, 0), (1, 0), (0, 1) of xᵐyⁿ, times 2.
double mean_of_monomial(int m, int n) { return 2 * std::tgamma(m + 1) * std::tgamma(n + 1) / std::tgamma(m + n + 3); }

}  // namespace

TEST_CASE("shape functions have one freedom each") {
  for (const Element element : kElements)
    each_triangle([&](const Triangle& t, test::Random&) {
      const auto functions = basis(element, t);
      const Eigen::MatrixXd is = freedoms(element, t, [&](const Barycentric& b) { return rows(functions->at(b)); });
      CHECK((is - Eigen::MatrixXd::Identity(is.rows(), is.cols())).cwiseAbs().maxCoeff() < 1e-12);
    });
}

TEST_CASE("quadratics by Morley, cubics by HCT, with gradients and curvatures") {
  for (const Element element : kElements)
    each_triangle([&](const Triangle& t, test::Random& random) {
      const auto functions = basis(element, t);
      const int degree = element == Element::morley ? 2 : 3;
      for (int m = 0; m <= degree; ++m)
        for (int n = 0; m + n <= degree; ++n) {
          const Eigen::VectorXd values = freedoms(element, t, [&](const Barycentric& b) { return Eigen::MatrixXd(monomial(m, n, t.point(b))); });
          for (int i = 0; i < 10; ++i) {
            const Barycentric b = inner(random);
            const Shape shape = functions->at(b);
            CHECK((rows(shape) * values - monomial(m, n, t.point(b))).lpNorm<Eigen::Infinity>() < 1e-11);
            CHECK(functions->curvature(b) == shape.curvature);
          }
        }
    });
}

TEST_CASE("gradients and curvatures are derivatives") {
  for (const Element element : kElements)
    each_triangle([&](const Triangle& t, test::Random&) {
      const auto functions = basis(element, t);
      const Barycentric b(0.5, 0.3, 0.2);  // well within a third
      const double h = 1e-4;
      const auto moved = [&](double dx, double dy) { return functions->at(b + t.barycentric_gradient.transpose() * Vector2d(dx, dy)); };
      const Shape at = functions->at(b), e = moved(h, 0), w = moved(-h, 0), n = moved(0, h), s = moved(0, -h);
      const double scale = rows(at).cwiseAbs().maxCoeff();
      CHECK(((e.value - w.value) / (2 * h) - at.gradient.row(0)).cwiseAbs().maxCoeff() < 1e-6 * scale);
      CHECK(((n.value - s.value) / (2 * h) - at.gradient.row(1)).cwiseAbs().maxCoeff() < 1e-6 * scale);
      CHECK(((e.gradient.row(0) - w.gradient.row(0)) / (2 * h) - at.curvature.row(0)).cwiseAbs().maxCoeff() < 1e-8 * scale);
      CHECK(((n.gradient.row(1) - s.gradient.row(1)) / (2 * h) - at.curvature.row(1)).cwiseAbs().maxCoeff() < 1e-8 * scale);
      CHECK(((e.gradient.row(1) - w.gradient.row(1)) / h - at.curvature.row(2)).cwiseAbs().maxCoeff() < 1e-8 * scale);
    });
}

TEST_CASE("HCT is C1 across the lines between its thirds") {
  each_triangle([&](const Triangle& t, test::Random&) {
    const auto functions = basis(Element::hct, t);
    for (int k = 0; k < 3; ++k)
      for (const double s : {0.05, 0.4, 0.8, 1.0}) {
        const Barycentric on = (1 - s) * Barycentric::Unit(k) + s * Barycentric::Constant(1. / 3);
        const Barycentric off = Barycentric::Unit((k + 1) % 3) - Barycentric::Unit((k + 2) % 3);
        const Shape a = functions->at(on + 1e-13 * off), b = functions->at(on - 1e-13 * off);
        CHECK((a.value - b.value).cwiseAbs().maxCoeff() < 1e-11);
        CHECK((a.gradient - b.gradient).cwiseAbs().maxCoeff() < 1e-11);
        if (s < 1) CHECK((a.curvature - b.curvature).cwiseAbs().maxCoeff() > 1e-3);  // two cubics, not one
      }
  });
}

TEST_CASE("across cells: HCT is C1; Morley's means of the slope and values at the ends agree") {
  test::Random random(5);
  for (int trial = 0; trial < 20; ++trial)
    for (const Element element : kElements) {
      const test::Mesh m = pair(random);
      Space space(element, m);
      for (Vector2d& frame : space.frame) {  // the frames of vertices may be any
        const double angle = random.between(-3, 3);
        frame = {std::cos(angle), std::sin(angle)};
      }
      const algebra::Vector u = random.vector(space.count());
      const auto at = [&](int cell, double s) {  // along the edge from node 0 to 1
        const Triangle t = triangle(m, space.edges, cell);
        const Barycentric b = cell == 0 ? Barycentric(1 - s, s, 0) : Barycentric(s, 1 - s, 0);
        Eigen::MatrixXd shape = rows(basis(element, t)->at(b));
        space.to_freedoms(cell, shape);
        Jet v = Jet::Zero();
        const auto freedom = space.freedoms(cell);
        for (int i = 0; i < space.local_size(); ++i) v += shape.col(i) * u[freedom[i]];
        return v;
      };
      const Vector2d normal = space.edges.edges[space.edges.of_cell[0][0]].normal;
      double worst_value = 0, worst_slope = 0, mean = 0;
      for (const double s : {0.0, 0.1, 0.5, 0.7, 1.0}) {
        const Jet a = at(0, s), b = at(1, s);
        worst_value = std::max(worst_value, std::abs(a[0] - b[0]));
        worst_slope = std::max(worst_slope, (a - b).segment<2>(1).norm());
        if (s == 0 || s == 1) CHECK(std::abs(a[0] - b[0]) < 1e-13);
        if (s == 0.5) mean = std::abs(normal.dot((a - b).segment<2>(1)));
      }
      CHECK(mean < 1e-12);
      if (element == Element::hct) CHECK((worst_value < 1e-12 && worst_slope < 1e-11));
      else CHECK((worst_value > 1e-6 && worst_slope > 1e-6));
    }
}

TEST_CASE("no deflections but 1, x and y are without energy") {
  for (const Element element : kElements)
    for (const double nu : {-0.9, 0.0, 0.3, 0.95})
      each_triangle([&](const Triangle& t, test::Random&) {
        const auto functions = basis(element, t);
        const std::vector<double> D(stiffness_rule(element).points.size(), 2.0);
        const LocalMatrix K = stiffness(*functions, stiffness_rule(element), t, nu, D.data());
        CHECK((K - K.transpose()).cwiseAbs().maxCoeff() <= 1e-13 * K.cwiseAbs().maxCoeff());
        const auto values = algebra::eigenvalues(K);
        CHECK(values.head(3).cwiseAbs().maxCoeff() < 1e-13 * values.maxCoeff());
        CHECK(values[3] > 1e-7 * values.maxCoeff());  // the least of slender triangles with nu = 0.95
        for (const auto& [m, n] : {std::pair(0, 0), {1, 0}, {0, 1}})
          CHECK((K * freedoms(element, t, [&, m = m, n = n](const Barycentric& b) { return Eigen::MatrixXd(monomial(m, n, t.point(b))); })).norm() < 1e-11 * K.norm());
        // ½uᵀKu of x²: ½ D · 4 area.
        const Eigen::VectorXd square = freedoms(element, t, [&](const Barycentric& b) { return Eigen::MatrixXd(monomial(2, 0, t.point(b))); });
        CHECK(square.dot(K * square) == doctest::Approx(2 * 4 * t.area).epsilon(1e-11));
      });
}

TEST_CASE("rules are exact for the degrees said") {
  // On the whole cell: Morley's stiffness rule for D of degree 1 with constant curvatures, its load rule for f v of degree 3 + 2; on thirds: HCT's for
  // curvatures squared of degree 2 (D constant), and 2 + 3.
  const auto on_cell = [](const Rule& rule, int degree) {
    for (int m = 0; m <= degree; ++m)
      for (int n = 0; m + n <= degree; ++n) {
        double sum = 0;
        for (std::size_t i = 0; i < rule.points.size(); ++i) sum += rule.weights[i] * std::pow(rule.points[i][1], m) * std::pow(rule.points[i][2], n);
        CHECK(sum == doctest::Approx(mean_of_monomial(m, n)).epsilon(1e-14));
      }
  };
  on_cell(stiffness_rule(Element::morley), 1);
  on_cell(load_rule(Element::morley), 5);
  on_cell(stiffness_rule(Element::hct), 2);
  on_cell(load_rule(Element::hct), 5);
  // Each third by itself: (p − its least coordinate) are the third's own.
  for (const auto& [rule, degree] : {std::pair(&stiffness_rule(Element::hct), 2), {&load_rule(Element::hct), 5}})
    for (int l = 0; l < 3; ++l)
      for (int m = 0; m <= degree; ++m)
        for (int n = 0; m + n <= degree; ++n) {
          double sum = 0;
          for (std::size_t i = 0; i < rule->points.size(); ++i) {
            const Barycentric& p = rule->points[i];
            int least;
            p.minCoeff(&least);
            if (least == l) sum += 3 * rule->weights[i] * std::pow(p[(l + 2) % 3] - p[l], m) * std::pow(3 * p[l], n);
          }
          CHECK(sum == doctest::Approx(mean_of_monomial(m, n)).epsilon(1e-14));
        }
}

TEST_CASE("how far a circle stands out of its chords is right to the third power of their angle; of straight edges it is nothing") {
  for (const int cells : {4, 8, 16}) {
    const test::Mesh m = test::disc(test::Family::p1, cells, 0.5, -1, 2);
    const Edges edges = find_edges(m);
    const auto nodes = find_boundary_nodes(m, edges);
    for (const Edge& edge : edges.edges) {
      if (!edge.boundary) continue;
      const double half = std::asin(edge.length / 4);  // half the angle of the chord, R = 2
      CHECK(sagitta(edge, nodes) / (2 * (1 - std::cos(half))) - 1 == doctest::Approx(-half * half / 12).epsilon(0.05));
    }
  }
  const test::Mesh square = test::rectangle(test::Family::p1, 3, 3);
  const Edges edges = find_edges(square);
  const auto nodes = find_boundary_nodes(square, edges);
  int smooth = 0, corners = 0;
  for (const BoundaryNode& node : nodes) node.edges.empty() ? 0 : ++(node.smooth ? smooth : corners);
  CHECK(smooth == 8);
  CHECK(corners == 4);
  for (const Edge& edge : edges.edges)
    if (edge.boundary) CHECK(std::abs(sagitta(edge, nodes)) < 1e-15);
}
