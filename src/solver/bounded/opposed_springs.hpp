#pragma once

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// Has a row of the problem a law of two springs (problem::kinked_at_zero)?
bool has_two_springs(const problem::Problem& problem);

/// The same problem with two opposed one-sided springs for each such row, the one for x > 0 in its place and the one for
/// x < 0 behind all rows (P4, remark 7): for methods that want φ* of one parabola.
struct OpposedSprings {
  problem::Problem problem;
  std::vector<int> from;  ///< of each row, the one that it is or was split from
};
OpposedSprings opposed_springs(const problem::Problem& whole);

/// A result of a split problem as one of the problem of so many rows: both multipliers of a row, active where one of its springs is.
Result joined(Result result, const std::vector<int>& from, int rows);

}  // namespace dotyk::solver
