#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "base/lists.hpp"
#include "elasticity/assembly.hpp"

namespace dotyk::elasticity {

/// The cells that have a node with a flagged unknown, their material, supports and springs: the lists are for assemble_share(). `own`: a flag for each
/// unknown of the body.
Share share(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const Numbering& numbering,
            const std::vector<char>& own);

/// The lower triangle of the stiffness of these cells. In rows and columns of flagged unknowns its entries are those of the body's stiffness.
algebra::StoredMatrix assemble_share(Lists lists);

}  // namespace dotyk::elasticity
