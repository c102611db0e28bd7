#pragma once

#include <optional>

#include "mesh/element.hpp"
#include "contents.hpp"

namespace dotyk::meshfile {

/// The cell type of order 1 and this shape; none of segments, prisms and pyramids.
inline std::optional<mesh::Element> cell_of(Shape shape) {
  switch (shape) {
    case Shape::triangle: return mesh::Element::triangle_p1;
    case Shape::quadrilateral: return mesh::Element::quadrilateral_q1;
    case Shape::tetrahedron: return mesh::Element::tetrahedron_p1;
    case Shape::hexahedron: return mesh::Element::hexahedron_q1;
    default: return std::nullopt;
  }
}

/// Nodes of a cell of order 2 after its corners; 0 of other shapes.
inline int between_count(Shape shape) {
  const auto cell = cell_of(shape);
  return cell ? static_cast<int>(mesh::topology(mesh::second_order(*cell)).between.size()) : 0;
}

}  // namespace dotyk::meshfile
