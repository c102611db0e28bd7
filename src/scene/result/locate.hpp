#pragma once

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

/// Finds the cell that contains a point; see mesh::surrounded_cells().
class Locator {
 public:
  explicit Locator(const mesh::Mesh& mesh) : mesh_(mesh), cells_(mesh::boxes_of_cells(mesh)), surrounded_(mesh::surrounded_cells(mesh)) {}
  /// Empty outside the mesh (by more than 1e-6 of a cell).
  std::optional<Place> find(const mesh::Point& x) const {
    for (const int cell : cells_.around(x))
      if (Place place{cell, {}}; surrounded_[cell] && elasticity::shape_at(mesh_, cell, x, 1e-6, place.shape)) return place;
    return std::nullopt;
  }

 private:
  const mesh::Mesh& mesh_;
  mesh::BoxTree cells_;
  std::vector<char> surrounded_;
};

}  // namespace dotyk::scene
