#include "plate/element/space.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;

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
