#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "base/lists.hpp"
#include "elasticity/assembly.hpp"

namespace dotyk::elasticity {

/// Some cells of a body, with all that their stiffness is made of.
struct Share {
  Lists lists;                ///< for assemble_share()
  std::vector<int> unknowns;  ///< of the body, ascending: rows of what that makes
};

/// The cells, and their springs, with a node that has one of the flagged unknowns.
Share share(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const Numbering& numbering,
            const std::vector<char>& own);

/// The lower triangle of the stiffness of these cells: entries in rows of the flagged unknowns are the body's.
algebra::StoredMatrix assemble_share(Lists lists);

}  // namespace dotyk::elasticity
