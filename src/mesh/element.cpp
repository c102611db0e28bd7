#include "mesh/element.hpp"

#include <algorithm>

namespace dotyk::mesh {
namespace {

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

std::array<ElementTopology, 8> all_topologies() {
  const ElementTopology triangle{"P1", "triangle", "triangles", 2, 3, 3, 2, {{0, 1}, {1, 2}, {2, 0}}};
  const ElementTopology quadrilateral{"Q1", "quadrilateral", "quadrilaterals", 2, 4, 4, 2, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  const ElementTopology tetrahedron{"P1", "tetrahedron", "tetrahedra", 3, 4, 4, 3, {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const ElementTopology hexahedron{"Q1", "hexahedron", "hexahedra", 3, 8, 6, 4,
                                   {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  return {triangle, quadrilateral, tetrahedron, hexahedron,
          with_second_order(triangle, "P2", {{0, 1}, {1, 2}, {2, 0}}),
          with_second_order(quadrilateral, "Q2", {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}}),
          with_second_order(tetrahedron, "P2", {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}),
          with_second_order(hexahedron, "Q2",
                            {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7},
                             {0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 1, 2, 3}, {4, 5, 6, 7},
                             {0, 1, 2, 3, 4, 5, 6, 7}})};
}

}  // namespace

const std::array<ElementTopology, 8> topologies = all_topologies();

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

double corner_hat(const ElementTopology& t, int corner, int k) {
  const int corners = t.facet_corners, edge = k - corners;
  if (edge < 0) return k == corner;
  if (t.dimension == 2) return 0.5;
  if (edge == corners) return 1.0 / corners;
  return corner == edge || corner == (edge + 1) % corners ? 0.5 : 0;
}

Element first_order(Element element) { return static_cast<Element>(static_cast<int>(element) % 4); }
Element second_order(Element element) { return static_cast<Element>(static_cast<int>(element) % 4 + 4); }

}  // namespace dotyk::mesh
