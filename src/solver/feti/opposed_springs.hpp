#pragma once

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// Has a row of the problem a law of two springs (problem::kinked_at_zero)?
bool has_two_springs(const problem::Problem& problem);

/// The same problem with two opposed one-sided springs for each such row, the one for x > 0 in its place and the one for
/// x < 0 behind all rows (P4, remark 7): for methods that want φ* of one parabola.
problem::Problem opposed_springs(const problem::Problem& problem);

/// A result of opposed_springs(problem) as one of `problem`: both multipliers of a row, active where one of its springs is.
Result joined(Result result, const problem::Problem& problem);

}  // namespace dotyk::solver
