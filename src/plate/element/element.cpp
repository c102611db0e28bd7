#include "plate/element/element.hpp"

#include <cmath>
#include <unordered_map>

#include "mesh/facet_table.hpp"

namespace dotyk::plate {
namespace {

using Eigen::Vector2d;

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

Space::Space(Element chosen, const mesh::Mesh& on) : element(chosen), mesh(&on), edges(find_edges(on)), boundary(find_boundary_nodes(on, edges)), unit(on.size()) {
  if (element != Element::hct) return;
  frame.assign(on.node_count(), Vector2d(1, 0));
  for (int n = 0; n < on.node_count(); ++n)
    if (!boundary[n].edges.empty()) {
      const Vector2d normal = boundary[n].smooth ? boundary[n].normal : edges.edges[boundary[n].edges.front()].normal;
      frame[n] = {-normal[1], normal[0]};
    }
}

int Space::node(int freedom) const {
  const int of_vertices = per_vertex() * mesh->node_count();
  return freedom < of_vertices ? freedom / per_vertex() : mesh->node_count() + freedom - of_vertices;
}

std::array<int, 12> Space::freedoms(int cell) const {
  std::array<int, 12> out{};
  int n = 0;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < per_vertex(); ++i) out[n++] = of_vertex(mesh->cell(cell)[k]) + i;
  for (int k = 0; k < 3; ++k) out[n++] = of_edge(edges.of_cell[cell][k]);
  return out;
}

LocalVector Space::of_cell(int cell, const algebra::Vector& all) const {
  const auto freedom = freedoms(cell);
  LocalVector own(local_size());
  for (int i = 0; i < own.size(); ++i) own[i] = all[freedom[i]];
  return own;
}

Functional Space::slope_of_vertex(int vertex, const Vector2d& direction) const {
  const Vector2d a = frame[vertex];
  const double along = a.dot(direction), across = a[0] * direction[1] - a[1] * direction[0];
  Functional out;
  if (std::abs(along) > 1e-14) out.push_back({of_vertex(vertex) + 1, along / unit});
  if (std::abs(across) > 1e-14) out.push_back({of_vertex(vertex) + 2, across / unit});
  return out;
}

/// Of the cubic with u and u' at both ends: h (7/20 u₀ + 3/20 u₁) + h² (1/20 u₀' − 1/30 u₁'), u' along the edge away from the vertex; of a parabola
/// with s at the middle hs/3.
Functional Space::mean_deflection(int number, int vertex) const {
  const Edge& edge = edges.edges[number];
  const double h = edge.length;
  const int end = edge.node[0] == vertex ? 0 : 1;
  const Vector2d away = end == 0 ? edge.tangent : Vector2d(-edge.tangent);
  const int other = edge.node[1 - end];
  if (element == Element::morley) return {{of_vertex(vertex), h / 3}, {of_vertex(other), h / 6}};
  Functional out{{of_vertex(vertex), h * 7 / 20}, {of_vertex(other), h * 3 / 20}};
  for (const Term& term : slope_of_vertex(vertex, away)) out.push_back({term.freedom, term.factor * h * h / 20});
  for (const Term& term : slope_of_vertex(other, away)) out.push_back({term.freedom, -term.factor * h * h / 30});
  const double s = sagitta(edge, boundary);
  if (s != 0) out.push_back({of_edge(number), h * s / 3 / unit});
  return out;
}

Functional Space::deflection_at(int cell, const Barycentric& point) const {
  const Triangle t = triangle(*mesh, edges, cell);
  Values value = basis(element, t)->value(point);
  to_freedoms(cell, value);
  const auto freedom = freedoms(cell);
  Functional out;
  for (int i = 0; i < local_size(); ++i)
    if (value[i] != 0) out.push_back({freedom[i], value[i]});
  return out;
}

Vector2d Space::centre() const {
  Vector2d sum(0, 0);
  for (int n = 0; n < mesh->node_count(); ++n) sum += Vector2d(mesh->node(n)[0], mesh->node(n)[1]);
  sum /= mesh->node_count();
  return (sum.array().abs() < 1e-14 * unit).select(0, sum);  // for messages
}

algebra::DenseMatrix Space::motions() const {
  algebra::DenseMatrix R = algebra::DenseMatrix::Zero(count(), 3);
  const Vector2d middle = centre();
  for (int n = 0; n < mesh->node_count(); ++n) {
    const int first = of_vertex(n);
    R.row(first) << 1, (mesh->node(n)[0] - middle[0]) / unit, (mesh->node(n)[1] - middle[1]) / unit;
    if (element == Element::morley) continue;
    const Vector2d a = frame[n];
    R.block<2, 2>(first + 1, 1) << a[0], a[1], -a[1], a[0];
  }
  for (std::size_t e = 0; e < edges.edges.size(); ++e) R.block<1, 2>(of_edge(static_cast<int>(e)), 1) = edges.edges[e].normal.transpose();
  return R;
}

Barycentric barycentric(const Triangle& t, const Vector2d& x) {
  Barycentric b;
  for (int k = 0; k < 3; ++k) b[k] = 1. / 3 + t.barycentric_gradient.col(k).dot(x - (t.x[0] + t.x[1] + t.x[2]) / 3);
  return b;
}

}  // namespace dotyk::plate
