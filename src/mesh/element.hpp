#pragma once

#include <array>
#include <vector>

namespace dotyk::mesh {

/// A cell type: its shape and the order of its displacement. Of each shape order 2 comes four places after order 1.
enum class Element {
  triangle_p1, quadrilateral_q1, tetrahedron_p1, hexahedron_q1,
  triangle_p2, quadrilateral_q2, tetrahedron_p2, hexahedron_q2
};

/// Of any cell type, and of its facets.
inline constexpr int kMostNodes = 27, kMostFacetNodes = 9;

/// The combinatorics of a cell type. Nodes of a cell are numbered so that a
/// positively oriented cell has positive Jacobian: triangles and quadrilaterals
/// counter-clockwise; a tetrahedron's node 3 on the side of face (0,1,2) that
/// its right-hand normal points to; a hexahedron's nodes 0-3 counter-clockwise
/// below, 4-7 above them (VTK's order). Second-order cells have these corners first; then a node on each edge, in
/// each quadrilateral face and, of tensor cells, inside: VTK's biquadratic and triquadratic order, see `between`.
struct ElementTopology {
  const char* name;       ///< "P1", "Q1", "P2", "Q2"
  const char* shape;      ///< "triangle", …
  const char* shapes;     ///< "triangles", …
  int dimension;
  int nodes;              ///< per cell
  int facets;             ///< per cell
  int nodes_per_facet;
  int facet_nodes[6][kMostFacetNodes];  ///< local nodes of each facet, corners first: outward by the right-hand rule (3-D),
                                        ///< or with the outward normal on the right of the edge (2-D); then those on the
                                        ///< edges, in that order, then the centre
  int order = 1;
  int corners = nodes;
  int facet_corners = nodes_per_facet;
  std::vector<std::vector<int>> between = {};  ///< node corners + k of a straight cell is the mean of these corners

  bool simplex() const { return corners == dimension + 1; }
};

extern const std::array<ElementTopology, 8> topologies;  ///< in the order of Element; made before main()
inline const ElementTopology& topology(Element element) { return topologies[static_cast<int>(element)]; }
/// ElementTopology's `nodes` and `dimension`, computed inline because inner loops ask for them.
constexpr int nodes_of(Element element) {
  constexpr int nodes[] = {3, 4, 4, 8, 6, 9, 10, 27};
  return nodes[static_cast<int>(element)];
}
constexpr int dimension_of(Element element) { return static_cast<int>(element) % 4 < 2 ? 2 : 3; }

/// The node of a cell of order 2 that lies between these corners, in any order; -1: none (a triangle's centre).
int node_between(const ElementTopology& topology, std::vector<int> corners);

/// The linear (bilinear) hat of a facet's corner at the facet's node k.
double corner_hat(const ElementTopology& topology, int corner, int k);

/// The cell of the same shape of order 1, or of order 2.
Element first_order(Element element);
Element second_order(Element element);

}  // namespace dotyk::mesh
