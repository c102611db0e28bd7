#pragma once

#include <optional>
#include <vector>

#include "problem/condensed.hpp"
#include "problem/residual.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// f − Ku − Bᵀλ.
algebra::Vector out_of_balance(const problem::Problem& problem, const problem::State& state);

/// Residuals of a solution found on the condensed problem that are greater than this are worth a refinement.
inline constexpr double kRounded = 1e-9;

/// Iterative refinement of a solution found on the condensed problem. There x = x₀ − Wλ + Nα may be a small difference of great terms:
/// where loads alone would move bodies far, as a thin strip that rests on a plane, or bodies on weak springs. The rounding of these terms
/// spoils λ. Computed from u, x = Bu − c and f − Ku − Bᵀλ have no such terms, and one Newton step gives the corrections to u and λ. Up to
/// three steps are made, as long as each brings the state nearer to its laws and to equilibrium. Appends the active set of the new state to the
/// result. `at`: the state's residual, before and after. True if a step was made.
bool refine(const problem::Problem& problem, const problem::CondensedProblem& condensed, Result& result, problem::Residual& at);

/// Condensing loses the digits that a body without contact cannot tell apart, and no refinement brings them back where it loses all. Then the same is
/// solved by pdas on all unknowns, where the rows that act hold the body. `active`: rows to begin with. Nothing where pdas cannot treat the laws, or
/// does not converge nearer to them than `laws`.
std::optional<Result> on_all_unknowns(const problem::Problem& problem, const Settings& settings, const std::vector<char>& active, double laws, Monitor& monitor);
/// The same in place of `result`, whose state is off its laws by more than Result::noise. Its reason says so. False where nothing came of it.
bool go_on_on_all_unknowns(const problem::Problem& problem, const Settings& settings, Result& result, Monitor& monitor);

}  // namespace dotyk::solver
