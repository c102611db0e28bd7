// One rank's rows of a matrix that stays as it is.
#pragma once

#include <vector>

#include "multigrid/rows/half_matrix.hpp"

namespace dotyk::multigrid {

/// The functions are collective, except the const ones.
class Slice {
 public:
  /// `idle`: own rows without unknown. Their diagonal becomes the mean of all others.
  Slice(const Ranks& ranks, HalfRows rows, const std::vector<int>& idle);

  const HalfRows& rows() const { return matrix_.stored(); }
  std::vector<double> diagonal() const;
  int most_entries() const;  ///< as in algebra::SlicedMatrix
  /// Some own rows, counted from the rank's first. Columns: counted over all ranks, idle ones among them.
  Rows some(const std::vector<int>& rows) const { return matrix_.full(rows); }

  enum class Product : int { plain, precise, gross };
  /// A x, or |A| x, of own rows. `precise`: in extended precision, where x and the product are each the sum of two vectors.
  std::vector<std::vector<double>> times(Product how, const std::vector<std::vector<double>>& x);

 private:
  HalfMatrix matrix_;
};

}  // namespace dotyk::multigrid
