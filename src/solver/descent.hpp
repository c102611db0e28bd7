#pragma once

#include "base/monitor.hpp"
#include "problem/condensed.hpp"

namespace dotyk::solver {

/// Descends the dual energy q(λ) = ½λᵀWλ − x₀ᵀλ + Σ φ*_r(λ_r) of a condensed problem without
/// kernel by one Gauss–Seidel sweep: each row in turn takes its exact minimiser
/// λ_r = P(x̄/W_rr) with ρ = 1/W_rr, x̄ the jump without its own part. q never increases, and
/// sweeps converge for positive definite W: the way out where active sets repeat.
/// `x` is the jump of λ and is kept so.
void descend(const problem::Problem& problem, const problem::CondensedProblem& condensed,
             algebra::Vector& lambda, algebra::Vector& x);

/// q(λ); λ must be admissible.
double dual_energy(const problem::Problem& problem, const problem::CondensedProblem& condensed,
                   const algebra::Vector& lambda);

/// The nearest admissible multipliers: P(λ) at ρ = 0, row by row.
algebra::Vector admissible(const problem::Problem& problem, const algebra::Vector& lambda);

}  // namespace dotyk::solver
