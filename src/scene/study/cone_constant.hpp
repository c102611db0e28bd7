#pragma once

#include "algebra/types.hpp"
#include "base/monitor.hpp"

namespace dotyk::scene {

/// The least √(μᵀWμ / μᵀNμ) found over the cone of μ whose first `unilateral` entries are not negative, the others any: TR965 (3.16) over
/// M_hn × M_Ht, whose multiples it is. W positive semidefinite, N positive definite. The quotient has many minima on the cone: steps of
/// projected gradients from each hat and from random points, so that the least may be a little less. Throws Interrupted.
double cone_constant(const algebra::DenseMatrix& W, const algebra::DenseMatrix& N, Eigen::Index unilateral, Monitor& monitor);

}  // namespace dotyk::scene
