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

/// Linear springs may hold motions alone, hardly. What a method leaves of equilibrium there is little beside all forces and moves them far: they go to where the
/// springs balance what is left, H α = Mᵀ(e − Nᵀλ), H = (NM)ᵀ k NM, or to where a row closes, M the motions that other rows leave free, N and e those of problem::RigidMotions.
/// Returns how far rounding of that may still move an unknown, beside the greatest; 0 where no spring is needed. Where that is more than `most` the state stays.
double settle_on_springs(const problem::Problem& problem, double most, problem::State& state);

}  // namespace dotyk::solver
