#pragma once

#include "base/motion.hpp"
#include "plate/held.hpp"

namespace dotyk::plate {

/// Motions a + bx + cy that no held freedom stops.
struct FreeMotions {
  algebra::DenseMatrix kernel;   ///< unknowns × motions
  std::vector<Motion> motions;
};
FreeMotions free_motions(const Space& space, const Held& held, const std::vector<int>& unknown);

}  // namespace dotyk::plate
