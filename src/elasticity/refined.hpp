#pragma once

#include <vector>

#include "base/monitor.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Each cell cut into 4 in the plane, 8 in space, facets of parts likewise; the nodes of the mesh come first, and its `coarser` says what the
/// others lie between. Cells of order 2 are cut as their functions map them: curved sides stay the same curves.
/// `watch`: asked between the steps whether to stop; Interrupted is thrown then.
mesh::Mesh refined(const mesh::Mesh& mesh, Monitor* watch = nullptr);

/// About what that needs while it works.
double refining_bytes(const mesh::Mesh& mesh);

/// The same so many times, but of the boundary only and two layers of cells at it: its `whole` tells of the rest. All cells about a node of the first layer
/// are there. `parent`: receives of each cell the cell of `mesh` that it is a piece of. The mesh must be whole and in one piece.
mesh::Mesh refined_near_boundary(const mesh::Mesh& mesh, int times, std::vector<int>& parent, Monitor* watch = nullptr);

}  // namespace dotyk::elasticity
