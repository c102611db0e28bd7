#pragma once

#include "problem/problem.hpp"

namespace dotyk::problem {

/// Throws InputError where stiffnesses, forces (loads, and what gaps and moves make of the stiffness) or displacements are such that
/// methods on rows, which compare squares and products of them, would leave the range of numbers: to inf, to nan or, with a wrong
/// solution that looks right, to 0. One linear solve needs no squares.
void require_moderate(const Problem& problem);

}  // namespace dotyk::problem
