#pragma once

#include "problem/problem.hpp"

namespace dotyk::solver {

/// The friction bound of every point (groups in order, points in order) at the normal multipliers of λ.
algebra::Vector friction_bounds(const problem::Problem& problem, const algebra::Vector& lambda);

/// P(y) row by row and π_b(y_t) point by point, ρ one number a row (only scalar rows use it; 0 gives the
/// nearest admissible multipliers). b as given, or, where `bounds` is null, at the normal multipliers
/// projected: λ_n = P(y_n), λ_t = π_{b(λ_n)}(y_t).
algebra::Vector project(const problem::Problem& problem, const algebra::Vector& y, const algebra::Vector& rho,
                        const algebra::Vector* bounds = nullptr);

/// Does any friction bound depend on the normal multiplier (Coulomb)?
bool bounds_depend_on_normal(const problem::Problem& problem);

}  // namespace dotyk::solver
