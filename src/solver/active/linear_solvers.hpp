#pragma once

#include <functional>
#include <memory>

#include "algebra/spd_solver.hpp"
#include "base/error.hpp"
#include "problem/row_basis.hpp"

namespace dotyk::solver {

/// What a linear solver is made from: the first matrix, in the basis where rows are unknowns, and the problem that it belongs to.
struct SpdSystem {
  const algebra::SparseMatrix& lower;  ///< positive definite: nothing held, but springs in the rows of bodies that nothing else holds
  const problem::Problem& problem;
  const problem::RowBasis& basis;
  Monitor& monitor;  ///< outlives the solver
};
using MakeSpdSolver = std::function<std::unique_ptr<algebra::SpdSolver>(const SpdSystem&)>;

/// Iterations did not solve a linear system.
struct NotSolved : InputError {
  using InputError::InputError;
};

/// A sparse Cholesky factor.
MakeSpdSolver factor(algebra::Ordering ordering);
/// Conjugate gradients with an incomplete Cholesky factor.
MakeSpdSolver incomplete_factor();
/// Conjugate gradients with algebraic multigrid. Making the solver throws InputError where its library was not built.
MakeSpdSolver algebraic_multigrid();

}  // namespace dotyk::solver
