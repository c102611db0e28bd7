#include "plate/element/element.hpp"

#include <cmath>

#include "plate/element/hct.hpp"
#include "plate/element/morley.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;

Triangle triangle(const mesh::Mesh& mesh, const Edges& edges, int cell) {
  Triangle t;
  for (int k = 0; k < 3; ++k) t.x[k] = node_position(mesh, mesh.cell(cell)[k]);
  for (int k = 0; k < 3; ++k) {
    const Vector2d along = t.x[(k + 1) % 3] - t.x[k];
    t.length[k] = along.norm();
    t.tangent[k] = along / t.length[k];
    t.normal[k] = {t.tangent[k][1], -t.tangent[k][0]};
    t.sign[k] = edges.sign(cell, k);
  }
  const Vector2d a = t.x[1] - t.x[0], b = t.x[2] - t.x[0];
  t.area = (a[0] * b[1] - a[1] * b[0]) / 2;
  for (int k = 0; k < 3; ++k) t.barycentric_gradient.col((k + 2) % 3) = -t.normal[k] * t.length[k] / (2 * t.area);
  return t;
}

std::unique_ptr<const Basis> basis(Element element, const Triangle& triangle) {
  if (element == Element::morley) return std::make_unique<Morley>(triangle);
  return std::make_unique<Hct>(triangle);
}

namespace {

Rule middles() { return {{{0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}, {1. / 3, 1. / 3, 1. / 3}}; }

/// Radon's rule with seven points, exact for degree 5.
Rule radon() {
  const double s = std::sqrt(15.0), a = (6 - s) / 21, b = (6 + s) / 21, wa = (155 - s) / 1200, wb = (155 + s) / 1200;
  return {{{1. / 3, 1. / 3, 1. / 3}, {1 - 2 * a, a, a}, {a, 1 - 2 * a, a}, {a, a, 1 - 2 * a}, {1 - 2 * b, b, b}, {b, 1 - 2 * b, b}, {b, b, 1 - 2 * b}},
          {9. / 40, wa, wa, wa, wb, wb, wb}};
}

/// A rule on each third of a cell, (k, k + 1, centre).
Rule on_thirds(const Rule& rule) {
  Rule out;
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      Barycentric p = Barycentric::Constant(rule.points[i][2] / 3);
      p[k] += rule.points[i][0];
      p[(k + 1) % 3] += rule.points[i][1];
      out.points.push_back(p);
      out.weights.push_back(rule.weights[i] / 3);
    }
  return out;
}

}  // namespace

const Rule& stiffness_rule(Element element) {
  static const Rule morley = middles();
  static const Rule hct = [] {  // points moved off the lines between thirds, where curvatures jump
    const double a = 1. / 6, b = 2. / 3;
    return on_thirds({{{b, a, a}, {a, b, a}, {a, a, b}}, {1. / 3, 1. / 3, 1. / 3}});
  }();
  return element == Element::morley ? morley : hct;
}

const Rule& load_rule(Element element) {
  static const Rule morley = radon();
  static const Rule hct = on_thirds(radon());
  return element == Element::morley ? morley : hct;
}

Eigen::Matrix3d bending(double nu) {
  Eigen::Matrix3d C;
  C << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return C;
}

LocalMatrix stiffness(const Basis& basis, const Rule& rule, const Triangle& t, double nu, const double* D) {
  const Eigen::Matrix3d C = bending(nu);
  LocalMatrix K = LocalMatrix::Zero(basis.size(), basis.size());
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const auto curvature = basis.curvature_at(rule.points[i]).curvature;
    const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 12> moment = (rule.weights[i] * t.area * D[i]) * C * curvature;
    K.noalias() += curvature.transpose() * moment;
  }
  return K;
}

}  // namespace dotyk::plate
