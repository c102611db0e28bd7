#include "solver/programs/interior_point.hpp"

#include "problem/residual.hpp"
#include "program/interior_point.hpp"
#include "solver/programs/primal_program.hpp"

namespace dotyk::solver {
namespace {

/// What the laws' residual, relative to the forces, is to be: the gap is relative to the energy, and where bodies are displaced as
/// a whole that is far more than what presses them.
constexpr double kFine = 1e-8;

}  // namespace

Result solve(const problem::Problem& problem, const InteriorPoint& settings, Monitor& monitor) {
  return solve_primal(problem, "interior_point", settings.reduced, settings.ordering, monitor,
                      [&](const PrimalProgram& primal, Monitor& recorder) {
                        program::InteriorPoint options;
                        options.tol = settings.tol;
                        options.max_iterations = settings.max_iterations;
                        options.fine = [&](const algebra::Vector& x, const algebra::Vector& y) {
                          return problem::residual(problem, primal.state(x, y)).law <= kFine;
                        };
                        return program::solve(primal.program(), options, recorder);
                      });
}

}  // namespace dotyk::solver
