#pragma once

#include "solver/feti/dual_problem.hpp"

namespace dotyk::solver {

/// One over the unit in which ‖Qx‖ counts forces (TornProblem: by the stiffness of what carries them): ‖λ̄‖ / ‖B̂ᵀλ̄‖, or where
/// loads balance on every piece ‖k^(−½)f‖ / ‖f‖; 1 where there are none. 1 as well where k = 1. `balanced`: λ̄.
double force_unit(const DualProblem& dual, const algebra::Vector& balanced);

/// The greatest of the sums of what λ̄ and the load do on a motion of a piece, |G̃||λ̄| + |R̂|ᵀ|f|: none of it cancelled.
double gross_load(const DualProblem& dual, const algebra::Vector& balanced);

}  // namespace dotyk::solver
