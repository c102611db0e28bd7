#include "mesh/element.hpp"

namespace dotyk::mesh {

const ElementTopology& topology(Element element) {
  static const ElementTopology triangle{
      "P1", "triangle", "triangles", 2, 3, 3, 2, {{0, 1}, {1, 2}, {2, 0}}};
  static const ElementTopology quadrilateral{
      "Q1", "quadrilateral", "quadrilaterals", 2, 4, 4, 2, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  static const ElementTopology tetrahedron{
      "P1", "tetrahedron", "tetrahedra", 3, 4, 4, 3, {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  static const ElementTopology hexahedron{
      "Q1", "hexahedron", "hexahedra", 3, 8, 6, 4,
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  switch (element) {
    case Element::triangle_p1: return triangle;
    case Element::quadrilateral_q1: return quadrilateral;
    case Element::tetrahedron_p1: return tetrahedron;
    default: return hexahedron;
  }
}

}  // namespace dotyk::mesh
