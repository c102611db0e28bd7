#pragma once

#include "problem/problem.hpp"
#include "solver/bounded/separable_set.hpp"

namespace dotyk::solver {

/// What the laws let the multipliers be, as a set for the scaled and shifted ones x = λ/D − λ̄ of a dual problem:
/// its first rows are those of `problem`, the others (gluing, supports) are free. `scale`: D, one a row of
/// `problem`; `bounds`: of every friction point (friction_bounds); an infinite one does not bound.
SeparableSet admissible(const problem::Problem& problem, const algebra::Vector& scale, const algebra::Vector& bounds,
                        const algebra::Vector& shift);

/// Bounds of the friction points, as friction_bounds, while normal multipliers are not known: infinite where they depend on
/// these (Coulomb), so that such points do not slip.
algebra::Vector first_bounds(const problem::Problem& problem);

}  // namespace dotyk::solver
