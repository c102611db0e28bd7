#pragma once

#include <memory>

#include "base/monitor.hpp"
#include "plate/solution.hpp"
#include "solver/core/method.hpp"

namespace dotyk::plate {

/// Solves; see run() for the method where none is named. Where the solution is unique up to one motion, one is given, and with it the family of
/// all (see solve_limit_case()); of the free plate that with (u, 1) = (u, x) = (u, y) = 0 (P5, lemma 1).
/// Throws InputError where there is no solution (see require_solvable), and where the method cannot treat a law.
std::shared_ptr<const Solution> solve(std::shared_ptr<const Model> model, const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::plate
