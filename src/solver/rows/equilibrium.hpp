#pragma once

#include <functional>

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// The equilibrium of free bodies, Nᵀλ = e, by an augmented Lagrangian, so that a method sees rows without
/// rigid motions. With N = QR, Q orthonormal, ê = R⁻ᵀe and
///   α(λ) = α − γ R⁻¹(Qᵀλ − ê)
/// the jump x₀ − Wλ + Nα(λ) equals x₀' − W'λ with
///   W' = W + γ QQᵀ,    x₀' = x₀ + Nα + γ Q ê,
/// minus the gradient of ½λᵀWλ − x₀ᵀλ − αᵀ(Nᵀλ − e) + ½γ‖Qᵀλ − ê‖². γ is in displacement per force; where
/// it is the greatest eigenvalue of W, W' has none that is greater by more than the factor two. Without
/// free bodies W' = W, x₀' = x₀, and nothing is stored or updated.
class Equilibrium {
 public:
  /// γ = `weight` times (a bound of) the greatest eigenvalue of W; α = 0, or such that α(λ) is that of an iteration which begins at a state.
  explicit Equilibrium(const problem::CondensedProblem& condensed, double weight = 1.0);
  explicit Equilibrium(const RowIteration& iteration, double weight = 1.0);

  bool needed() const { return condensed_.kernel_size() > 0; }
  const algebra::DenseMatrix& W() const { return needed() ? augmented_ : condensed_.W(); }
  algebra::Vector x0() const;
  /// 2/λ_max(D^½W'D^½), D the diagonal matrix of `stiffness` > 0: steps x ↦ λ + ρDx of projected gradients
  /// contract for ρ below. The eigenvalue is estimated from above; 2 where W is zero.
  double step_bound(const algebra::Vector& stiffness) const;
  /// (λ, α(λ)).
  Iterate at(algebra::Vector lambda) const;
  /// ‖Qᵀλ − ê‖, a force: how far λ is from balancing the loads.
  double unbalanced(const algebra::Vector& lambda) const { return needed() ? excess(lambda).norm() : 0; }
  /// α := α(λ), the multiplier's first-order update.
  void update(const algebra::Vector& lambda) { alpha_ = alpha(lambda); }
  /// Updates where the iterate's rows are solved precisely enough for it: where their own residual (a force) is
  /// below a third of what is out of balance. True where it did; the iterate then has the new α(λ).
  bool settle(RowIteration& iteration);

 private:
  algebra::Vector excess(const algebra::Vector& lambda) const { return Q_.transpose() * lambda - e_; }
  algebra::Vector alpha(const algebra::Vector& lambda) const;

  const problem::CondensedProblem& condensed_;
  double gamma_ = 0;
  algebra::DenseMatrix Q_, R_, augmented_;
  algebra::Vector e_, alpha_;
};

/// A stationary iteration λ := next(λ, x), x the augmented jump at λ, from the iterate at hand until it converges, stalls or may not go on.
void iterate(RowIteration& iteration, Equilibrium& equilibrium,
             const std::function<algebra::Vector(algebra::Vector lambda, algebra::Vector x)>& next);

}  // namespace dotyk::solver
