#pragma once

#include <array>
#include <optional>

#include "elasticity/interpolation.hpp"
#include "mesh/cell_grid.hpp"

namespace dotyk::scene {

/// A cell and the shape functions of its nodes at a point.
struct Place {
  int cell;
  std::array<double, mesh::kMostNodes> shape;
};

/// Finds the cell that contains a point.
class Locator {
 public:
  explicit Locator(const mesh::Mesh& mesh) : mesh_(mesh), grid_(mesh) {}
  /// Empty outside the mesh (by more than 1e-6 of a cell).
  std::optional<Place> find(const mesh::Point& x) const {
    for (const int cell : grid_.near(x))
      if (Place place{cell, {}}; elasticity::shape_at(mesh_, cell, x, 1e-6, place.shape)) return place;
    return std::nullopt;
  }

 private:
  const mesh::Mesh& mesh_;
  mesh::CellGrid grid_;
};

}  // namespace dotyk::scene
