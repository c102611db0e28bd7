#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::contact {

/// A small piece of a surface, to be joined with its neighbours.
struct Piece {
  mesh::Point centre;
  mesh::Box box;  ///< around it
  int component;  ///< pieces of different components are not joined
};

/// Joins pieces into cells of extent `size` along the coordinate axes: each component is cut into
/// ⌈extent/size⌉ equal slabs across its longest extent, and these likewise, until none is longer. A piece belongs
/// to the slab its centre is in. Returns the cell of each piece, numbered from 0.
std::vector<int> partition(const std::vector<Piece>& pieces, double size);

}  // namespace dotyk::contact
