#pragma once

#include <vector>

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// The stiffness per length or area of a law's spring where it acts, at x = −v; 0 of laws without a spring.
double spring_stiffness(const problem::SupportLaw& law, double x);

/// ‖v‖² of a displacement v (node × dimension) of a body (index in the scene) in the energy norm of the problem linearised
/// at `at`: ∫ ε(v):c:ε(v) + ∫ v·k v over its springs + Σ k weight (v·direction)² over the rows of its supports by laws that
/// spring there: elastic ones, and others (one-sided, unequal, capped, breaking) on the branch where their force follows
/// the displacement. Force·length.
double squared_energy_norm(const Solution& at, int body, const std::vector<double>& v);

}  // namespace dotyk::scene
