#include "multigrid/rows/all_rows.hpp"

#include <utility>

namespace dotyk::multigrid {

namespace {

std::vector<int> all_starts(const Ranks& ranks, const std::vector<int>& own) {
  std::vector<int> counts, starts{0};
  for (std::size_t i = 1; i < own.size(); ++i) counts.push_back(own[i] - own[i - 1]);
  for (const int count : ranks.gather(counts)) starts.push_back(counted(static_cast<std::size_t>(starts.back()) + count));
  return starts;
}

/// Calls put(column, numbers, k) for the blocks of own nodes left of the diagonal, columns ascending, and ends(). Block k of `numbers`; nodes counted over all ranks.
void each_below(const HalfRows& own, const auto& put, const auto& ends) {
  for (int node = 0; node < own.nodes(); ++node) {
    for (int k = own.other_starts[node]; k < own.other_starts[node + 1]; ++k)
      if (own.others[k] < own.first) put(own.others[k], own.other, k);
    for (int k = own.starts[node]; k < own.starts[node + 1]; ++k) put(own.first + own.columns[k], own.below, k);
    ends();
  }
}

}  // namespace

HalfRows all_rows(const Ranks& ranks, const HalfRows& own) {
  std::vector<int> starts{0}, columns;
  each_below(own, [&](int column, const std::vector<double>&, int) { columns.push_back(column); }, [&] { starts.push_back(counted(columns.size())); });
  HalfRows all;
  all.block = own.block;
  all.starts = all_starts(ranks, starts), all.columns = ranks.gather(columns);
  all.other_starts.assign(all.starts.size(), 0);
  AllNumbers numbers = all_numbers(ranks, own);
  all.below = std::move(numbers.below), all.diagonal = std::move(numbers.diagonal);
  all.below.resize(all.below.size() + kSpare);
  return all;
}

AllNumbers all_numbers(const Ranks& ranks, const HalfRows& own) {
  const std::ptrdiff_t square = own.block * own.block;
  std::vector<double> below;
  each_below(own, [&](int, const std::vector<double>& from, int k) { below.insert(below.end(), from.begin() + k * square, from.begin() + (k + 1) * square); }, [] {});
  return {ranks.gather(below), ranks.gather(own.diagonal)};
}

OwnFunctions all_rows(const Ranks& ranks, const OwnFunctions& own) {
  return {ranks.gather(own.component), all_starts(ranks, own.starts), ranks.gather(own.means)};
}

}  // namespace dotyk::multigrid
