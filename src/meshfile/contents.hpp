#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/element.hpp"

namespace dotyk::meshfile {

enum class Shape { segment, triangle, quadrilateral, tetrahedron, hexahedron, prism, pyramid };

struct ShapeKind {
  const char* plural;
  int dimension;
  int nodes;  ///< corners
  std::optional<mesh::Element> cell = {};  ///< of order 1; there are none that are segments, prisms and pyramids
};

const ShapeKind& kind(Shape shape);

/// mesh::ElementTopology::between of the cell of order 2: the corners of each node after them; none of other shapes.
const std::vector<std::vector<int>>& between_corners(Shape shape);

/// A named set of elements of one dimension: a region, where that is the dimension of the cells, or part of a boundary.
struct Group {
  int dimension;
  std::string name;  ///< as the file has it; its number where it has no name
};

/// Elements of one shape and order, and of the same groups.
struct Block {
  Shape shape;
  std::vector<int> groups;  ///< places in Contents::groups
  std::vector<int> nodes;   ///< corners, element by element, in the order of mesh::ElementTopology and of VTK
  int order = 1;            ///< of the elements in the file
  /// Of triangles, quadrilaterals, tetrahedra and hexahedra of order 2: the nodes after the corners, element by element, as in
  /// mesh::ElementTopology::between; -1 where the file's elements have none (serendipity: no centres of faces and cells).
  std::vector<int> between = {};
};

/// What a mesh file holds, whatever its format, before it is a mesh of one kind of cell.
struct Contents {
  std::vector<double> points;  ///< 3 × number of nodes; the file's length unit
  std::vector<Group> groups;
  std::vector<Block> blocks;
};

/// Throws InputError, beginning with `what`, where there are places beyond the lists or numbers that are not whole elements.
void check(const Contents& contents, const std::string& what);

/// To and from a reader that runs in a process of its own. The numbers are this machine's.
void write(std::FILE* out, const Contents& contents);
/// Throws std::runtime_error where `bytes` are not whole; see check(), too.
Contents read(std::string_view bytes);

}  // namespace dotyk::meshfile
