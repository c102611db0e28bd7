// How an element looks: that of order 2 as its pieces do.
#pragma once

#include "figure/door/picture.hpp"
#include "mesh/element.hpp"

namespace dotyk::figure {

inline CellShape cell_shape(mesh::Element element) {
  switch (element) {
    case mesh::Element::triangle_p1:
    case mesh::Element::triangle_p2: return CellShape::triangle;
    case mesh::Element::quadrilateral_q1:
    case mesh::Element::quadrilateral_q2: return CellShape::quad;
    case mesh::Element::tetrahedron_p1:
    case mesh::Element::tetrahedron_p2: return CellShape::tetrahedron;
    case mesh::Element::hexahedron_q1:
    case mesh::Element::hexahedron_q2: break;
  }
  return CellShape::hexahedron;
}

}  // namespace dotyk::figure
