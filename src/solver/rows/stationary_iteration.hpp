#pragma once

#include <functional>

#include "solver/rows/equilibrium.hpp"
#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// The equilibrium of an iteration's free bodies, with which it begins where it stands.
Equilibrium equilibrium_of(const RowIteration& iteration, double weight = 1.0);

/// Moves the iterate to λ and the α(λ) of an augmented Lagrangian.
void move_to(RowIteration& iteration, const Equilibrium& equilibrium, algebra::Vector lambda);

/// A stationary iteration λ := next(λ, x), x the augmented jump at λ, from the iterate at hand until it
/// converges, stalls or may not go on. The equilibrium of free bodies is updated wherever the rows are
/// solved precisely enough for it.
void iterate(RowIteration& iteration, Equilibrium& equilibrium,
             const std::function<algebra::Vector(algebra::Vector lambda, algebra::Vector x)>& next);

}  // namespace dotyk::solver
