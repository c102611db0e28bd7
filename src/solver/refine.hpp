#pragma once

#include "problem/condensed.hpp"

namespace dotyk::solver {

/// Iterative refinement of a solution found on the condensed problem. There x = x₀ − Wλ + Nα may be a small difference of great terms, where
/// loads alone would move bodies far, as a thin strip that rests on a plane, or bodies on weak springs; and λ suffers. From u itself x = Bu − c and
/// f − Ku − Bᵀλ are known to rounding of what they are, and in the pieces of the laws that they show one Newton step gives what is missing
/// to (u, λ). Steps are made as long as the state comes nearer to its laws and equilibrium, three at most; true where one was made.
bool refine(const problem::Problem& problem, const problem::CondensedProblem& condensed, problem::State& state);

/// How far a state is from its laws: the greatest of what problem::Residual says of them.
double off_laws(const problem::Problem& problem, const problem::State& state);

}  // namespace dotyk::solver
