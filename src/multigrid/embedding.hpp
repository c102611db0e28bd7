// Unknowns in blocks of one size, one block a node: what PETSc aggregates.
#pragma once

#include <vector>

#include "algebra/types.hpp"

namespace dotyk::multigrid {

/// The full matrix, by rows, that a lower triangle stands for. A node with fewer unknowns than others has idle slots after them,
/// which are coupled with nothing; their diagonal is the mean of the first matrix's.
class Embedding {
 public:
  Embedding(const algebra::SparseMatrix& lower, const std::vector<int>& node);

  /// Takes the numbers of a matrix of the same pattern, and flags the rows in which one differs. False, and nothing is taken, where
  /// an entry of the diagonal is not positive.
  bool fill(const algebra::SparseMatrix& lower, std::vector<char>& changed);

  int block() const { return block_; }
  int rows() const { return static_cast<int>(starts_.size()) - 1; }
  const std::vector<int>& slot() const { return slot_; }       ///< of each unknown, ascending
  const std::vector<int>& idle() const { return idle_; }       ///< slots without unknown
  std::vector<int>& starts() { return starts_; }
  std::vector<int>& columns() { return columns_; }
  std::vector<double>& values() { return values_; }
  double bytes() const;

 private:
  void number(const std::vector<int>& node);
  void lay_out(const algebra::SparseMatrix& lower);
  template <class Visit>
  void for_each_entry(const algebra::SparseMatrix& lower, Visit&& visit);

  int block_ = 1;
  std::vector<int> slot_, idle_;
  std::vector<int> starts_, columns_;
  std::vector<double> values_;
};

}  // namespace dotyk::multigrid
