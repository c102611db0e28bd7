#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "shape/derivative/boundary_motion.hpp"

namespace dotyk::shape {

/// Of a plane body: the sides that go on where the moving part ends take the velocity of its end with them, less and less
/// by length, to nothing at their own next corner (a turn of more than 30°), at a node that is `fixed` (flags) or to the
/// velocity of the part's other end. Written to V (components × variables), which has the part's velocities.
void move_sides(const BoundaryMotion& motion, const std::vector<char>& fixed, algebra::DenseMatrix& V);

}  // namespace dotyk::shape
