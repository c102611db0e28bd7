#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "base/motion.hpp"
#include "elasticity/assembly.hpp"

namespace dotyk::elasticity {

/// The rigid motions that a body's supports leave free.
struct RigidModes {
  algebra::DenseMatrix modes;   ///< unknowns × count; greatest nodal component of each is 1
  std::vector<Motion> motions;  ///< what they are
};

/// From geometry and supports alone, exactly: the motions that vanish on every prescribed
/// component and wherever a spring acts.
RigidModes rigid_modes(const mesh::Mesh& mesh, const Numbering& numbering,
                       const std::vector<FacetSpring>& springs);

/// All rigid motions, 3 or 6, on the unknowns, whatever holds the body. `unknown` as in Numbering, which has so many of them.
algebra::DenseMatrix all_rigid_motions(const mesh::Mesh& mesh, const std::vector<int>& unknown, int count);

}  // namespace dotyk::elasticity
