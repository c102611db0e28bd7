#pragma once

#include <string>

#include "problem/problem.hpp"

namespace dotyk::solver {

/// Those that treat friction; all of them work on the condensed rows alone.
inline constexpr const char* kFrictionMethods = "newton, proximal, uzawa, uzawa_pdas, psor, projected_cg and coulomb_loop";

/// Throws InputError where the problem has friction: `method` cannot treat it, and those that can are named.
void require_frictionless(const problem::Problem& problem, const std::string& method);

/// As well as that, where a law is neither unilateral nor linear.
void require_unilateral_or_linear(const problem::Problem& problem, const std::string& method);

}  // namespace dotyk::solver
