#pragma once

#include <string>

#include "solver/active/set_iteration.hpp"

namespace dotyk::solver {

/// What goes on where Newton steps of active sets do not come to rest. Each says in words what it has done, nothing where it has not been of use.
using Rescue = std::string (*)(SetIteration&, SetIteration::End);

/// Those that leave a linearisation to go on from, in the order in which they are tried:
///   Gauss–Seidel sweeps that decrease the dual energy, of cycles, trying a Newton step after every few until one confirms its own active set;
std::string by_sweeps(SetIteration& it, SetIteration::End end);
///   a barrier method on the condensed rows;
std::string by_barrier(SetIteration& it, SetIteration::End end);
///   an interior point method on the unknowns, once.
std::string by_interior_point(SetIteration& it, SetIteration::End end);

/// Those that leave a solution (result.converged, λ and `settled`), and their reason; `why` they are asked:
///   the active-set method of programs, from rest, which ends where laws are unilateral or linear;
bool by_active_set(SetIteration& it, const std::string& why);
///   the proximal point method, which converges from everywhere as the energy is convex, whatever the laws.
bool by_proximal(SetIteration& it, const std::string& why);

/// Where laws are off by more than rounding explains: a step of refinement, the same on all unknowns, the proximal point method.
void confirm_laws(SetIteration& it);

}  // namespace dotyk::solver
