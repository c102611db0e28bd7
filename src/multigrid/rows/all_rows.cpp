#include "multigrid/rows/all_rows.hpp"

namespace dotyk::multigrid {

namespace {

std::vector<int> all_starts(const Ranks& ranks, const std::vector<int>& own) {
  std::vector<int> counts, starts{0};
  for (std::size_t i = 1; i < own.size(); ++i) counts.push_back(own[i] - own[i - 1]);
  for (const int count : ranks.gather(counts)) starts.push_back(starts.back() + count);
  return starts;
}

}  // namespace

HalfRows all_rows(const Ranks& ranks, const HalfRows& own) {
  const std::ptrdiff_t square = own.block * own.block;
  std::vector<int> starts{0}, columns;
  std::vector<double> below;
  const auto put = [&](int column, const std::vector<double>& from, int k) {
    columns.push_back(column);
    below.insert(below.end(), from.begin() + k * square, from.begin() + (k + 1) * square);
  };
  for (int node = 0; node < own.nodes(); ++node) {
    for (int k = own.other_starts[node]; k < own.other_starts[node + 1]; ++k)
      if (own.others[k] < own.first) put(own.others[k], own.other, k);
    for (int k = own.starts[node]; k < own.starts[node + 1]; ++k) put(own.first + own.columns[k], own.below, k);
    starts.push_back(static_cast<int>(columns.size()));
  }
  HalfRows all;
  all.block = own.block;
  all.starts = all_starts(ranks, starts), all.columns = ranks.gather(columns);
  all.below = ranks.gather(below), all.diagonal = ranks.gather(own.diagonal);
  all.below.resize(all.below.size() + kSpare);
  all.other_starts.assign(all.starts.size(), 0);
  return all;
}

OwnFunctions all_rows(const Ranks& ranks, const OwnFunctions& own) {
  return {ranks.gather(own.component), all_starts(ranks, own.starts), ranks.gather(own.means)};
}

}  // namespace dotyk::multigrid
