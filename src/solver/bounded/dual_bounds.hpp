#pragma once

#include "problem/problem.hpp"
#include "solver/bounded/separable_set.hpp"

namespace dotyk::solver {

/// What the laws let the multipliers be, as a set for the scaled and shifted ones x = λ/D − λ̄ of a dual problem:
/// its first rows are those of `problem`, the others (gluing, supports) are free. `scale`: D, one a row of
/// `problem`, the same throughout a friction point; `bounds`: of every friction point (friction_bounds); kNoSlip does not bound.
SeparableSet admissible(const problem::Problem& problem, const algebra::Vector& scale, const algebra::Vector& bounds,
                        const algebra::Vector& shift);

/// Of every row, 1/k of a law of one spring; 0 for rigid rows and those that carry nothing.
algebra::Vector law_compliance(const problem::Problem& problem);

}  // namespace dotyk::solver
