#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::meshfile {

/// The mesh of order 2 with the corners of `first`. `between` says, cell by cell in the order of
/// mesh::ElementTopology::between, where in `points` (3 × nodes) the nodes between the corners stand, -1 where a cell has
/// none of its own: then the node is that of a neighbour which has one, else what the serendipity interpolation has there,
/// x_edge = ½ Σ x_c over 2 corners, x_face = −¼ Σ x_c + ½ Σ x_e over 4 and 4, x_cell = −¼ Σ x_c + ¼ Σ x_e over 8 and 12.
/// That is the geometry of serendipity cells, and of straight ones. `number` gives the corners that the points are, or -1.
///
/// Throws InputError, beginning with `what`, where cells do not fit together: a point lies between corners and is a corner,
/// or lies between other corners, too; or two points between the same corners.
mesh::Mesh with_nodes_between(mesh::Mesh first, const std::vector<int>& between, const std::vector<double>& points,
                              const std::vector<int>& number, const std::string& what);

/// Of `order`, which mirrors the corners of a cell, what it does to all nodes of this cell type.
std::vector<int> all_nodes(const mesh::ElementTopology& topology, std::vector<int> order);

}  // namespace dotyk::meshfile
