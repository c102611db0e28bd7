#pragma once

#include <string>

#include "problem/problem.hpp"

namespace dotyk::solver {

/// Those that work on the condensed rows alone; all of them treat friction.
inline constexpr const char* kRowMethods = "newton, proximal, uzawa, uzawa_pdas, psor, projected_cg and coulomb_loop";
/// All that treat friction.
inline constexpr const char* kFrictionMethods = "newton, proximal, uzawa, uzawa_pdas, psor, projected_cg, coulomb_loop and feti";

/// Throws InputError where the problem has friction: `method` cannot treat it, and those that can are named.
void require_frictionless(const problem::Problem& problem, const std::string& method);

/// Does every law tell its springs (Law::springs), so that λ(x) is piecewise linear?
bool tells_springs(const problem::Problem& problem);

/// Throws InputError where one does not, naming it: `method` needs them.
void require_springs(const problem::Problem& problem, const std::string& method);

/// No friction, and all laws linear: one branch to each row?
bool all_linear(const problem::Problem& problem);
/// Neither friction nor a law that is neither unilateral nor linear?
bool unilateral_or_linear(const problem::Problem& problem);

/// Throws as require_frictionless, and where a law is neither unilateral nor linear.
void require_unilateral_or_linear(const problem::Problem& problem, const std::string& method);

}  // namespace dotyk::solver
