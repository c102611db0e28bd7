#pragma once

#include "problem/problem.hpp"

namespace dotyk::solver {

/// The friction bound of every point (groups in order, points in order) at the normal multipliers of λ.
algebra::Vector friction_bounds(const problem::Problem& problem, const algebra::Vector& lambda);

/// A bound that no force reaches: its point sticks.
inline constexpr double kNoSlip = 1e300;

/// The same while normal multipliers are not known: kNoSlip where the bound depends on these (Coulomb).
algebra::Vector no_slip_bounds(const problem::Problem& problem);

/// P(y) row by row and π_b(y_t) point by point, ρ one number a row (only scalar rows use it; 0 gives the
/// nearest admissible multipliers). b as given, or, where `bounds` is null, at the normal multipliers
/// projected: λ_n = P(y_n), λ_t = π_{b(λ_n)}(y_t).
algebra::Vector project(const problem::Problem& problem, const algebra::Vector& y, const algebra::Vector& rho,
                        const algebra::Vector* bounds = nullptr);

/// The rows with their laws, without the bodies: what methods on the condensed problem see.
problem::Problem laws_of(const problem::Problem& problem);

}  // namespace dotyk::solver
