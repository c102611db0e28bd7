#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "elasticity/interpolation.hpp"
#include "mesh/box_tree.hpp"

namespace dotyk::scene {

/// A cell and the shape functions of its nodes at a point.
struct Place {
  int cell;
  std::array<double, mesh::kMostNodes> shape;
};

/// Finds the cell that contains a point. Of the cells near a boundary, one that touches it: all cells about its nodes are there, too.
class Locator {
 public:
  explicit Locator(const mesh::Mesh& mesh) : mesh_(mesh), cells_(mesh::boxes_of_cells(mesh)) {
    if (!mesh.whole) return;
    at_boundary_.assign(static_cast<std::size_t>(mesh.node_count()), 0);
    for (const mesh::Facet f : mesh.whole->boundary)
      for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) at_boundary_[mesh.facet_node(f, k)] = 1;
  }
  /// Empty outside the mesh (by more than 1e-6 of a cell).
  std::optional<Place> find(const mesh::Point& x) const {
    for (const int cell : cells_.around(x))
      if (Place place{cell, {}}; serves(cell) && elasticity::shape_at(mesh_, cell, x, 1e-6, place.shape)) return place;
    return std::nullopt;
  }

 private:
  bool serves(int cell) const {
    const int* nodes = mesh_.cell(cell);
    return !mesh_.whole || std::any_of(nodes, nodes + mesh_.topology().nodes, [&](int node) { return at_boundary_[node] != 0; });
  }

  const mesh::Mesh& mesh_;
  mesh::BoxTree cells_;
  std::vector<char> at_boundary_;  ///< nodes; none where the mesh is whole
};

}  // namespace dotyk::scene
