// Conjugate gradients preconditioned by multigrid. The library that does it needs PETSc and MPI, and is opened when the first
// solver or the first slices are made.
#pragma once

#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "algebra/coarse_functions.hpp"
#include "algebra/spd_solver.hpp"
#include "algebra/symmetric_matrix.hpp"
#include "base/error.hpp"
#include "base/monitor.hpp"
#include "multigrid/slices.hpp"

namespace dotyk::multigrid {

/// The library was not built, or cannot be opened.
struct Unavailable : InputError {
  using InputError::InputError;
};

/// What a hierarchy is built from. It is needed only while the hierarchy is built; slices lend it their matrix for longer.
struct Matrix {
  const algebra::SparseMatrix& lower;        ///< lower triangle, compressed, columns sorted, no unknown held; positive definite but for `changed`
  const std::vector<int>& node;              ///< of each unknown, ascending, as in problem::Block::node
  /// A column for each rigid motion; there may be none. Rows are unknowns or, where there are coarser meshes, the functions of the coarsest. All bodies
  /// move as one, so that there are six: each column is an unknown of every aggregate. Called where there are aggregates.
  std::function<algebra::DenseMatrix()> near_kernel;
  /// Where the unknowns u' of `lower` are others than the displacements u that `near_kernel` and `coarse` are of, as jumps between bodies: the matrix for
  /// u, lower triangle, whose aggregates the hierarchy takes, and S with u' = S u.
  const algebra::SparseMatrix* displaced = nullptr;
  const algebra::SparseMatrix* unknowns = nullptr;
  /// The functions of coarser meshes: the first ones give displacements by the functions of the next coarser mesh, the second ones those functions by the
  /// ones of the mesh after it, and so on. Where the coarsest level is still large, aggregates follow. Null: there is no coarser mesh, and all levels are
  /// aggregates.
  const std::vector<algebra::CoarseFunctions>* coarse = nullptr;
  /// Receives the matrix of the next coarser mesh: PᵀKP, in slices except where several ranks would have too little work. K is the matrix of displacements,
  /// that of the slices or SᵀAS for A = `lower` and S = `unknowns`, without `changed`; P the first of `coarse` without its empty columns. It stays as it is
  /// where `coarse` is null. Null: nobody asks.
  algebra::SymmetricMatrix* coarser = nullptr;
  /// Rows of interfaces, of displacements: unknowns that one of them couples stay together where ranks share them out. Null: none.
  const algebra::SparseRows* rows = nullptr;
  /// Other numbers of some entries, as for set(), with which `lower` is positive definite; null: none.
  const algebra::Triplets* changed = nullptr;
  /// The matrix K of displacements as the ranks have it, by make_slices() from the same `node`, `rows` and `coarse`, of which these may be the first ones; of `lower` only the size counts then, and
  /// `displaced` is not needed. Null: `lower` is the matrix.
  const algebra::SlicedMatrix* slices = nullptr;
  /// Entries in which the matrix differs from K, as those of rows that have become unknowns. K's pattern may lack them. Null: none.
  const algebra::Triplets* beside_slices = nullptr;
  /// solve() gives up when its rate of convergence foretells that twelve digits will take so many more.
  double most_iterations = std::numeric_limits<double>::infinity();
};

/// Interpolations are chosen once, for the matrix that the solver is made from; set() computes the coarse matrices anew, with
/// coarse functions that vanish where unknowns are held (truncated multigrid).
///
/// solve() returns NaN where the matrix shows itself to be indefinite, after 1000 iterations, or when it gives up by `most_iterations`. Interrupted is thrown
/// where the monitor, which must outlive the solver, asks to stop; each iteration asks it. b must be 0 at held unknowns, and x is. Solvers may be
/// used from several threads, but wait for one another. Tolerances are met by the residual that conjugate gradients carry along, which below some
/// 1e-13 may be less than that of x.
///
/// Throws Unavailable where the library was not built, which needs the package libpetsc-real-dev, or cannot be opened.
std::unique_ptr<algebra::SpdSolver> make_solver(const Matrix& matrix, Monitor& monitor);

/// Whether the library was built. It is not opened for this answer.
bool available();
/// Of address space, which opening it takes; 0 once it is open.
double bytes_to_open();

/// One script, many processes: rank 0 runs it, the others work for its solvers. Which of the processes that mpirun started this is, and how many there are: 0 where it was not mpirun.
struct RankAmong {
  int rank = 0, ranks = 0;
};
inline RankAmong rank_by_mpirun() {
  const auto number = [](const char* variable, int otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::atoi(text) : otherwise;
  };
  return {number("OMPI_COMM_WORLD_RANK", 0), number("OMPI_COMM_WORLD_SIZE", 0)};
}

/// For ranks other than 0: works until rank 0 ends. A failure on one rank ends the program on all, with a message and status 1. `spawned`: by
/// start_ranks(), else by mpirun. `makers` make the rows of slices. All these functions throw InputError where the library was not built.
void work_for_rank_0(bool spawned, const ShareMakers& makers);
/// For rank 0 under mpirun: meets the others, and lets them go when the program ends, also by std::exit.
void meet_ranks();

/// Says that this program, started with the word --worker, calls work_for_rank_0(true, …).
void take_word_worker();
/// Starts other processes of this program on this machine, so that there are `ranks`. Throws InputError where the program does not take the word, where MPI
/// cannot start them, after the first solution by multigrid, and where it has already started another number of ranks. Does nothing under mpirun.
void start_ranks(int ranks);
int count_ranks();

}  // namespace dotyk::multigrid
