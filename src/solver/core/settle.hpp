#pragma once

#include "problem/free_motions.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// Of a state that has converged, what problem::free_motions() finds, empty if interrupted: adds to the reason which motions its displacement
/// is unique up to, and how far they may go. The state becomes, of those that differ by them, the one nearest to `before`, where that is empty the least,
/// which no method then decides.
problem::FreeMotions settle(const problem::Problem& problem, const problem::Displacement& before, Result& result);

/// Multipliers within this part of the greatest are none, or are on their bound.
inline constexpr double kOnBound = 1e-8;

}  // namespace dotyk::solver
