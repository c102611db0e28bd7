#pragma once

#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// The rows `picked` of a matrix, in this order.
inline SparseRows pick_rows(const SparseRows& rows, const std::vector<int>& picked) {
  SparseRows result(static_cast<Eigen::Index>(picked.size()), rows.cols());
  for (std::size_t k = 0; k < picked.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    result.startVec(row);
    for (SparseRows::InnerIterator it(rows, picked[k]); it; ++it) result.insertBack(row, it.col()) = it.value();
  }
  result.finalize();
  return result;
}

}  // namespace dotyk::algebra
