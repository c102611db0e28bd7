#pragma once

#include <algorithm>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// K_jj of a lower triangle, columns sorted; null where there is no such entry.
inline const double* diagonal_entry(const SparseMatrix& lower, int j) {
  const int first = lower.outerIndexPtr()[j];
  return first < lower.outerIndexPtr()[j + 1] && lower.innerIndexPtr()[first] == j ? lower.valuePtr() + first : nullptr;
}

/// Calls visit(place among the numbers, row, column) for the entries of a lower triangle, compressed, columns sorted, in rows or columns of the unknowns that
/// `of` flags by 1, in their order.
/// Columns that end above the first of these unknowns, or begin below the last, are not read: mostly unknowns near each other have numbers near each other.
template <class Visit>
void each_entry_of(const SparseMatrix& lower, const std::vector<char>& of, const Visit& visit) {
  const auto first = static_cast<int>(std::ranges::find(of, 1) - of.begin());
  int last = static_cast<int>(of.size()) - 1;
  while (last >= 0 && !of[last]) --last;
  for (int j = 0; j <= last; ++j) {
    const int begin = lower.outerIndexPtr()[j], end = lower.outerIndexPtr()[j + 1];
    if (begin == end || lower.innerIndexPtr()[end - 1] < first) continue;
    for (int k = begin; k < end; ++k)
      if (const int i = lower.innerIndexPtr()[k]; of[i] || of[j]) visit(k, i, j);
  }
}

}  // namespace dotyk::algebra
