#include "mesh/element.hpp"

#include <algorithm>

namespace dotyk::mesh {
namespace {

/// The node that lies between these corners, in any order.
int node_between(const ElementTopology& t, std::vector<int> corners) {
  std::sort(corners.begin(), corners.end());
  int node = t.corners;
  for (std::vector<int> own : t.between) {
    std::sort(own.begin(), own.end());
    if (own == corners) return node;
    ++node;
  }
  return -1;  // a triangle's centre is no node
}

ElementTopology with_second_order(ElementTopology t, const char* name, std::vector<std::vector<int>> between) {
  t.name = name;
  t.order = 2;
  t.between = std::move(between);
  t.nodes = t.corners + static_cast<int>(t.between.size());
  for (int l = 0; l < t.facets; ++l) {
    int* nodes = t.facet_nodes[l];
    const std::vector<int> corners(nodes, nodes + t.facet_corners);
    int count = t.facet_corners;
    for (int k = 0; k < (t.dimension == 2 ? 1 : t.facet_corners); ++k)
      nodes[count++] = node_between(t, {corners[k], corners[(k + 1) % t.facet_corners]});
    if (t.facet_corners == 4) nodes[count++] = node_between(t, corners);
    t.nodes_per_facet = count;
  }
  return t;
}

struct Topologies {
  ElementTopology triangle{"P1", "triangle", "triangles", 2, 3, 3, 2, {{0, 1}, {1, 2}, {2, 0}}};
  ElementTopology quadrilateral{"Q1", "quadrilateral", "quadrilaterals", 2, 4, 4, 2, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  ElementTopology tetrahedron{"P1", "tetrahedron", "tetrahedra", 3, 4, 4, 3, {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  ElementTopology hexahedron{"Q1", "hexahedron", "hexahedra", 3, 8, 6, 4,
                             {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  ElementTopology triangle_p2 = with_second_order(triangle, "P2", {{0, 1}, {1, 2}, {2, 0}});
  ElementTopology quadrilateral_q2 = with_second_order(quadrilateral, "Q2", {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}});
  ElementTopology tetrahedron_p2 = with_second_order(tetrahedron, "P2", {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}});
  ElementTopology hexahedron_q2 = with_second_order(
      hexahedron, "Q2",
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {0, 4, 7, 3},
       {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}});
};

}  // namespace

const ElementTopology& topology(Element element) {
  static const Topologies all;
  switch (element) {
    case Element::triangle_p1: return all.triangle;
    case Element::quadrilateral_q1: return all.quadrilateral;
    case Element::tetrahedron_p1: return all.tetrahedron;
    case Element::hexahedron_q1: return all.hexahedron;
    case Element::triangle_p2: return all.triangle_p2;
    case Element::quadrilateral_q2: return all.quadrilateral_q2;
    case Element::tetrahedron_p2: return all.tetrahedron_p2;
    case Element::hexahedron_q2: break;
  }
  return all.hexahedron_q2;
}

double corner_hat(const ElementTopology& t, int corner, int k) {
  const int corners = t.facet_corners, edge = k - corners;
  if (edge < 0) return k == corner;
  if (t.dimension == 2) return 0.5;
  if (edge == corners) return 1.0 / corners;
  return corner == edge || corner == (edge + 1) % corners ? 0.5 : 0;
}

namespace {

/// A cell of each shape, of order 1 and 2.
constexpr Element kOrders[][2] = {{Element::triangle_p1, Element::triangle_p2},
                                  {Element::quadrilateral_q1, Element::quadrilateral_q2},
                                  {Element::tetrahedron_p1, Element::tetrahedron_p2},
                                  {Element::hexahedron_q1, Element::hexahedron_q2}};

Element of_order(Element element, int order) {
  for (const auto& shape : kOrders)
    if (shape[0] == element || shape[1] == element) return shape[order - 1];
  return element;
}

}  // namespace

Element first_order(Element element) { return of_order(element, 1); }
Element second_order(Element element) { return of_order(element, 2); }

}  // namespace dotyk::mesh
