#pragma once

#include <memory>

#include "base/monitor.hpp"
#include "plate/solution.hpp"
#include "solver/method.hpp"

namespace dotyk::plate {

/// Solves. No method named: a linear solve without rows, else PDAS, on the condensed problem while its rows are few. Where the solution is not
/// unique, one of them is given, and with it the family of all; of the free plate that with (u, 1) = (u, x) = (u, y) = 0 (P5, lemma 1).
/// Throws InputError where there is no solution (see require_solvable), and where the method cannot treat a law.
std::shared_ptr<const Solution> solve(std::shared_ptr<const Model> model, const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::plate
