#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// The functions of coarser meshes, each by those of the mesh before it: the first matrix has a row for each unknown, the others one for each
/// component of each node of a coarser mesh, node by node; columns likewise. `unknown` as in Numbering, of the finest mesh, which has so many unknowns.
/// Where a node of a coarser mesh has a prescribed component, row and column are empty. Beyond the last coarser mesh that is known it is repeated.
std::vector<algebra::SparseRows> coarse_functions(const mesh::Mesh& mesh, const std::vector<int>& unknown, int unknowns, int levels);

}  // namespace dotyk::elasticity
