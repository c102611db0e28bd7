#include "gmsh_types.hpp"

#include <algorithm>

namespace dotyk::meshfile {
namespace {

/// Numbers of types, by order: complete ones from order 1 on, serendipity ones (nodes at corners and edges alone) from 2 on.
/// 0: there is none, or it is the complete one. From Gmsh's GmshDefines.h.
struct Family {
  Shape shape;
  int edges;
  std::vector<int> complete, serendipity;
};

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      {Shape::segment, 1, {1, 8, 26, 27, 28, 62, 63, 64, 65, 66}, {}},
      {Shape::triangle, 3, {2, 9, 21, 23, 25, 42, 43, 44, 45, 46}, {0, 20, 22, 24, 52, 53, 54, 55, 56}},
      {Shape::quadrilateral, 4, {3, 10, 36, 37, 38, 47, 48, 49, 50, 51}, {16, 39, 40, 41, 57, 58, 59, 60, 61}},
      {Shape::tetrahedron, 6, {4, 11, 29, 30, 31, 71, 72, 73, 74, 75}, {0, 137, 32, 33, 79, 80, 81, 82, 83}},
      {Shape::hexahedron, 12, {5, 12, 92, 93, 94, 95, 96, 97, 98}, {17, 99, 100, 101, 102, 103, 104, 105}},
      {Shape::prism, 9, {6, 13, 90, 91, 106, 107, 108, 109, 110}, {18, 111, 112, 113, 114, 115, 116, 117}},
      {Shape::pyramid, 8, {7, 14, 118, 119, 120, 121, 122, 123, 124}, {19, 125, 126, 127, 128, 129, 130, 131}}};
  return all;
}

/// Of a complete element of order p.
int nodes(Shape shape, int p) {
  switch (shape) {
    case Shape::segment: return p + 1;
    case Shape::triangle: return (p + 1) * (p + 2) / 2;
    case Shape::quadrilateral: return (p + 1) * (p + 1);
    case Shape::tetrahedron: return (p + 1) * (p + 2) * (p + 3) / 6;
    case Shape::hexahedron: return (p + 1) * (p + 1) * (p + 1);
    case Shape::prism: return (p + 1) * (p + 1) * (p + 2) / 2;
    case Shape::pyramid: return (p + 1) * (p + 2) * (2 * p + 3) / 6;
  }
  return 0;
}

/// The order of the type among these, of which the first has this order; 0: it is none of them.
int order(const std::vector<int>& types, int number, int first) {
  const auto at = std::find(types.begin(), types.end(), number);
  return at == types.end() ? 0 : first + static_cast<int>(at - types.begin());
}

}  // namespace

GmshType gmsh_type(int number) {
  if (number == 15) return {{}, 0, 1};
  if (number < 1) return {};
  for (const Family& f : families()) {
    if (const int p = order(f.complete, number, 1)) return {f.shape, p, nodes(f.shape, p)};
    if (const int p = order(f.serendipity, number, 2)) return {f.shape, p, kind(f.shape).nodes + f.edges * (p - 1)};
  }
  return {};
}

void add_element(const GmshType& type, Block& block, const int* nodes) {
  static const std::vector<int> in_order{0, 1, 2, 3, 4}, tetrahedron{0, 1, 2, 3, 5, 4},
      hexahedron{0, 3, 8, 1, 9, 2, 10, 11, 4, 7, 5, 6, 16, 14, 12, 13, 15, 17, 18};  // places in between_corners()
  const int corners = kind(block.shape).nodes;
  block.nodes.insert(block.nodes.end(), nodes, nodes + corners);
  if (type.order != 2 || !kind(block.shape).cell) return;
  const auto& places = block.shape == Shape::tetrahedron ? tetrahedron : block.shape == Shape::hexahedron ? hexahedron : in_order;
  const std::size_t first = block.between.size();
  block.between.resize(first + between_corners(block.shape).size(), -1);
  for (int k = corners; k < type.nodes; ++k) block.between[first + places[k - corners]] = nodes[k];
}

}  // namespace dotyk::meshfile
