#pragma once

#include <string>

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// What is added to the reason of a method that has failed: that there may be no solution, where the load is on a motion that friction alone stops
/// and the state's pressures have less friction than it asks for; and a method to try next, one that can treat the problem and that neither
/// failed nor, by the reason, was tried. "; …" or empty.
std::string advice(const problem::Problem& problem, const Result& failed);

}  // namespace dotyk::solver
