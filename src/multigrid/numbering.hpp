// Which process has which unknowns.
#pragma once

#include <vector>

#include "multigrid/multigrid.hpp"

namespace dotyk::multigrid {

/// Numbers of the rows of all levels: unknowns in blocks of one size, one block a node, those of a rank one after the other. A node of the finest level with
/// fewer unknowns than others has idle slots after them. Among several ranks nodes are shared out by METIS (Karypis, Kumar 1998) on the
/// coarsest mesh that has enough of them; a node of a finer mesh goes with that of the coarser one that gives it most. Meshes that are coarser still
/// are rank 0's.
class Numbering {
 public:
  Numbering(const Matrix& matrix, int ranks);

  int block() const { return block_; }                                   ///< of the finest level
  const std::vector<int>& slot() const { return slot_; }                 ///< row of each unknown
  const std::vector<int>& idle() const { return idle_; }                 ///< rows without unknown
  /// Row of each column of the functions that lead to `level` ≥ 1.
  const std::vector<int>& functions(int level) const { return functions_[level - 1]; }
  /// Of each rank the first row, and the number of all.
  const std::vector<int>& first(int level) const { return first_[level]; }
  int rank_of(int row) const;  ///< of the finest level

 private:
  int block_ = 1;
  std::vector<int> slot_, idle_;
  std::vector<std::vector<int>> functions_, first_;
};

}  // namespace dotyk::multigrid
