#include "plate/element/element.hpp"

#include <cmath>
#include <unordered_map>

#include "mesh/facet_table.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;

namespace {

const double kCorner = std::cos(35 * M_PI / 180);

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

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

Edges find_edges(const mesh::Mesh& mesh) {
  Edges out;
  out.of_cell.resize(mesh.cell_count());
  std::unordered_map<std::uint64_t, int> place;
  place.reserve(static_cast<std::size_t>(mesh.cell_count()) * 2);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.cell(c)[k], b = mesh.cell(c)[(k + 1) % 3];
      const auto [found, fresh] = place.emplace(mesh::edge_key(a, b), static_cast<int>(out.edges.size()));
      out.of_cell[c][k] = found->second;
      if (!fresh) {
        out.edges[found->second].boundary = false;
        continue;
      }
      Edge edge{{a, b}, c, true, 0, {}, {}, {}};
      const Vector2d along = node_position(mesh, b) - node_position(mesh, a);
      edge.length = along.norm();
      edge.middle = (node_position(mesh, a) + node_position(mesh, b)) / 2;
      edge.tangent = along / edge.length;
      edge.normal = {edge.tangent[1], -edge.tangent[0]};
      out.edges.push_back(edge);
    }
  return out;
}

std::vector<BoundaryNode> find_boundary_nodes(const mesh::Mesh& mesh, const Edges& edges) {
  std::vector<BoundaryNode> nodes(mesh.node_count());
  for (std::size_t e = 0; e < edges.edges.size(); ++e)
    if (edges.edges[e].boundary)
      for (const int n : edges.edges[e].node) nodes[n].edges.push_back(static_cast<int>(e));
  for (BoundaryNode& node : nodes) {
    if (node.edges.size() != 2) continue;
    const Vector2d a = edges.edges[node.edges[0]].normal, b = edges.edges[node.edges[1]].normal;
    node.smooth = a.dot(b) > kCorner;
    if (node.smooth) node.normal = (a + b).normalized();
  }
  return nodes;
}

double sagitta(const Edge& edge, const std::vector<BoundaryNode>& nodes) {
  const BoundaryNode &a = nodes[edge.node[0]], &b = nodes[edge.node[1]];
  if (!a.smooth && !b.smooth) return 0;
  const double at_a = cross(a.normal, edge.normal), at_b = cross(edge.normal, b.normal);
  return edge.length / 8 * (a.smooth && b.smooth ? at_a + at_b : 2 * (at_a + at_b));
}

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
    const auto curvature = basis.curvature(rule.points[i]);
    const Curvatures moment = (rule.weights[i] * t.area * D[i]) * C * curvature;
    K.noalias() += curvature.transpose() * moment;
  }
  return K;
}

}  // namespace dotyk::plate
