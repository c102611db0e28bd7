#include "solver/interior_point.hpp"

#include <cmath>

#include "base/text.hpp"
#include "problem/residual.hpp"
#include "program/interior_point.hpp"
#include "solver/primal_program.hpp"

namespace dotyk::solver {
namespace {

/// What the laws' residual, relative to the forces, is to be: the gap is relative to the energy, and where bodies are displaced as
/// a whole that is far more than what presses them.
constexpr double kFine = 1e-8;
/// Beyond it the forces are no result.
constexpr double kMost = 1e-3;
/// Precisions are asked for until then, each a thousandth of the last.
constexpr double kLeastTol = 1e-17, kFiner = 1e-3;

program::Result solve_finely(const problem::Problem& problem, const PrimalProgram& primal, program::InteriorPoint options, Monitor& monitor) {
  program::Result best;
  double least = INFINITY;
  int iterations = 0;
  for (; options.tol > kLeastTol && !(least <= kFine); options.tol *= kFiner) {
    program::Result next = program::solve(primal.program(), options, monitor);
    iterations += next.iterations;
    const bool solved = next.status == program::Status::solved;
    const double law = solved ? problem::residual(problem, primal.state(next.x, next.y)).law : INFINITY;
    if (!solved && std::isinf(least)) return next;
    if (law < least) best = std::move(next), least = law;
    if (!solved || monitor.stop()) break;
  }
  best.iterations = iterations;
  if (least > kMost) {
    best.status = program::Status::stopped;
    best.reason = text("rounding leaves forces that violate their laws by ", least, ": bodies are displaced as a whole by far more than what presses "
                       "them (pdas and active_set know more of them)");
  }
  return best;
}

}  // namespace

Result solve(const problem::Problem& problem, const InteriorPoint& settings, Monitor& monitor) {
  return solve_primal(problem, "interior_point", settings.reduced, settings.ordering, monitor,
                      [&](const PrimalProgram& primal, Monitor& recorder) {
                        program::InteriorPoint options;
                        options.tol = settings.tol;
                        options.max_iterations = settings.max_iterations;
                        return solve_finely(problem, primal, options, recorder);
                      });
}

}  // namespace dotyk::solver
