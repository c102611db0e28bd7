#pragma once

#include "fclib/contact_problem.hpp"
#include "solver/core/method.hpp"

namespace dotyk::fclib {

/// The point of the cone {‖r_T‖ ≤ μ r_N} nearest to y = (y_N, y_T), 2 or 3 components.
Eigen::VectorXd project_cone(const Eigen::Ref<const Eigen::VectorXd>& y, double mu);

/// What a contact force r says of the problem.
struct Measure {
  algebra::Vector u;      ///< W r + q
  /// ‖r − P_K(r − ρ û)‖ / ‖r‖ (the numerator alone where r = 0), ρ = 1/max W_ii: the natural map with û = u + μ‖u_T‖ e_N.
  double residual = 0;
  /// Where r − ρ û lies: with u and r exact, open is r = 0; stick is u = 0; slip the rest.
  int open = 0, stick = 0, slip = 0;
};
Measure measure(const ContactProblem& problem, const algebra::Vector& r);

struct Result {
  /// As the method ended, its own residual, reason and history; first the normal rows of all contacts, then their
  /// tangential ones.
  solver::Result iteration;
  algebra::Vector r;  ///< rows of the contact problem
  Measure measure;    ///< of r
};
/// As rows under laws, unilateral and Coulomb's: λ = r, x = −u = x₀ − Wλ, x₀ = −q.
Result solve(const ContactProblem& problem, const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::fclib
