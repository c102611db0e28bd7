// Matrices whose rows the ranks make themselves, so that none of them has the whole.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "algebra/coarse_functions.hpp"
#include "algebra/symmetric_matrix.hpp"
#include "base/lists.hpp"

namespace dotyk::multigrid {

/// The cells of a process once more, refined as they were when the matrix was made, and a displacement of their nodes.
struct VisitedCells {
  static constexpr int kLayers = 3;  ///< about own nodes
  const algebra::Refinable& cells;
  const std::vector<int>& number;  ///< of each node, among those of all processes
  int first, end;                  ///< own nodes have these numbers
  const std::vector<double>& u;    ///< node × dimension, prescribed components too
  const std::vector<int>& told;    ///< numbers of nodes that rank 0 names
  int rank;
};
/// What they are visited for: see visit() in script/main.cpp.
enum class VisitFor : int { estimate, point, write };
/// Computes from these cells what this process tells rank 0. `said`: what rank 0 has told all processes.
using VisitCells = Lists (*)(const VisitedCells& at, const Lists& said);

/// What a process makes of a share.
struct ShareMakers {
  algebra::StoredMatrix (*assemble)(Lists lists);                        ///< the lower triangle of its matrix
  std::unique_ptr<algebra::Refinable> (*refinable)(Lists lists);         ///< cells that are to be refined first
  VisitCells (*visit)(VisitFor what) = nullptr;                          ///< for ranks other than 0, which are told what they are visited for
};

/// Calls visit(i, j) for pairs, some of them several times. It is called twice and gives the same pairs.
using EachPair = std::function<void(const std::function<void(int, int)>& visit)>;

/// What decides which rank gets which unknowns.
struct Coupling {
  const std::vector<int>& node;                    ///< of each unknown, ascending, as in Matrix
  const std::vector<algebra::CoarseFunctions>& coarse;  ///< as in Matrix; none: there is no coarser mesh
  const algebra::SparseRows& rows;                 ///< as in Matrix; none: nothing is coupled by rows
  EachPair each_pair;                              ///< of unknowns whose nodes the matrix couples; one unknown of each node is enough
  int weight = 5;                                  ///< work at a node that rows couple to others: it has about so many times the neighbours
};

/// A symmetric matrix that is to be assembled. Nothing of it is kept.
struct Shared {
  const Coupling& coupling;
  /// A share whose matrix has the right entries in rows of the flagged unknowns. Several threads call it.
  std::function<Share(const std::vector<char>& own)> share;
  ShareMakers makers;  ///< as the other ranks have them from work_for_rank_0()
  const algebra::Triplets& added;  ///< to the matrix of the shares: entries of the lower triangle, where it has some
};

/// A symmetric matrix on bodies that the ranks refine. Rank 0 has the functions of coarser meshes near the boundary only, where components may be prescribed: its
/// unknowns are those of the first one.
struct Refined {
  Shared base;  ///< the coarse bodies: all components of their nodes are unknowns; but `added` is to the matrix of the finest meshes, whose unknowns are here
  int times;    ///< the first `times` of the functions lead to these bodies
  const std::vector<algebra::CoarseFunctions>& coarse;  ///< `base.coupling.coarse` are the others, of all components
  bool loaded;  ///< do shares have a load?
};

/// Another visit to the cells that ranks have refined.
struct Visit {
  std::function<Share(const std::vector<char>& own)> share;  ///< as that of Refined::base, but with VisitedCells::kLayers layers of cells
  ShareMakers makers;
  VisitFor what;
  VisitCells make;          ///< for this process; the others have it from ShareMakers::visit
  const algebra::Field& u;  ///< it lies where the slices of such a matrix did
  std::vector<int> components;  ///< prescribed ones, node × dimension of all bodies as they are here
  std::vector<double> values;   ///< of these
  Lists said;              ///< what all ranks are told
  std::vector<int> nodes;  ///< as they are here, of all bodies; the ranks are told their numbers
};

/// Several ranks share the work where each has enough to do. One process saves memory where there are many unknowns: solvers take the matrix of the slices on
/// loan. False where the library was not built.
bool slices_pay_for(double unknowns);
/// Opens the library and starts PETSc. False where that fails: a solver says why.
bool starts();
/// Assembles the matrix on all ranks, each its own rows. To be called only where both are true.
std::shared_ptr<const algebra::SlicedMatrix> make_slices(const Shared& matrix);
/// The same after each rank has refined its share.
std::shared_ptr<const algebra::SlicedMatrix> make_refined_slices(const Refined& matrix);
/// Refines the cells of such a matrix once more, on all ranks. Returns what each rank tells.
std::vector<Lists> visit(const Visit& visit);

}  // namespace dotyk::multigrid
