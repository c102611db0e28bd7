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
  /// Sets λ and x = Bu − c. False where the linear problem is singular (the active rows
  /// depend on each other beyond repair, or do not hold a body).
  virtual bool solve(const Linearisation& l, algebra::Vector& lambda, algebra::Vector& x) = 0;
  /// Makes the last solution as exact as it can be, where it was not; false where it is.
  virtual bool sharpen(algebra::Vector& /*lambda*/, algebra::Vector& /*x*/) { return false; }
  /// The whole u that belongs to the last solve().
  virtual algebra::Vector recover() = 0;
};

/// On the condensed problem: dense, of the size of the active set (TR965 (1.68)–(1.69)).
std::unique_ptr<Step> reduced_step(const problem::CondensedProblem& condensed,
                                   const algebra::Vector& rho);

/// On the unknowns alone (see HeldStiffness), where rows act on few unknowns each. An active rigid row of one unknown holds it, and its λ is what
/// equilibrium leaves there; a row with compliance is a spring. Rigid rows of several unknowns, and those whose unknown is held already, are springs to which conjugate gradients
/// add the forces that keep them closed. One sparse Cholesky factorisation in each iteration. Dependent rows get some multipliers, not refused.
std::unique_ptr<Step> held_step(const problem::Problem& problem, HeldStiffness& stiffness, const algebra::Vector& rho);

}  // namespace dotyk::solver
