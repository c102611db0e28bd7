#pragma once

#include "base/monitor.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Each cell cut into 4 in the plane, 8 in space, facets of parts likewise; the nodes of the mesh come first, and its `coarser` says what the
/// others lie between. Cells of order 2 are cut as their functions map them: curved sides stay the same curves.
/// `watch`: asked between the steps whether to stop; Interrupted is thrown then.
mesh::Mesh refined(const mesh::Mesh& mesh, Monitor* watch = nullptr);

}  // namespace dotyk::elasticity
