#pragma once

#include <vector>

namespace dotyk::multigrid {

/// Rows of a sparse matrix, columns ascending in each.
struct Rows {
  std::vector<int> starts{0}, columns;
  std::vector<double> values;
};

}  // namespace dotyk::multigrid
