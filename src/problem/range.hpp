#pragma once

#include "problem/problem.hpp"

namespace dotyk::problem {

/// Throws InputError where stiffnesses, forces (loads, and what gaps and moves make of the stiffness) or displacements are so large or
/// small that methods on rows, which compare squares and products of them, leave the range of numbers: to inf, to nan or, with a
/// wrong solution that looks right, to 0. One linear solve needs no squares. Forces: beyond `most_force` or below its inverse.
void require_moderate(const Problem& problem, double most_force);

/// For methods on rows: squares stay within 1e±240, and leave room for sums and for what is small beside the greatest.
inline constexpr double kMostForceOnRows = 1e120;
/// For methods on subdomains, which bring loads to 1 before they square them.
inline constexpr double kMostForceOnSubdomains = 1e175;

}  // namespace dotyk::problem
