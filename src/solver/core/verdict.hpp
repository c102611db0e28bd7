#pragma once

#include <string>

#include "problem/residual.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// The last word on a result, whatever the model and the method: its residuals, and `converged` withdrawn, with the reason,
/// where they say that it is no solution. What decides is the greatest of equilibrium, penetration, complementarity and law
/// (see problem::Residual), up to what rounding, tol or a penalty leaves: Result::noise, Result::asked, PenaltyError. Of the
/// equilibrium of a body that moves as a whole far more than it deforms, motion_residual() tells what is rounding.
/// `softest`: the stiffness of the softest motion that supports hold, relative to its body's own.
/// Throws std::runtime_error where a number of the state, its energy or a residual is not finite.
problem::Residual judge(const problem::Problem& problem, Result& result, double softest = 1);

/// How a method ended, for people: "converged: active set confirmed (pdas, 3 iterations)", "NOT CONVERGED: no confirmed
/// active set within 2 iterations (pdas, 2 iterations); rows that still change: row 3"; what follows the first clause of
/// the reason stands behind the method.
std::string ending(const Result& result);

/// What a picture says of a solution that is none: "not converged: " and the first clause of the reason. Empty where the
/// method converged.
std::string doubt(const Result& result);

}  // namespace dotyk::solver
