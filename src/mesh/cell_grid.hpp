#pragma once

#include <array>

#include "mesh/mesh.hpp"

namespace dotyk::mesh {

/// A uniform grid over a mesh that knows the cells near a point.
class CellGrid {
 public:
  explicit CellGrid(const Mesh& mesh);
  /// Every cell whose box contains x, by more than 1e-6 of the mesh's size outside it, is among them; none far outside the mesh.
  std::span<const int> near(const Point& x) const;

 private:
  Point low_{}, high_{}, step_{};
  std::array<int, 3> count_{1, 1, 1};
  Buckets cells_;  ///< bin → cells whose box meets it
};

}  // namespace dotyk::mesh
