// Coarse matrices PᵀAP whose pattern is known, in which only some rows change.
#pragma once

#include <vector>

#include "base/buckets.hpp"
#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

/// The identity, with room for PᵀAP: a block of entries for each pair of coarse nodes that A couples by way of P. A is symmetric. PETSc's own symbolic
/// product works row by row in place of node by node, and takes a dozen times the memory.
OwnedMat coarse_matrix(Mat A, Mat P);

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

  int size_ = 1;     // of a coarse block
  Buckets support_;  // coarse node → the rows of P with entries in its columns
  Buckets first_;    // beside support_: the first of these entries
  // Room to work.
  struct Rows {  // some rows of numbers, one a member of the block
    double* at(int row, int size);
    void clear();
    std::vector<int> place, rows;  // place: of a row among `rows`, or -1
    std::vector<double> numbers;
  };
  Rows product_, sum_;
  std::vector<double> entry_;
};

}  // namespace dotyk::multigrid
