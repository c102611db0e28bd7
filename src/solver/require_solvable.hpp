#pragma once

#include <string>

#include "problem/solvability.hpp"

namespace dotyk::solver {

/// Throws InputError where the problem has no solution, naming the motion, the work that the load
/// does on it and what would hold it. Otherwise returns what is to be known of the solution: up to
/// which motion it is unique, or that the load is a limit case; empty where it is unique.
std::string require_solvable(const problem::Problem& problem, const problem::RigidMotions& rigid);

/// Of the resultants of loads that nothing balances, one for each mode of the blocks' kernels, which is the greatest and
/// what would hold it: ", most of all 'lid': translation along x, with 3.5. Hold …"; empty where modes have no names.
std::string unbalanced_motion(const problem::Problem& problem, const algebra::Vector& resultants);

}  // namespace dotyk::solver
