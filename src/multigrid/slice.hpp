// One rank's rows of a matrix that stays as it is.
#pragma once

#include <vector>

#include "multigrid/half_matrix.hpp"

namespace dotyk::multigrid {

/// The functions are collective, except the const ones.
class Slice {
 public:
  /// Idle rows, of this rank, get the mean of the diagonal.
  Slice(const Ranks& ranks, HalfRows rows, const std::vector<int>& idle);

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
