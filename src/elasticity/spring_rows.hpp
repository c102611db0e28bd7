#pragma once

#include "algebra/types.hpp"
#include "elasticity/assembly.hpp"

namespace dotyk::elasticity {

/// Springs as rows: ½ Σ k_q (Sv)_q² of the unknowns v is what assemble() makes of them.
struct SpringRows {
  algebra::SparseRows S;      ///< one a quadrature point and component with a spring: its displacement there
  algebra::Vector stiffness;  ///< k_q > 0, force per displacement: the point's share of the boundary included
};

/// Throws std::logic_error where a spring acts on a prescribed component.
SpringRows spring_rows(const mesh::Mesh& mesh, const std::vector<FacetSpring>& springs, const Numbering& numbering);

}  // namespace dotyk::elasticity
