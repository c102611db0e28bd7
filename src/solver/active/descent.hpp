#pragma once

#include "solver/rows/equilibrium.hpp"
#include "solver/rows/psor.hpp"

namespace dotyk::solver {

/// The nearest admissible multipliers: P(λ) at ρ = 0, row by row.
algebra::Vector admissible(const problem::Problem& problem, const algebra::Vector& lambda);

/// Descends the dual energy of a condensed problem,
///   q(λ) = ½λᵀWλ − x₀ᵀλ + Σ φ*_r(λ_r)    subject to Nᵀλ = e (the equilibrium of free bodies),
/// by Gauss–Seidel sweeps (Relaxation, ω = 1): each row in turn takes its exact minimiser. Sweeps never
/// increase q and converge for positive definite W: the way out where active sets repeat. Equilibrium
/// enters by an augmented Lagrangian (Equilibrium) with multipliers α, the amounts of rigid motion: between
/// two updates of α it is the augmented energy that never increases. Scalar laws only.
class DualDescent {
 public:
  /// Starts at the nearest admissible multipliers to `lambda`.
  DualDescent(const problem::Problem& problem, const problem::CondensedProblem& condensed,
              const algebra::Vector& lambda);

  /// One sweep over all rows.
  void sweep() { relaxation_.sweep(1, lambda_, x_); }
  /// The next α; nothing without free bodies.
  void update_equilibrium();
  /// Moves to `candidate`, made admissible, if the energy is lower there.
  void take_if_lower(const algebra::Vector& candidate);

  const algebra::Vector& lambda() const { return lambda_; }
  algebra::Vector alpha() const { return equilibrium_.at(lambda_).alpha; }
  /// The (augmented) jump: minus the gradient of the smooth part of the energy.
  const algebra::Vector& jump() const { return x_; }
  double energy() const { return energy_at(lambda_); }

 private:
  double energy_at(const algebra::Vector& lambda) const;
  algebra::Vector jump_at(const algebra::Vector& lambda) const { return equilibrium_.x0() - equilibrium_.W() * lambda; }

  const problem::Problem& problem_;
  Equilibrium equilibrium_;
  Relaxation relaxation_;
  algebra::Vector lambda_, x_;
};

}  // namespace dotyk::solver
