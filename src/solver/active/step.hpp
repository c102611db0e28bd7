#pragma once

#include <memory>

#include "problem/condensed.hpp"
#include "solver/active/linearisation.hpp"

namespace dotyk::solver {

class HeldStiffness;

/// One linear problem of PDAS: equilibrium with the laws linearised.
class Step {
 public:
  virtual ~Step() = default;
  /// A displacement near the solution, for steps that iterate.
  virtual void begin(const problem::Displacement& /*u*/) {}
  /// Sets λ and x = Bu − c. False where the linear problem is singular (the active rows
  /// depend on each other beyond repair, or do not hold a body).
  virtual bool solve(const Linearisation& l, algebra::Vector& lambda, algebra::Vector& x) = 0;
  /// Makes the last solution more exact, and all that follow at least as exact; false where it is as exact as it can be.
  virtual bool sharpen(algebra::Vector& /*lambda*/, algebra::Vector& /*x*/) { return false; }
  /// Takes u back towards that of the solve before the last: this part of the way is left. For steps that take friction.
  virtual void go_back(double /*part*/) {}
  /// The whole u that belongs to the last solve().
  virtual problem::Displacement recover() = 0;
};

/// On the condensed problem: dense, of the size of the active set (TR965 (1.68)–(1.69)).
std::unique_ptr<Step> reduced_step(const problem::CondensedProblem& condensed,
                                   const algebra::Vector& rho);

/// Solves on all unknowns, in the basis where rows are unknowns (see HeldStiffness). An active rigid row holds its unknown, and its λ is the force
/// that equilibrium needs there. A row with compliance is a spring. Rigid rows without an unknown of their own are springs to which conjugate gradients add the
/// forces that keep them closed. A point that slips has the force that its bound allows, which may follow the pressure. Dependent rows get some
/// multipliers, not refused. `tol` as in Settings: where digits cost iterations, forces are left that are small beside it. Throws NotSolved where a friction
/// row has no unknown of its own.
std::unique_ptr<Step> held_step(const problem::Problem& problem, HeldStiffness& stiffness, const algebra::Vector& rho, double tol);

}  // namespace dotyk::solver
