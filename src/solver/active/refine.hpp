#pragma once

#include "problem/condensed.hpp"
#include "problem/residual.hpp"

namespace dotyk::solver {

/// Iterative refinement of a solution found on the condensed problem. There x = x₀ − Wλ + Nα may be a small difference of great terms:
/// where loads alone would move bodies far, as a thin strip that rests on a plane, or bodies on weak springs. The rounding of these terms
/// spoils λ. Computed from u, x = Bu − c and f − Ku − Bᵀλ have no such terms, and one Newton step gives the corrections to u and λ. Up to
/// three steps are made, as long as each brings the state nearer to its laws and to equilibrium. `at`: the state's residual, before and
/// after. True if a step was made.
bool refine(const problem::Problem& problem, const problem::CondensedProblem& condensed, problem::State& state, problem::Residual& at);

}  // namespace dotyk::solver
