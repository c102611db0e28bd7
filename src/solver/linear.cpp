#include "algebra/cholesky.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "solver/solver.hpp"

namespace dotyk::solver {

namespace {

/// "translation along y and rotation about (0.5, 0)".
std::string all(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t k = 0; k < names.size(); ++k)
    out += (k == 0 ? "" : k + 1 < names.size() ? ", " : " and ") + names[k];
  return out;
}

}  // namespace

Result solve_linear(const problem::Problem& problem, algebra::Ordering ordering, Monitor& monitor) {
  Result result;
  result.method = "linear";
  result.state.u.resize(problem.unknowns());
  result.state.lambda.resize(0);
  for (const problem::Block& block : problem.blocks) {
    if (block.kernel.cols() > 0)
      throw InputError(text("'", block.name, "' is not held: nothing stops its ", all(block.kernel_names),
                            "; fix a part of it or put it in contact"));
    Stopwatch watch;
    monitor.phase(text("ordering '", block.name, "' (", block.size(), " unknowns)"));
    algebra::Cholesky cholesky(block.K, block.node, {}, ordering);
    result.clock.ordering += watch.lap();
    monitor.check();
    monitor.phase(text("factoring '", block.name, "' (", cholesky.method(), ", ",
                       cholesky.flops() * 1e-9, " Gflop)"));
    if (!cholesky.factor(block.K))
      throw InputError(text("the stiffness of '", block.name, "' is singular near node ",
                            block.node[cholesky.failed_unknown()] + 1,
                            ": a material, spring or mesh value is out of range"));
    result.clock.factor += watch.lap();
    monitor.check();
    result.state.u.segment(block.first, block.size()) = cholesky.solve(block.f);
    result.clock.recover += watch.lap();
    result.factor_bytes += cholesky.bytes();
    result.ordering = cholesky.method();
  }
  result.converged = true;
  result.reason = "linear problem, solved directly";
  return result;
}

}  // namespace dotyk::solver
