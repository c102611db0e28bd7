#pragma once

#include "solver/active/held_stiffness.hpp"

namespace dotyk::solver {

/// The state after sweeps of Gauss and Seidel over the unknowns near the rows that bear, each row by its law: nonlinear smoothing, as in monotone
/// multigrid (Kornhuber, Numer. Math. 69 (1994)). It puts right what a state interpolated from a coarser mesh has wrong where contact, stick or slip end
/// between the nodes of that mesh. Rows without an unknown of their own keep their λ.
problem::State relaxed(const problem::Problem& problem, const HeldStiffness& stiffness, problem::State from);

}  // namespace dotyk::solver
