#include "mesh/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace dotyk::mesh {

Point Mesh::mean(const int* nodes, int count) const {
  Point p{0, 0, 0};
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < dimension(); ++i) p[i] += node(nodes[k])[i] / count;
  return p;
}

Point Mesh::cell_centre(int c) const { return mean(cell(c), topology().nodes); }

Box Mesh::box() const {
  Box box;
  if (node_count() > 0) box.add(point(0));
  const auto d = static_cast<std::size_t>(dimension());
  for (std::size_t k = 0; k < coordinates.size(); k += d)
    for (std::size_t i = 0; i < d; ++i) box.low[i] = std::min(box.low[i], coordinates[k + i]), box.high[i] = std::max(box.high[i], coordinates[k + i]);
  return box;
}

double Mesh::size() const {
  const Box all = box();
  return std::max({0.0, all.extent(0), all.extent(1), all.extent(2)});
}

Point Mesh::facet_centre(Facet f) const {
  int nodes[kMostFacetNodes];
  for (int k = 0; k < topology().nodes_per_facet; ++k) nodes[k] = facet_node(f, k);
  return mean(nodes, topology().nodes_per_facet);
}

namespace {

/// ½∮ x × dx along a face's quadratic edges, which alone decide ∫n.
Point curved_area_vector(const Mesh& mesh, Facet f) {
  const int corners = mesh.topology().facet_corners;
  const Point origin = mesh.point(mesh.facet_node(f, 0));
  const auto at = [&](int k) { return minus(mesh.point(mesh.facet_node(f, k)), origin); };
  Point sum{0, 0, 0};
  for (int k = 0; k < corners; ++k) {
    const Point a = at(k), b = at((k + 1) % corners), middle = at(corners + k);
    const Point in = cross(a, middle), out = cross(middle, b), chord = cross(a, b);
    for (int i = 0; i < 3; ++i) sum[i] += 2.0 / 3 * (in[i] + out[i]) - chord[i] / 6;
  }
  return sum;
}

}  // namespace

Point Mesh::facet_area_vector(Facet f) const {
  const Point a = point(facet_node(f, 0)), b = point(facet_node(f, 1));
  if (dimension() == 2) return {b[1] - a[1], a[0] - b[0], 0};
  if (topology().order == 2) return curved_area_vector(*this, f);
  const Point c = point(facet_node(f, 2));
  if (topology().nodes_per_facet == 3) return times(0.5, cross(minus(b, a), minus(c, a)));
  const Point d = point(facet_node(f, 3));
  return times(0.5, cross(minus(c, a), minus(d, b)));  // of the diagonals
}

std::vector<int> coarser_nodes(const Mesh& mesh) {
  if (mesh.whole) return {mesh.whole->nodes.begin() + 1, mesh.whole->nodes.end()};
  std::vector<int> nodes;
  for (const Coarser* c = mesh.coarser.get(); c; c = c->next.get()) nodes.push_back(c->node_count);
  return nodes;
}

Buckets cells_of_nodes(const Mesh& mesh) {
  return Buckets(mesh.node_count(), [&](auto&& put) {
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (int k = 0; k < nodes_of(mesh.element); ++k) put(mesh.cell(c)[k], c);
  });
}

Point facet_area_derivative(const Mesh& mesh, const std::vector<double>& V, Facet f) {
  const int dim = mesh.dimension(), nodes = mesh.topology().nodes_per_facet;
  const auto difference = [&](const std::vector<double>& of, int from, int to) {  // between two of the facet's nodes
    return minus(at_node(of, mesh.facet_node(f, to), dim), at_node(of, mesh.facet_node(f, from), dim));
  };
  const Point first = difference(V, 0, nodes == 4 ? 2 : 1);
  if (dim == 2) return {first[1], -first[0], 0};
  const int corner = nodes == 4 ? 1 : 0, across = nodes - 1;  // the second diagonal, or the second edge
  const Point u = difference(mesh.coordinates, 0, nodes == 4 ? 2 : 1), v = difference(mesh.coordinates, corner, across),
              second = difference(V, corner, across);
  Point change{0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    change[i] = 0.5 * (first[j] * v[k] - first[k] * v[j] + u[j] * second[k] - u[k] * second[j]);
  }
  return change;
}

void transform(Mesh& mesh, const std::function<Point(const Point&)>& map, const std::vector<char>& flagged) {
  Mesh moved = mesh;
  for (int i = 0; i < mesh.node_count(); ++i)
    if (flagged.empty() || flagged[i]) std::copy_n(map(mesh.point(i)).begin(), mesh.dimension(), moved.coordinates.begin() + static_cast<std::ptrdiff_t>(i) * mesh.dimension());
  check(moved, "the moved mesh");
  mesh = std::move(moved);
}

}  // namespace dotyk::mesh
