#pragma once

#include "problem/problem.hpp"

namespace dotyk::problem {

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// K u, block by block, in extended precision. Forces of neighbouring cells are differences of terms that are greater by (size/cell)² in a solid,
/// and by its square in a beam or a plate.
LongVector precise_stiffness_times(const Problem& problem, const LongVector& u);

}  // namespace dotyk::problem
