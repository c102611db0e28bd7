#pragma once

#include <string>

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// How a method ended, for people: "converged: active set confirmed (pdas, 3 iterations)", "NOT CONVERGED: no confirmed
/// active set within 2 iterations (pdas, 2 iterations); rows that still change: row 3"; what follows the first clause of
/// the reason stands behind the method.
std::string ending(const Result& result);

/// What a picture says of a solution that is none: "not converged: " and the first clause of the reason. Empty where the
/// method converged.
std::string doubt(const Result& result);

}  // namespace dotyk::solver
