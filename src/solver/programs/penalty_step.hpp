#pragma once

#include "solver/active/step.hpp"

namespace dotyk::solver {

/// The problem with a spring of stiffness[r] in series with every row where that is finite: an unknown d_r more for
/// each of them, x = Bu − √(k_r/p_r) d − c, with stiffness k_r, the row's own: so ρ and what counts as rounding
/// stay as they are however stiff the spring.
problem::Problem with_springs(const problem::Problem& problem, const algebra::Vector& stiffness);

/// The linear problem of an iteration on with_springs(problem, stiffness) in the unknowns of `problem` alone:
///   (K + Σ_A p_r B_rᵀB_r) u = f + Σ_A p_r c_r B_rᵀ,   λ_A = p (Bu − c)_A,
/// A the active rows; one sparse Cholesky factorisation each time.
std::unique_ptr<Step> penalty_step(const problem::Problem& problem, const problem::RigidMotions& rigid,
                                   const algebra::Vector& stiffness, algebra::Ordering ordering);

}  // namespace dotyk::solver
