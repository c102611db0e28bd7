#pragma once

#include "base/monitor.hpp"
#include "shape/optimise/optimiser.hpp"

namespace dotyk::shape {

/// Methods of NLopt that take gradients and nonlinear constraints.
struct Mma : Stopping {
  enum class Method {
    mma,    ///< moving asymptotes, globally convergent (Svanberg 2002)
    ccsaq,  ///< the same with quadratic approximations
    slsqp,  ///< sequential quadratic programming (Kraft 1994)
  } method = Method::mma;
};

/// It ends, converged, where the gap or the change of design is below its tolerance and constraints are kept. A design counts
/// as accepted where it keeps the constraints with the least objective so far (or violates them least, as long as
/// none keeps them). A design that is not admissible is answered with an objective far above all seen and violated
/// constraints, upon which these methods take shorter steps; one that is short for that reason is no convergence. Nothing
/// but the design need be given to go on.
///
/// Throws InputError where `start` is outside its bounds or not admissible.
Optimum minimise(const DesignProblem& problem, const Vector& start, const Mma& settings, Monitor& monitor);

}  // namespace dotyk::shape
