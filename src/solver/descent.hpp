#pragma once

#include "problem/condensed.hpp"

namespace dotyk::solver {

/// The nearest admissible multipliers: P(λ) at ρ = 0, row by row.
algebra::Vector admissible(const problem::Problem& problem, const algebra::Vector& lambda);

/// Descends the dual energy of a condensed problem,
///   q(λ) = ½λᵀWλ − x₀ᵀλ + Σ φ*_r(λ_r)    subject to Nᵀλ = e (the equilibrium of free bodies),
/// by Gauss–Seidel sweeps: each row in turn takes its exact minimiser λ_r = P(x̄/W_rr) with
/// ρ = 1/W_rr, x̄ the jump without its own part. Sweeps never increase q and converge for positive
/// definite W: the way out where active sets repeat. Equilibrium enters by an augmented Lagrangian
/// with multipliers α (the amounts of rigid motion): between two updates of α it is the augmented
/// energy q − αᵀ(Nᵀλ − e) + ½γ‖Nᵀλ − e‖² that never increases.
class DualDescent {
 public:
  /// Starts at the nearest admissible multipliers to `lambda`.
  DualDescent(const problem::Problem& problem, const problem::CondensedProblem& condensed,
              const algebra::Vector& lambda);

  /// One sweep over all rows.
  void sweep();
  /// α := α − γ(Nᵀλ − e); nothing without free bodies.
  void update_equilibrium();
  /// Moves to `candidate`, made admissible, if the energy is lower there.
  void take_if_lower(const algebra::Vector& candidate);

  const algebra::Vector& lambda() const { return lambda_; }
  const algebra::Vector& alpha() const { return alpha_; }
  /// The (augmented) jump: minus the gradient of the smooth part of the energy.
  const algebra::Vector& jump() const { return x_; }
  double energy() const { return energy_at(lambda_); }

 private:
  double energy_at(const algebra::Vector& lambda) const;
  algebra::Vector jump_at(const algebra::Vector& lambda) const;

  const problem::Problem& problem_;
  const problem::CondensedProblem& condensed_;
  double gamma_ = 0;
  algebra::DenseMatrix augmented_;  ///< W + γ N Nᵀ; empty without free bodies
  algebra::Vector lambda_, alpha_, x_;

  const algebra::DenseMatrix& W() const { return gamma_ > 0 ? augmented_ : condensed_.W(); }
};

}  // namespace dotyk::solver
