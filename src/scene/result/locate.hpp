#pragma once

#include <array>
#include <optional>

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
  std::optional<Place> find(const mesh::Point& x) const;

 private:
  const mesh::Mesh& mesh_;
  mesh::CellGrid grid_;
};

}  // namespace dotyk::scene
