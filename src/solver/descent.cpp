#include "solver/descent.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;
using problem::RowGroup;

void descend(const Problem& problem, const CondensedProblem& condensed, Vector& lambda, Vector& x) {
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const double w = condensed.W()(r, r);
      if (!(w > 0)) continue;  // a row that nothing moves
      const double minimiser = group.law->project(r - group.first, x[r] / w + lambda[r], 1 / w).lambda;
      x -= (minimiser - lambda[r]) * condensed.W().col(r);
      lambda[r] = minimiser;
    }
}

double dual_energy(const Problem& problem, const CondensedProblem& condensed, const Vector& lambda) {
  double q = 0.5 * lambda.dot(condensed.W() * lambda) - condensed.x0().dot(lambda);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      q += group.law->conjugate(r - group.first, lambda[r]);
  return q;
}

Vector admissible(const Problem& problem, const Vector& lambda) {
  Vector result(lambda.size());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      result[r] = group.law->project(r - group.first, lambda[r], 0).lambda;
  return result;
}

}  // namespace dotyk::solver
