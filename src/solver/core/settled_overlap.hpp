#pragma once

#include <optional>

#include "problem/problem.hpp"

namespace dotyk::solver {

/// How far rows overlap, Nα − c (N: problem::jumps_of_modes()), where bodies have settled under their loads as if they were rigid and each row had a
/// spring in series with its law: Nᵀ P(k (Nα − c)) = Rᵀf. The springs are as soft as a whole body is to pressure all over its boundary, so that more
/// rows overlap than will close. Friction sticks wherever its normal row presses. Nothing where no balance is found, and of bodies that do
/// not tell their rigid motions, whose stiffness against pressure is not known.
std::optional<algebra::Vector> settled_overlap(const problem::Problem& problem);

}  // namespace dotyk::solver
