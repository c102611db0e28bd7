#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::scene {

/// A cell and the shape functions of its nodes at a point.
struct Place {
  int cell;
  std::array<double, 8> shape;
};

/// Finds the cell that contains a point, by a uniform grid of cell boxes.
class Locator {
 public:
  explicit Locator(const mesh::Mesh& mesh);
  /// Empty outside the mesh (by more than 1e-6 of a cell).
  std::optional<Place> find(const mesh::Point& x) const;

 private:
  const mesh::Mesh& mesh_;
  mesh::Point low_{}, high_{}, step_{};
  std::array<int, 3> count_{1, 1, 1};
  std::vector<int> start_, cells_;  ///< bin → cells whose box meets it
};

}  // namespace dotyk::scene
