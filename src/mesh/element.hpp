#pragma once

#include <string>

namespace dotyk::mesh {

/// A cell type: its shape and the order of its displacement.
enum class Element { triangle_p1, quadrilateral_q1, tetrahedron_p1, hexahedron_q1 };

/// The combinatorics of a cell type. Nodes of a cell are numbered so that a
/// positively oriented cell has positive Jacobian: triangles and quadrilaterals
/// counter-clockwise; a tetrahedron's node 3 on the side of face (0,1,2) that
/// its right-hand normal points to; a hexahedron's nodes 0-3 counter-clockwise
/// below, 4-7 above them (VTK's order).
struct ElementTopology {
  const char* name;       ///< "P1", "Q1"
  const char* shape;      ///< "triangle", …
  const char* shapes;     ///< "triangles", …
  int dimension;
  int nodes;              ///< per cell
  int facets;             ///< per cell
  int nodes_per_facet;
  int facet_nodes[6][4];  ///< local nodes of each facet, outward by the right-hand rule (3-D),
                          ///< or with the outward normal on the right of the edge (2-D)
};

const ElementTopology& topology(Element element);

}  // namespace dotyk::mesh
