#include "solver/active/linear_solvers.hpp"

#include "multigrid/multigrid.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using problem::Block;
using problem::Problem;

namespace {

/// The rigid motions of all bodies moving as one. No columns if a block has no function `rigid`.
DenseMatrix all_rigid_motions(const Problem& problem) {
  DenseMatrix all(problem.unknowns(), 0);
  for (const Block& block : problem.blocks) {
    if (!block.rigid) return DenseMatrix(problem.unknowns(), 0);
    const DenseMatrix own = block.rigid();
    if (all.cols() == 0) all.setZero(problem.unknowns(), own.cols());
    all.middleRows(block.first, block.size()) = own;
  }
  return all;
}

/// The stiffness, definite also where nothing holds a body.
SparseMatrix held_slightly(const Problem& problem) {
  constexpr double kSlightly = 1e-8;
  SparseMatrix K = problem::lower_stiffness(problem);
  K.diagonal() *= 1 + kSlightly;
  return K;
}

}  // namespace

MakeSpdSolver factor(algebra::Ordering ordering) {
  return [ordering](const SpdSystem& s) { return algebra::factored(s.lower, problem::nodes(s.problem), ordering); };
}

MakeSpdSolver incomplete_factor() {
  return [](const SpdSystem& s) { return algebra::incompletely_factored(s.monitor); };
}

MakeSpdSolver algebraic_multigrid() {
  return [](const SpdSystem& s) -> std::unique_ptr<algebra::SpdSolver> {
    const std::vector<int> nodes = problem::nodes(s.problem);
    const DenseMatrix motions = all_rigid_motions(s.problem);
    if (s.basis.trivial()) return multigrid::make_solver({s.lower, nodes, motions}, s.monitor);
    const SparseMatrix K = held_slightly(s.problem), unknowns = s.basis.of_displacements(s.problem);
    return multigrid::make_solver({s.lower, nodes, motions, &K, &unknowns}, s.monitor);
  };
}

}  // namespace dotyk::solver
