// The entries of a rank's rows in columns of other ranks.
#pragma once

#include <vector>

#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

/// The part of a matrix that couples rows of this rank to rows of others, with its numbers at the time. There are no rows where there is one rank. All functions
/// are collective, except rows().
class Border {
 public:
  explicit Border(Mat A);

  const std::vector<int>& rows() const { return rows_; }  ///< those with such entries, counted from the rank's first, ascending
  /// The numbers of A now.
  void fetch(Mat A);
  /// The product with v, at rows().
  const std::vector<double>& times(Vec v);

 private:
  std::vector<int> rows_, starts_{0}, columns_;
  std::vector<double> values_, product_;
  OwnedVec theirs_;  ///< v at the columns
  Owned<VecScatter, VecScatterDestroy> scatter_;
};

}  // namespace dotyk::multigrid
