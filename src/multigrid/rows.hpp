#pragma once

#include <algorithm>
#include <vector>

namespace dotyk::multigrid {

/// Rows of a sparse matrix, columns ascending in each.
struct Rows {
  std::vector<int> starts{0}, columns;
  std::vector<double> values;

  /// Appends a row with these columns, in any order, some of them several times. `row` is empty then.
  void append_columns(std::vector<int>& row) {
    std::ranges::sort(row);
    columns.insert(columns.end(), row.begin(), std::ranges::unique(row).begin());
    starts.push_back(static_cast<int>(columns.size()));
    row.clear();
  }
};

}  // namespace dotyk::multigrid
