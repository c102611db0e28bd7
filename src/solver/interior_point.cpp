#include "solver/interior_point.hpp"

#include "program/interior_point.hpp"
#include "solver/primal_program.hpp"

namespace dotyk::solver {

Result solve(const problem::Problem& problem, const InteriorPoint& settings, Monitor& monitor) {
  return solve_primal(problem, "interior_point", settings.reduced, settings.ordering, monitor,
                      [&](const PrimalProgram& primal, Monitor& recorder) {
                        program::InteriorPoint options;
                        options.tol = settings.tol;
                        options.max_iterations = settings.max_iterations;
                        return program::solve(primal.program(), options, recorder);
                      });
}

}  // namespace dotyk::solver
