#pragma once

#include "fclib/cone.hpp"
#include "solver/core/method.hpp"

namespace dotyk::fclib {

/// The problem as rows under laws, for the methods of the solver room: λ = r, x = −u = x₀ − Wλ, x₀ = −q; first
/// the normal rows of all contacts (unilateral), then their tangential ones (Coulomb).
struct Rows {
  problem::Problem problem;              ///< without blocks: B is rows × 0
  problem::CondensedProblem condensed;   ///< W and x₀ in that order
  std::vector<int> place;                ///< row of the contact problem → row here
};
Rows rows_of(const ContactProblem& problem);

struct Result {
  solver::Result iteration;  ///< as the method ended: its own residual, reason, history; rows in the order of Rows
  algebra::Vector r;         ///< rows of the contact problem
  Measure measure;           ///< of r
};
Result solve(const ContactProblem& problem, const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::fclib
