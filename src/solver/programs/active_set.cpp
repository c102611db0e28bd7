#include "solver/programs/active_set.hpp"

#include "program/active_set.hpp"
#include "solver/active/linearisation.hpp"
#include "solver/programs/primal_program.hpp"

namespace dotyk::solver {
namespace {

/// The first working set: the rows flagged, or those that touch at rest.
program::ActiveSet options(const problem::Problem& problem, const ActiveSet& settings, const PrimalProgram& primal) {
  program::ActiveSet out;
  out.change = settings.change == ActiveSet::Change::one ? program::ActiveSet::Change::one
                                                         : program::ActiveSet::Change::many;
  out.start = program::ActiveSet::Start::cold;
  out.tol = settings.tol;
  out.max_iterations = settings.max_iterations;
  const program::QuadraticProgram& p = primal.program();
  const std::vector<char> first = first_active(problem, settings.start);
  for (int k = 0; k < p.rows(); ++k) {
    out.working.push_back(p.equality(k) ? program::Side::equal : first[primal.rows()[k]] ? program::Side::high : program::Side::free);
  }
  if (settings.start.empty()) out.point = algebra::Vector::Zero(p.unknowns());
  return out;
}

}  // namespace

Result solve(const problem::Problem& problem, const ActiveSet& settings, Monitor& monitor) {
  WorkingSetCounts counts;
  Result result = solve_primal(
      problem, "active_set", settings.reduced, settings.ordering, monitor,
      [&](const PrimalProgram& primal, Monitor& recorder) {
        program::Result solved = program::solve(primal.program(), options(problem, settings, primal), recorder);
        counts = {solved.added,    solved.dropped,        solved.singular,
                  solved.survived, solved.factorisations, solved.repeats};
        return solved;
      });
  if (settings.change == ActiveSet::Change::many) result.method = "active_set (many)";
  result.working_set = counts;
  return result;
}

}  // namespace dotyk::solver
