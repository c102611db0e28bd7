#pragma once

#include <string>
#include <vector>

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Newton steps from one iterate to the next, kept from going astray. The merit of an iterate is the norm of
/// the natural map in scaled unknowns (natural_map.hpp).
///
/// Damping: whole steps change many pieces at once, and may well increase the merit on the way. The first
/// few are damped only where it would exceed all of its last values twice; later ones until it decreases.
///
/// Singular derivatives: where the pieces leave a rigid motion free (nothing closed, all slips), springs hold
/// the bodies where they are: Qᵀv = ê becomes Qᵀv + δ(a − a₀) = ê, a step of the proximal point method,
/// whose derivative is regular whatever the pieces. The springs are let go when its problem is nearly solved.
///
/// Where the derivative is singular for another reason (Coulomb friction with a great coefficient), or
/// no damped step decreases the merit, steps of the fixed point iteration λ := λ + θ(P(λ + ρx) − λ) take over.
class NewtonStepper {
 public:
  NewtonStepper(RowIteration& iteration, bool watch) : it_(iteration), watch_(watch) {}

  /// Moves to the solution of the problem linearised in `v`, where it has one.
  void start(const NaturalMap::Value& v);
  void step();
  /// Of the last step's derivative G: exact when watched, else 1/‖G⁻¹‖₁ as estimated from its factors. 1, that
  /// of the identity, where everything is open.
  double singular_value() const { return singular_value_; }
  /// Rounds of the fixed point iteration.
  int stuck() const { return singular_ + stuck_; }
  /// What had to be done beyond Newton steps.
  std::vector<std::string> remarks() const;

 private:
  struct Place {
    algebra::Vector lambda, alpha;
  };
  bool held() const { return anchor_.size() > 0; }
  double merit() const;
  bool linear_solve(const NaturalMap::Value& v, Place& solution);
  bool damped_step_to(const Place& solution);
  void fixed_point_steps();

  RowIteration& it_;
  const bool watch_;
  double singular_value_ = 1;
  std::vector<double> merits_;  ///< the last few
  algebra::Vector anchor_;      ///< a₀ of the springs; empty: none
  int held_ = 0, singular_ = 0, stuck_ = 0;
};

}  // namespace dotyk::solver
