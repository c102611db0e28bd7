#pragma once

#include <memory>
#include <vector>

#include "algebra/refinable.hpp"
#include "algebra/types.hpp"
#include "base/lists.hpp"
#include "elasticity/assembly.hpp"
#include "elasticity/linear_force.hpp"

namespace dotyk::elasticity {

/// The cells that have a node with a flagged unknown, their material, force and supports: assemble_share() takes the lists after joined(). `own`: a flag for each
/// unknown of the body.
Share share(const mesh::Mesh& mesh, const MaterialField& material, const LinearForce& force, const Numbering& numbering, const std::vector<char>& own);

/// Combines the shares of several bodies into one share.
Share joined(std::vector<Share> of_bodies);

/// The lower triangle of the stiffness of these cells, from the lists of joined(). In rows and columns of flagged unknowns its entries are those of the bodies'
/// stiffness.
algebra::StoredMatrix assemble_share(Lists lists);
/// The same cells, to be refined first. Of the lists, supports are not used.
std::unique_ptr<algebra::Refinable> refinable_share(Lists lists);

}  // namespace dotyk::elasticity
