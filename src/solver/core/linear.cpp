#include <algorithm>

#include "algebra/direct/cholesky.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "problem/condensed.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

namespace {

/// Blocks that are free, with loads in equilibrium: by condensation onto nothing.
void solve_free(const problem::Problem& problem, algebra::Ordering ordering, Monitor& monitor, Result& result) {
  const auto [rigid, note] = require_solvable(problem, result.clock, monitor);
  if (!note.empty()) result.reason += "; " + note;
  const problem::CondensedProblem condensed(problem, rigid, ordering, result.clock, monitor);
  Stopwatch watch;
  result.state.u = condensed.recover(algebra::Vector(0), algebra::Vector(0));
  result.clock.recover += watch.seconds();
  result.factor_bytes = condensed.factor_bytes();
  result.ordering = condensed.ordering();
}

void solve_block(const problem::Block& block, algebra::Ordering ordering, Monitor& monitor, Result& result) {
  Stopwatch watch;
  monitor.phase(text("ordering '", block.name, "' (", block.size(), " unknowns)"));
  algebra::Cholesky cholesky(block.K, block.node, {}, ordering);
  result.clock.ordering += watch.lap();
  monitor.check();
  monitor.phase(text("factoring '", block.name, "' (", cholesky.method(), ", ", cholesky.flops() * 1e-9,
                     " Gflop)"));
  const algebra::StopFactoring stop(monitor);
  if (!cholesky.factor(block.K)) problem::refuse_singular(block, cholesky.failed_unknown());
  result.clock.factor += watch.lap();
  monitor.check();
  result.state.u.change().segment(block.first, block.size()) = cholesky.solve(block.f);
  result.clock.recover += watch.lap();
  result.factor_bytes += cholesky.bytes();
  result.ordering = cholesky.method();
}

}  // namespace

Result solve_linear(const problem::Problem& problem, algebra::Ordering ordering, Monitor& monitor) {
  Result result;
  result.method = "linear";
  result.state.u = algebra::Vector(problem.unknowns());
  result.state.lambda.resize(0);
  result.reason = "linear problem, solved directly";
  const bool free = std::any_of(problem.blocks.begin(), problem.blocks.end(), [](const auto& block) { return block.kernel.cols() > 0; });
  if (free)
    solve_free(problem, ordering, monitor, result);
  else
    for (const problem::Block& block : problem.blocks) solve_block(block, ordering, monitor, result);
  result.converged = true;
  return result;
}

}  // namespace dotyk::solver
