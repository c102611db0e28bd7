#pragma once

#include <optional>
#include <vector>

#include "contents.hpp"

namespace dotyk::meshfile {

/// One of Gmsh's element types. Its nodes are the corners, in our order, then others.
struct GmshType {
  std::optional<Shape> shape = {};  ///< none: a point
  int order = 1;
  int nodes = 0;  ///< 0: there is no such type here
};

/// By its number in .msh files and in Gmsh's programming interface: those of a fixed number of nodes, of order 1 to 10.
GmshType gmsh_type(int number);

/// Adds an element to a block of its type; `nodes`: where they stand in Contents::points.
void add_element(const GmshType& type, Block& block, const int* nodes);

}  // namespace dotyk::meshfile
