#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "algebra/types.hpp"
#include "base/monitor.hpp"

namespace dotyk::shape {

using algebra::DenseMatrix;
using algebra::Vector;

/// What a design α (n) is worth: objective and constraints c_j ≤ 0 (m), with exact derivatives; where those are
/// one-sided only, of one side.
struct Evaluation {
  double objective = 0;
  Vector gradient;       ///< n
  Vector constraints;    ///< m, may be empty
  DenseMatrix jacobian;  ///< m × n
};

/// One design evaluated.
struct DesignRecord {
  int design = 0;           ///< from 1
  Vector alpha;
  bool admissible = false;  ///< else nothing of the next two is known
  double objective = 0;
  Vector constraints;
  double radius = 0;        ///< of the box it was sought in, in shares of the variables' ranges; 0: none
  bool accepted = false;    ///< it is the best one from now on
  double gap = 0;           ///< see Stopping::tol_gap; of accepted designs
  double seconds = 0;       ///< since the start
};

/// min J(α) over lower ≤ α ≤ upper, c_j(α) ≤ 0.
struct DesignProblem {
  Vector lower, upper;  ///< n, finite; equal where a variable is to stay
  /// Nothing: the design is not admissible (cells inverted, a state without a solution); a nearer one is then tried.
  std::function<std::optional<Evaluation>(const Vector&)> evaluate;
  std::function<void(const DesignRecord&)> each = {};  ///< told of every design once it is judged; may be empty
};

/// When an optimiser has done enough. A length is a share of a variable's range, upper − lower.
struct Stopping {
  double tol_design = 1e-4;  ///< greatest change of a variable by a step
  /// −min ∇J·d over the whole box, linearised constraints kept: what the first order still promises (the gap of Frank
  /// and Wolfe), relative to Σ |∂J/∂α_i| (upper_i − lower_i) at the first design (|J| where that is 0). It is zero at
  /// Karush–Kuhn–Tucker points, there alone, and bounds J − min J from above for convex problems.
  double tol_gap = 1e-6;
  double tol_violation = 1e-6;  ///< Σ max(0, c_j), each relative to Σ |∂c_j/∂α_i| (upper_i − lower_i) at the first design
  int max_designs = 100;        ///< evaluated, the first one included
};

/// Where an optimiser ended: at the best design. To go on, start there with `radius`.
struct Optimum {
  Vector alpha;
  Evaluation value;
  Vector multipliers;  ///< m, ≥ 0, of the constraints
  double gap = 0;      ///< relative
  double radius = 0;   ///< of the next step's box; 0: the method has none
  bool converged = false;
  std::string reason;  ///< why it ended, in words
  std::vector<DesignRecord> history;
};

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
/// the last digits are dear: see Mma. At kinks, too, Δ shrinks.
///
/// Throws InputError where `start` is outside its bounds or not admissible.
Optimum minimise(const DesignProblem& problem, const Vector& start, const Slp& settings, Monitor& monitor);

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
