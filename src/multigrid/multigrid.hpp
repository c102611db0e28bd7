// Conjugate gradients preconditioned by multigrid, by PETSc. PETSc stands in a library of its own, which is opened when
// the first solver is made.
#pragma once

#include <memory>
#include <vector>

#include "algebra/spd_solver.hpp"
#include "algebra/types.hpp"
#include "base/monitor.hpp"

namespace dotyk::multigrid {

/// What a hierarchy is built from. Nothing of it is kept.
struct Matrix {
  const algebra::SparseMatrix& lower;        ///< positive definite, lower triangle, compressed, no unknown held
  const std::vector<int>& node;              ///< of each unknown, ascending, as in problem::Block::node
  /// Modes of little energy, rigid motions; may have no columns. Six for all bodies together: each mode is an unknown of every node of aggregates.
  /// Rows are unknowns or, where there are coarser meshes, the functions of the last one.
  const algebra::DenseMatrix& near_kernel;
  /// Where the unknowns u' of `lower` are others than the displacements u that `near_kernel` and `coarse` are of, as jumps between bodies: the matrix for
  /// u, lower triangle, whose aggregates the hierarchy takes, and S with u' = S u.
  const algebra::SparseMatrix* displaced = nullptr;
  const algebra::SparseMatrix* unknowns = nullptr;
  /// Functions of coarser meshes, level by level: the first one's rows are displacements, the others' the columns before; columns in blocks of
  /// `dimension`, one a node. The last level is coarsened by aggregation where it is large, as the unknowns are where there is no coarser mesh.
  const std::vector<algebra::SparseRows>* coarse = nullptr;
  int dimension = 3;
};

/// Interpolations are chosen once, for the matrix that the solver is made from; set() computes the coarse matrices anew, with
/// coarse functions that vanish where unknowns are held (truncated multigrid).
///
/// solve() returns NaN where the matrix shows itself to be indefinite, or 1000 iterations do not suffice; Interrupted is thrown
/// where the monitor asks to stop, which each iteration asks. b must be 0 at held unknowns, and x is. Solvers may be used from
/// several threads, but wait for one another. Tolerances are met by the residual that conjugate gradients carry along, which below some
/// 1e-13 may be less than that of x.
class Solver : public algebra::SpdSolver {};

/// Throws InputError where the library was not built, which needs the package libpetsc-real-dev. The monitor must outlive the solver.
std::unique_ptr<Solver> make_solver(const Matrix& matrix, Monitor& monitor);

/// Whether the library was built. It is not opened for this answer.
bool available();

}  // namespace dotyk::multigrid
