#pragma once

#include <vector>

#include "algebra/coarse_functions.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// The functions of coarser meshes, each by those of the mesh before it. Rows of the first are unknowns; other rows, and all columns, are components of the nodes
/// of coarser meshes, node by node. `unknown` as in Numbering, of the finest mesh, which has so many unknowns. Where a node of a coarser mesh has a prescribed
/// component, row and column are empty. A part of a mesh lacks nodes of the coarser meshes; none of their components is prescribed. Beyond the last coarser mesh that is known it is repeated.
std::vector<algebra::CoarseFunctions> coarse_functions(const mesh::Mesh& mesh, SharedList<int> unknown, int unknowns, int levels);

}  // namespace dotyk::elasticity
