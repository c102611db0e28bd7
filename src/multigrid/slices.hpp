// Matrices whose rows the ranks make themselves, so that none of them has the whole.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "algebra/coarse_functions.hpp"
#include "algebra/symmetric_matrix.hpp"
#include "base/lists.hpp"

namespace dotyk::multigrid {

/// Assembles the lower triangle of a share's matrix.
using Assemble = algebra::StoredMatrix (*)(Lists lists);

/// Calls visit(i, j) for pairs, some of them several times. It is called twice and gives the same pairs.
using EachPair = std::function<void(const std::function<void(int, int)>& visit)>;

/// What decides which rank gets which unknowns.
struct Coupling {
  const std::vector<int>& node;                    ///< of each unknown, ascending, as in Matrix
  const std::vector<algebra::CoarseFunctions>& coarse;  ///< as in Matrix; none: there is no coarser mesh
  const algebra::SparseRows& rows;                 ///< as in Matrix; none: nothing is coupled by rows
  EachPair each_pair;                              ///< of unknowns whose nodes the matrix couples; one unknown of each node is enough
};

/// A symmetric matrix that is to be assembled. Nothing of it is kept.
struct Shared {
  const Coupling& coupling;
  /// A share whose matrix has the right entries in rows of the flagged unknowns. Several threads call it.
  std::function<Share(const std::vector<char>& own)> share;
  Assemble assemble;  ///< as the other ranks have it from work_for_rank_0()
};

/// Several ranks share the work where each has enough to do. One process saves memory where there are many unknowns: solvers take the matrix of the slices on
/// loan. False where the library was not built.
bool slices_pay_for(double unknowns);
/// Opens the library and starts PETSc. False where that fails: a solver says why.
bool starts();
/// Assembles the matrix on all ranks, each its own rows. To be called only where both are true.
std::shared_ptr<const algebra::SlicedMatrix> make_slices(const Shared& matrix);

}  // namespace dotyk::multigrid
