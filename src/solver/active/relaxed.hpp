#pragma once

#include <optional>

#include "solver/active/held_stiffness.hpp"

namespace dotyk::solver {

/// Improves a state near the rows that bear, by twenty symmetric Gauss-Seidel sweeps over the unknowns of these rows and four layers of neighbours,
/// each row by its law: nonlinear smoothing, as in monotone multigrid (Kornhuber, Numer. Math. 69 (1994)). A state interpolated from a coarser mesh is
/// wrong where contact, stick or slip end between the nodes of that mesh. Unknowns farther away do not move; their rows, and rows without an unknown of
/// their own, keep λ. Gives nothing where the forces of rows would change by more than 0.7
/// of their norm, as beside a much stiffer body: the relaxed state is then no better a start.
std::optional<problem::State> relaxed(const problem::Problem& problem, const HeldStiffness& stiffness, const problem::State& from);

}  // namespace dotyk::solver
