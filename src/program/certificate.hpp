#pragma once

#include "program/program.hpp"

namespace dotyk::program {

/// Does y (m) prove that no x satisfies the rows? Farkas: Aᵀy = 0 while Σ high y⁺ − low y⁻ < 0. With
/// Aᵀy = e ≠ 0 it still proves that every feasible x has |x|₁ ≥ −Σ/|e|; that is asked to be at least
/// `far` times the size of the limits. Entries of y against an infinite limit are ignored.
bool proves_infeasible(const QuadraticProgram& program, const Vector& y, double far = 1e8);

/// Does the objective fall for ever along d (n)? qᵀd < 0, Pd = 0, and Ad leaves no finite limit behind,
/// each up to `tolerance` times −qᵀd in units of a well-scaled program.
bool proves_unbounded(const QuadraticProgram& program, const Vector& d, double tolerance = 1e-8);

/// minimise ½|x|² over the same rows: never unbounded, infeasible where the program is.
QuadraticProgram nearest_point(const QuadraticProgram& program);

}  // namespace dotyk::program
