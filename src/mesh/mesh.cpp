#include "mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "mesh/facet_table.hpp"

namespace dotyk::mesh {
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

/// Where a cell of order 2 is bad and its corners make a good one of order 1: what to do about it.
std::string advice(const Mesh& mesh, int c) {
  const ElementTopology& t = mesh.topology();
  if (t.order == 1) return "check the order of nodes or the map of the mesh";
  Mesh straight;
  straight.element = first_order(mesh.element);
  for (int k = 0; k < t.corners; ++k) {
    straight.cells.push_back(k);
    straight.coordinates.insert(straight.coordinates.end(), mesh.node(mesh.cell(c)[k]), mesh.node(mesh.cell(c)[k]) + t.dimension);
  }
  return least_jacobian(straight, 0) > 0 ? "its sides are bent too far; with straight sides (order = 1) it is sound, finer cells are bent less"
                                         : "check the order of nodes or the map of the mesh";
}

double edge_scale(const Mesh& mesh, int c) {
  const Point a = mesh.point(mesh.cell(c)[0]);
  double h = 0;
  for (int k = 1; k < nodes_of(mesh.element); ++k) h = std::max(h, length(minus(mesh.point(mesh.cell(c)[k]), a)));
  return h;
}

void refuse_repeated_cells(const Mesh& mesh, const std::string& what) {
  // Two cells with the same nodes have the same centre's node sum and least node; compare those.
  const int n = mesh.topology().nodes;
  const Buckets by_least(mesh.node_count(), [&](auto&& put) {
    for (int c = 0; c < mesh.cell_count(); ++c) put(*std::min_element(mesh.cell(c), mesh.cell(c) + n), c);
  });
  for (int node = 0; node < mesh.node_count(); ++node)
    for (const int a : by_least[node])
      for (const int b : by_least[node])
        if (a < b && std::is_permutation(mesh.cell(a), mesh.cell(a) + n, mesh.cell(b)))
          throw InputError(text(what, ": cells ", a + 1, " and ", b + 1, " have the same nodes; remove one of them"));
}

void refuse_stray_nodes(const Mesh& mesh, const std::string& what) {
  const Buckets cells = cells_of_nodes(mesh);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (cells[node].empty())
      throw InputError(text(what, ": node ", node + 1, " at ", point_text(mesh.node(node), mesh.dimension()), " belongs to no cell; remove it"));
}

/// Throws where a cell is flat, inverted, or of a size beyond the range of numbers.
void check_cell(const Mesh& mesh, int c, const std::string& what) {
  const double edge = edge_scale(mesh, c), scale = edge * edge * (mesh.dimension() == 2 ? 1 : edge);
  const double jacobian = least_jacobian(mesh, c);
  if (!std::isfinite(jacobian) || !std::isfinite(scale) || scale < std::numeric_limits<double>::min())
    throw InputError(text(what, ": cell ", c + 1, " is so ", std::isfinite(jacobian) && scale < 1 ? "small" : "large", " that its ", mesh.dimension() == 2 ? "area" : "volume",
                          " is beyond the range of numbers; choose another unit of length"));
  // A cell flatter than 1e-12 of its size has no digits left in its gradients.
  if (jacobian > 1e-12 * scale) return;
  const std::string cell = text(what, ": cell ", c + 1, " (a ", mesh.topology().shape, " near ", point_text(mesh.cell_centre(c).data(), mesh.dimension()), ")");
  if (jacobian < -1e-12 * scale)
    throw InputError(text(cell, " is inverted; its least Jacobian is ", jacobian, ", it must be positive: ", advice(mesh, c)));
  throw InputError(text(cell, " is flat: its least Jacobian, ", jacobian, ", is ", jacobian / scale, " of its extent ", mesh.dimension() == 2 ? "squared" : "cubed",
                        ", and must be more than 1e-12 of that: ", jacobian > 0 ? "take cells that are less slender" : advice(mesh, c)));
}

}  // namespace

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

std::vector<int> facet_neighbours(const Mesh& mesh) {
  const FacetTable table(mesh);
  const int facets = mesh.topology().facets;
  std::vector<int> neighbour(static_cast<std::size_t>(mesh.cell_count()) * facets, -1);
  const auto meet = [&](Facet f, Facet g) {
    int& cell = neighbour[static_cast<std::size_t>(f.cell) * facets + f.local];
    if (cell < 0) cell = g.cell;
  };
  parallel_ranges(mesh.node_count(), threads_for(mesh.cell_count(), FacetTable::kFewCells), [&](int, int first, int end) {
    for (int node = first; node < end; ++node) table.pairs(node, [&](Facet f, Facet g) { meet(f, g), meet(g, f); });
  });
  return neighbour;
}

std::vector<Facet> boundary(const Mesh& mesh) {
  if (mesh.whole) return mesh.whole->boundary;
  const std::vector<int> neighbour = facet_neighbours(mesh);
  const int facets = mesh.topology().facets;
  std::vector<Facet> result;
  for (std::size_t k = 0; k < neighbour.size(); ++k)
    if (neighbour[k] < 0) result.push_back({static_cast<int>(k) / facets, static_cast<int>(k) % facets});
  return result;
}

std::vector<char> flag_nodes(const Mesh& mesh, const std::vector<Facet>& facets) {
  std::vector<char> flagged(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const Facet f : facets)
    for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) flagged[mesh.facet_node(f, k)] = 1;
  return flagged;
}

std::vector<int> cells_at(const Mesh& mesh, const std::vector<char>& flagged) {
  const int per_cell = nodes_of(mesh.element);
  std::vector<int> cells;
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (std::any_of(mesh.cell(c), mesh.cell(c) + per_cell, [&](int node) { return flagged[node] != 0; })) cells.push_back(c);
  return cells;
}

std::vector<char> surrounded_cells(const Mesh& mesh) {
  std::vector<char> cells(static_cast<std::size_t>(mesh.cell_count()), !mesh.whole);
  if (mesh.whole)
    for (const int c : cells_at(mesh, flag_nodes(mesh, mesh.whole->boundary))) cells[c] = 1;
  return cells;
}

std::vector<Facet> select(const Mesh& mesh,
                          const std::function<bool(const Point&, const Point&)>& chosen) {
  std::vector<Facet> result;
  for (const Facet f : boundary(mesh))
    if (chosen(mesh.facet_centre(f), unit(mesh.facet_area_vector(f)))) result.push_back(f);
  return result;
}

void check(const Mesh& mesh, const std::string& what) {
  for (int i = 0; i < mesh.node_count(); ++i)
    for (int k = 0; k < mesh.dimension(); ++k)
      if (!std::isfinite(mesh.node(i)[k]))
        throw InputError(text(what, ": node ", i + 1, " has a coordinate that is not finite"));
  constexpr int kFew = 50'000;  // cells, for a thread
  parallel_ranges(mesh.cell_count(), threads_for(mesh.cell_count(), kFew), [&](int, int first, int end) {
    for (int c = first; c < end; ++c) check_cell(mesh, c, what);
  });
  if (mesh.one_piece()) return;  // by how it was made: no cell twice, no stray node
  refuse_repeated_cells(mesh, what);
  refuse_stray_nodes(mesh, what);
}

}  // namespace dotyk::mesh
