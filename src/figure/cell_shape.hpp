// How an element looks: that of order 2 as its pieces do.
#pragma once

#include "figure/picture.hpp"
#include "mesh/element.hpp"

namespace dotyk::figure {

inline CellShape cell_shape(mesh::Element element) {
  switch (mesh::first_order(element)) {
    case mesh::Element::triangle_p1: return CellShape::triangle;
    case mesh::Element::quadrilateral_q1: return CellShape::quad;
    case mesh::Element::tetrahedron_p1: return CellShape::tetrahedron;
    default: return CellShape::hexahedron;
  }
}

}  // namespace dotyk::figure
