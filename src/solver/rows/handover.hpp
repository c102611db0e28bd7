#pragma once

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Where Newton's method has lost its way, other methods begin where it began, each with iterations of its own.
/// With given friction or none the energy is convex: proximal, which then converges from everywhere, and projected_cg.
/// With Coulomb friction nothing is proved: proximal, coulomb_loop, psor, in this order. The reason says what was tried.
/// Last, of small problems, search_pieces() with Newton steps from its points, which finds a solution, or that there is none: refused, naming the motion (InputError).
void hand_over(RowIteration& iteration, double tol);

}  // namespace dotyk::solver
