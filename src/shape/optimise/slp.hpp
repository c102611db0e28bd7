#pragma once

#include "base/monitor.hpp"
#include "shape/optimise/optimiser.hpp"

namespace dotyk::shape {

/// Sequential linear programming with a trust region.
struct Slp : Stopping {
  double radius = 0.1;   ///< Δ, half the edge of the first box, as a share of the variables' ranges
  double penalty = 1.0;  ///< ν of the first step, of scaled violations beside the scaled objective
};

/// Steps d of the linear program
///   min g·d + ν Σ t_j,   c + A d ≤ t,   t ≥ 0,   |d_i| ≤ Δ (upper_i − lower_i),   α + d within its bounds,
/// which always has a solution: ν grows until linearised constraints that can be kept within the box are, and those that
/// cannot improve by a tenth of what they can. A design is taken where the exact merit J + ν Σ max(0, c_j) falls by at
/// least 1e-3 of what the linear model promised; Δ doubles where it falls by ¾ of that in a step to the box's side, and
/// becomes half the step where it falls by less than ¼, as where a design is not admissible. (The S ℓ1 LP method with
/// steering of ν of Byrd, Nocedal and Waltz, 2008.)
///
/// It ends, converged, where the gap or the change of design is below its tolerance and constraints are kept. Where the
/// minimum is a vertex of its linearised problem convergence is quadratic; where it is curved Δ must shrink, and
/// the last digits are dear: see mma.hpp. At kinks, too, Δ shrinks.
///
/// Throws InputError where `start` is outside its bounds or not admissible.
Optimum minimise(const DesignProblem& problem, const Vector& start, const Slp& settings, Monitor& monitor);

}  // namespace dotyk::shape
