#pragma once

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// The penalty method: a spring in series with every row that is not a spring itself, so λ = P(p x) with
/// p = factor · Σ_j B_rj² K_jj; for contact λ = p (Bu − c)⁺. Bodies overlap by λ/p; force and energy are off
/// by O(1/factor), and `penalty` of the result says by how much. `converged` is said of the problem with
/// springs alone.
struct Penalty : Settings {
  double factor = 1000;
  /// On the contact rows, where the multipliers are unknowns of their own and no digits are lost however
  /// stiff the springs; else in the classical way, the springs of closed rows added to the stiffness matrix,
  /// which is factored anew in each iteration and loses digits as `factor` grows.
  bool reduced = true;
};

/// Throws InputError for friction, and where there is no solution, naming the motion.
Result solve(const problem::Problem& problem, const Penalty& settings, Monitor& monitor);

}  // namespace dotyk::solver
