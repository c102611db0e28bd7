// Coarse matrices PᵀAP whose pattern is known, in which only some rows change.
#pragma once

#include <vector>

#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

/// PETSc's own product knows neither that unknowns come in blocks nor that rows stay. Seconds of a set() on a cube of 200 000
/// unknowns: 1.2 by PETSc's, 0.6 here where all rows are new, 0.02 to 0.2 where a disc on the top is held or let go.
class Galerkin {
 public:
  /// `coarse` has the pattern of PᵀAP; its blocks are the coarse nodes.
  Galerkin(Mat interpolation, Mat coarse);

  /// Computes the rows of `coarse` that depend on the given fine rows of A and P. Returns a flag for each coarse row: computed.
  std::vector<char> compute(Mat fine, Mat interpolation, Mat coarse, const std::vector<char>& changed);

  double bytes() const;

 private:
  template <int fixed>
  void compute_block(int block, const RowsView& A, const RowsView& P, RowsView& C);

  int size_ = 1;                             // of a coarse block
  std::vector<int> support_start_, support_;  // of each block: fine rows that P leads to
  std::vector<int> first_;                    // beside support_: the row's first entry of that block in P
  // Room to work: rows of numbers, one a member of the block, and which of them are in use.
  std::vector<double> product_, sum_, entry_;
  std::vector<char> in_product_, in_sum_;
  std::vector<int> product_rows_, sum_rows_;
};

}  // namespace dotyk::multigrid
