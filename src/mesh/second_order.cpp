#include "mesh/second_order.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/facet_table.hpp"

namespace dotyk::mesh {
namespace {

/// A node between corners of a cell; cells that share the corners share it.
struct Between {
  std::array<int, 4> corners;  ///< ascending; -1 where there are two
  int cell, local;
};

std::vector<Between> all_between(const Mesh& mesh, const ElementTopology& t) {
  std::vector<Between> all;
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (std::size_t k = 0; k < t.between.size(); ++k) {
      const std::vector<int>& corners = t.between[k];
      Between one{{-1, -1, -1, -1}, c, t.corners + static_cast<int>(k)};
      // A hexahedron's centre is told from faces, and from other cells', by one corner and itself.
      if (corners.size() == 8)
        one.corners[3] = mesh.node_count() + c;
      else
        for (std::size_t i = 0; i < corners.size(); ++i) one.corners[3 - i] = mesh.cell(c)[corners[i]];
      std::sort(one.corners.begin(), one.corners.end());
      all.push_back(one);
    }
  return all;
}

}  // namespace

Mesh second_order(Mesh first) {
  if (first.topology().order == 2) return first;
  Mesh mesh;
  mesh.element = second_order(first.element);
  mesh.coordinates = first.coordinates;
  mesh.parts = std::move(first.parts);
  const ElementTopology& t = mesh.topology();
  std::vector<Between> all = all_between(first, t);
  std::stable_sort(all.begin(), all.end(), [](const Between& a, const Between& b) { return a.corners < b.corners; });
  mesh.cells.resize(static_cast<std::size_t>(first.cell_count()) * t.nodes);
  std::vector<std::vector<int>> means;
  for (int c = 0; c < first.cell_count(); ++c)
    std::copy_n(first.cell(c), t.corners, mesh.cells.begin() + static_cast<std::ptrdiff_t>(c) * t.nodes);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Between& one = all[k];
    if (k == 0 || one.corners != all[k - 1].corners) {
      std::vector<int> corners = t.between[one.local - t.corners];
      for (int& k : corners) k = first.cell(one.cell)[k];
      const Point x = first.mean(corners.data(), static_cast<int>(corners.size()));
      mesh.coordinates.insert(mesh.coordinates.end(), x.begin(), x.begin() + t.dimension);
      means.push_back(std::move(corners));
    }
    mesh.cells[static_cast<std::size_t>(one.cell) * t.nodes + one.local] = mesh.node_count() - 1;
  }
  const int own = first.node_count();
  mesh.coarser = std::make_shared<Coarser>(Coarser{Buckets(mesh.node_count(), [&](auto&& put) {
    for (int i = 0; i < own; ++i) put(i, i);
    for (std::size_t k = 0; k < means.size(); ++k)
      for (const int corner : means[k]) put(own + static_cast<int>(k), corner);
  }), own, first.coarser});
  return mesh;
}

Mesh of_family(Mesh first, Family family) {
  return family == Family::p2 || family == Family::q2 ? second_order(std::move(first)) : first;
}

namespace {

/// Corners of the pieces of a cell or a facet of order 2, by its corners and dimension.
using PieceCorners = std::vector<std::vector<int>>;

PieceCorners simplex_pieces(int dimension) {
  if (dimension == 1) return {{0, 2}, {2, 1}};
  if (dimension == 2) return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  // Four at the corners; the octahedron between is cut along its diagonal from node 6 to node 8, its pieces so numbered that cutting them again and
  // again gives few shapes (Bey, Computing 55 (1995)).
  return {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}, {4, 6, 7, 8}, {5, 6, 4, 8}, {6, 7, 8, 9}, {8, 5, 6, 9}};
}

PieceCorners tensor_pieces(int dimension) {
  if (dimension == 2) return {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};
  return {{0, 8, 24, 11, 16, 22, 26, 20}, {8, 1, 9, 24, 22, 17, 21, 26},  {24, 9, 2, 10, 26, 21, 18, 23},
          {11, 24, 10, 3, 20, 26, 23, 19}, {16, 22, 26, 20, 4, 12, 25, 15}, {22, 17, 21, 26, 12, 5, 13, 25},
          {26, 21, 18, 23, 25, 13, 6, 14}, {20, 26, 23, 19, 15, 25, 14, 7}};
}

}  // namespace

Mesh cut_at_nodes(Mesh whole) {
  if (whole.topology().order == 1) return whole;
  const ElementTopology& t = whole.topology();
  const bool simplex = t.corners == t.dimension + 1;
  const PieceCorners pieces = simplex ? simplex_pieces(t.dimension) : tensor_pieces(t.dimension);
  const PieceCorners facet_pieces = t.dimension == 2 || simplex ? simplex_pieces(t.dimension - 1) : tensor_pieces(2);
  Mesh mesh;
  mesh.element = first_order(whole.element);
  mesh.coordinates = whole.coordinates;
  mesh.coarser = whole.coarser;
  for (int c = 0; c < whole.cell_count(); ++c)
    for (const std::vector<int>& piece : pieces)
      for (const int k : piece) mesh.cells.push_back(whole.cell(c)[k]);
  const FacetTable table(mesh);
  const int each = mesh.topology().facets;
  for (const auto& [name, facets] : whole.parts)
    for (const Facet facet : facets)
      for (const std::vector<int>& piece : facet_pieces) {
        int nodes[4], count = 0;
        for (const int k : piece) nodes[count++] = whole.facet_node(facet, k);
        table.with(FacetTable::sorted(nodes, count), [&](int f) { mesh.parts[name].push_back({f / each, f % each}); });
      }
  return mesh;
}

}  // namespace dotyk::mesh
