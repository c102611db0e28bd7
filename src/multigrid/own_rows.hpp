#pragma once

#include <numeric>
#include <vector>

#include "algebra/types.hpp"
#include "base/parallel.hpp"
#include "multigrid/half_matrix.hpp"

namespace dotyk::multigrid {

/// The rows of so many nodes from `first` on. `slot`: the row, by the numbers of Numbering, of each unknown of the lower triangle.
HalfRows own_rows(const algebra::SparseMatrix& lower, const std::vector<int>& slot, int block, int first, int nodes);

/// Sets the diagonal at those rows, by the numbers of Numbering, that are own.
void fill_idle(HalfRows& rows, const std::vector<int>& idle, double number);

/// Sorts the entries of rows, or columns, first … last − 1 by their indices.
void sort_entries(const int* starts, int first, int last, int* indices, double* values);

/// A lower triangle, compressed, columns sorted. each(begin, end, visit) calls visit(row, column, number) for the entries in columns begin … end − 1, in any
/// order. Several threads call it, twice.
template <class Each>
algebra::StoredMatrix lower_triangle(int size, const Each& each) {
  constexpr int kFew = 10'000;  // columns, for a thread
  const auto each_range = [&](const auto& work) { parallel_ranges(size, threads_for(size, kFew), [&](int, int first, int end) { work(first, end); }); };
  algebra::StoredMatrix lower;
  lower.resize(size, size);
  int* starts = lower.outerIndexPtr();
  each_range([&](int first, int end) { each(first, end, [&](int, int column, double) { ++starts[column + 1]; }); });
  std::partial_sum(starts, starts + size + 1, starts);
  lower.resizeNonZeros(starts[size]);
  int* rows = lower.innerIndexPtr();
  double* numbers = lower.valuePtr();
  each_range([&](int first, int end) {
    std::vector<int> next(starts + first, starts + end);
    each(first, end, [&](int row, int column, double number) {
      const int at = next[column - first]++;
      rows[at] = row, numbers[at] = number;
    });
    sort_entries(starts, first, end, rows, numbers);
  });
  return lower;
}

}  // namespace dotyk::multigrid
