#pragma once

#include "base/monitor.hpp"
#include "shape/optimise/bordered.hpp"

namespace dotyk::shape {

/// P7 (16)–(17) on the rows, its dual: minimise ½yᵀHy − gᵀy subject to Gy = e and y ≥ 0 in weak contact, with H = FᵀWE + C
/// and G = NᵀE symmetric and semidefinite, (g, e) the right side `b` of Bordered. Returns the unknowns y that are not 0 by
/// their bound: all but those in weak contact that open.
/// Throws InputError where a motion that no row stops would grow at once: the solution then has no derivative.
std::vector<int> closing(const Bordered& bordered, const std::vector<int>& weak, const algebra::Vector& b, Monitor& monitor);

/// Are weak contact's signs right at (y, α)? Throws std::runtime_error where they are not, up to rounding.
void require_complementary(const Bordered& bordered, const std::vector<int>& weak, const algebra::Vector& b, const algebra::Vector& solved);

}  // namespace dotyk::shape
