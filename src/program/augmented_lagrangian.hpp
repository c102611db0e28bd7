#pragma once

#include "base/monitor.hpp"
#include "program/program.hpp"

namespace dotyk::program {

/// Augmented Lagrangians with adaptive precision for min ½xᵀBx − cᵀx subject to Dx = d (Dostál, Friedlander
/// and Santos 1999; algorithms 2.1 and 5.1 of Alesawi, ODAM 2001).
struct AugmentedLagrangian {
  /// multiplier: μ := μ + ρ(Dx − d) (misprinted without ρ in (5.2)); least_squares: μ := −(DDᵀ)⁻¹D(Bx − c).
  enum class Update { multiplier, least_squares } update = Update::multiplier;
  double M = 1;               ///< inner precision: ‖∇L‖ ≤ M‖Dx − d‖
  double rho = 100;           ///< first penalty ρ₀; like M of the program divided by its greatest entry of B and c, where that is beyond 1e±6
  double alpha = 0.1, beta = 10, eta = 1;  ///< if ‖Dx − d‖ ≤ η: η := αη, else ρ := βρ
  double gradient_tol = 1e-9; ///< stop at ‖∇L‖ ≤ this ‖c‖ …
  double feasibility_tol = 1e-9;  ///< … and ‖Dx − d‖ ≤ this, in the program's own units
  int max_iterations = 200;   ///< outer
  int max_cg = 200000;        ///< in all
};

/// Starts from x = 0, μ = 0. Every row of the program must be an equality (InputError). The inner iteration
/// is plain CG on B + ρDᵀD; it also ends when both stopping tests hold (lemma 2.2: it may converge to the
/// solution itself). Data beyond 1e±100 are refused (InputError). Result: `iterations` outer, `cg` inner, `penalty` the last ρ, y = μ. Negative
/// curvature met by CG is reported as not convex, a direction without curvature as unbounded.
Result solve(const QuadraticProgram& program, const AugmentedLagrangian& settings, Monitor& monitor);

}  // namespace dotyk::program
