// One rank's rows of a matrix that stays as it is.
#pragma once

#include <vector>

#include "base/lists.hpp"
#include "multigrid/half_matrix.hpp"
#include "multigrid/slices.hpp"

namespace dotyk::multigrid {

/// Where a rank's rows are, as Numbering says.
struct SliceNumbers {
  int block = 1, first = 0, nodes = 0;  ///< rows of a node; own nodes
  std::vector<int> slot;                ///< row of each unknown of the rank's share
  std::vector<int> idle;                ///< own rows without unknown
};

/// The functions are collective, except the const ones.
class Slice {
 public:
  /// `share`: the lower triangle of the rank's share. Idle rows get the mean of the diagonal.
  Slice(const Ranks& ranks, const algebra::SparseMatrix& share, const SliceNumbers& numbers);

  const HalfRows& rows() const { return matrix_.stored(); }
  std::vector<double> diagonal() const;
  int most_entries() const;  ///< of a row
  /// Some own rows, counted from the rank's first.
  Rows some(const std::vector<int>& rows) const { return matrix_.full(rows); }

  enum class Product : int { plain, precise, gross };
  /// A x, or |A| x. Precise: x and the product are sums of two vectors, and extended precision is worked with. Vectors: of own rows.
  std::vector<std::vector<double>> times(Product how, const std::vector<std::vector<double>>& x);

 private:
  HalfMatrix matrix_;
};

}  // namespace dotyk::multigrid
