#include "base/stopwatch.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

Result solve_linear(const problem::Problem& problem, algebra::Ordering ordering, Monitor& monitor) {
  Result result;
  result.method = "linear";
  const auto [rigid, note] = require_solvable(problem, result.clock, monitor);
  const problem::CondensedProblem condensed(problem, rigid, ordering, result.clock, monitor);  // onto nothing
  Stopwatch watch;
  result.state = {condensed.recover(algebra::Vector(0), algebra::Vector(0)), algebra::Vector(0)};
  result.clock.recover += watch.seconds();
  result.factor_bytes = condensed.factor_bytes();
  result.ordering = condensed.ordering();
  result.reason = "linear problem, solved directly" + (note.empty() ? "" : "; " + note);
  result.converged = true;
  return result;
}

}  // namespace dotyk::solver
