#include "solver/interior_point.hpp"

#include "base/stopwatch.hpp"
#include "program/interior_point.hpp"
#include "solver/primal_program.hpp"
#include "solver/require_solvable.hpp"

namespace dotyk::solver {

Result solve(const problem::Problem& problem, const InteriorPoint& settings, Monitor& monitor) {
  Result result;
  const problem::RigidMotions rigid = problem::rigid_motions(problem);
  const PrimalProgram primal(problem, rigid, "interior_point", settings.reduced, settings.ordering, result.clock, monitor);
  const std::string note = require_solvable(problem, rigid);
  Stopwatch watch;
  Recorder recorder(monitor, result.history);
  program::InteriorPoint options;
  options.tol = settings.tol;
  options.max_iterations = settings.max_iterations;
  const program::Result solved = program::solve(primal.program(), options, recorder);
  result.clock.iterate += watch.lap();
  take_over(problem, primal, solved, result);
  result.clock.recover += watch.lap();
  result.method = "interior_point";
  if (!note.empty()) result.reason += "; " + note;
  return result;
}

}  // namespace dotyk::solver
