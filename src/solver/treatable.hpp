#pragma once

#include <string>

#include "problem/problem.hpp"

namespace dotyk::solver {

/// Throws InputError where the problem has friction: `method` cannot treat it, and those that can are named.
void require_frictionless(const problem::Problem& problem, const std::string& method);

/// As well as that, where a law is neither unilateral nor linear.
void require_unilateral_or_linear(const problem::Problem& problem, const std::string& method);

}  // namespace dotyk::solver
