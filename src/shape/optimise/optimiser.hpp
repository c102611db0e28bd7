#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "algebra/types.hpp"

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

}  // namespace dotyk::shape
