// The cells that a rank refines itself, and how their nodes are numbered over all ranks.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "algebra/coarse_functions.hpp"
#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/own_functions.hpp"

namespace dotyk::multigrid {

/// Prescribed components: of each node that has some a bit for each.
using PrescribedBits = std::unordered_map<int, int>;
/// From rows, node × dimension + component.
PrescribedBits prescribed_bits(const std::vector<int>& rows, int dimension);

/// One rank's cells about its own nodes. Nodes of all ranks are numbered so that those of a rank follow one another. A node of a finer mesh is known by its
/// parents, the nodes whose mean it is. The rank of the parent with the least number owns it, or the rank of the one with the greatest. The rank that owns a
/// node has all cells about it.
class RefinedShare {
 public:
  /// `dimension`: how many components a node has. `number`: the number of each node of the cells. `first`: the first node of each rank, then how many nodes there
  /// are in all. `layers`: how many layers of cells about own nodes are given and kept.
  RefinedShare(const Ranks& ranks, std::unique_ptr<algebra::Refinable> cells, int dimension, std::vector<int> number, std::vector<int> first, int layers = 1);

  /// Refines once, and keeps the cells about own nodes. The numbers of nodes do not depend on how many layers there are. `asked`: nodes of the finer mesh, each by
  /// the numbers of its parents, ascending. Returns the numbers of these nodes. Collective.
  std::vector<int> refine(const Rows& asked);

  /// The first node of each rank, and the number of all, by level: the finest mesh first, the constructor's last.
  const std::vector<std::vector<int>>& first() const { return first_; }
  /// The rows of P, see OwnFunctions, that lead from the level after `level` to it.
  OwnFunctions functions(int level, const PrescribedBits& prescribed, const PrescribedBits& coarse_prescribed) const;
  const algebra::Refinable& cells() const { return *cells_; }
  const std::vector<int>& number() const { return number_; }  ///< of each node of the cells
  /// A vector of own rows of the finest level at the nodes of the cells. Collective.
  std::vector<double> at_nodes(const std::vector<double>& own) const;

  struct Assembled {
    HalfRows rows;
    std::vector<double> load;  ///< empty: the cells have none
  };
  /// Own rows of the stiffness and of the load of the finest level, zero at prescribed components. The cells are gone then.
  Assembled assemble(const PrescribedBits& prescribed);

 private:
  const Ranks& ranks_;
  std::unique_ptr<algebra::Refinable> cells_;
  const int dimension_, layers_;
  std::vector<int> number_;               ///< of each node of the cells
  std::vector<std::vector<int>> first_;
  std::vector<Rows> means_;               ///< by level, of own nodes: numbers of the level after it
};

}  // namespace dotyk::multigrid
