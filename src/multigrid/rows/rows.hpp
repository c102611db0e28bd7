#pragma once

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "base/counted.hpp"

namespace dotyk::multigrid {

/// Rows of a sparse matrix, columns ascending in each.
struct Rows {
  std::vector<int> starts{0}, columns;
  std::vector<double> values;

  /// Appends a row with these columns, in any order, some of them several times. `row` is empty then.
  void append_columns(std::vector<int>& row) {
    std::ranges::sort(row);
    columns.insert(columns.end(), row.begin(), std::ranges::unique(row).begin());
    starts.push_back(counted(columns.size()));
    row.clear();
  }
};

/// Sorts the entries of rows, or columns, first … last − 1 by their indices.
inline void sort_entries(const int* starts, int first, int last, int* indices, double* values) {
  std::vector<std::pair<int, double>> one;
  for (int i = first; i < last; ++i) {
    const int begin = starts[i], end = starts[i + 1];
    if (std::is_sorted(indices + begin, indices + end)) continue;
    one.clear();
    for (int k = begin; k < end; ++k) one.emplace_back(indices[k], values[k]);
    std::ranges::sort(one);
    for (int k = begin; k < end; ++k) std::tie(indices[k], values[k]) = one[k - begin];
  }
}

}  // namespace dotyk::multigrid
