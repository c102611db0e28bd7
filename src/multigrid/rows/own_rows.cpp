#include "multigrid/rows/own_rows.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dotyk::multigrid {
namespace {

/// Does a column have the rows of the column before it, without the first of these? Most components of a node do.
bool as_before(const algebra::SparseMatrix& lower, int j) {
  const int *begin = lower.outerIndexPtr() + j, *rows = lower.innerIndexPtr();
  return begin[0] - begin[-1] == begin[1] - begin[0] + 1 && std::equal(rows + begin[0], rows + begin[1], rows + begin[-1] + 1);
}

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

HalfRows own_rows(const algebra::SparseMatrix& lower, const std::vector<int>& slot, int block, int first, int nodes) {
  std::vector<int> node = slot;
  for (int& row : node) row /= block;
  const auto is_own = [&](int node) { return node >= first && node < first + nodes; };
  std::vector<char> met(static_cast<std::size_t>(lower.cols()), 0);  // columns of nodes with an entry that is this rank's, by their first column
  HalfRows rows = room_for(block, first, nodes, [&](auto&& visit) {
    for (int j = 0, begin = 0; j < lower.cols(); ++j) {
      if (node[j] != node[begin]) begin = j;
      if (j > begin && as_before(lower, j)) continue;
      const bool own = is_own(node[j]);
      bool meets = own;
      for (int k = lower.outerIndexPtr()[j]; k < lower.outerIndexPtr()[j + 1]; ++k) {
        const int row = node[lower.innerIndexPtr()[k]];
        if (own || is_own(row)) visit(row, node[j]), meets = true;
      }
      if (meets) met[begin] = 1;
    }
  });
  std::vector<HalfRows::Place> places;  // of a node's columns
  for (int begin = 0, end; begin < lower.cols(); begin = end) {
    const int column = node[begin];
    for (end = begin + 1; end < lower.cols() && node[end] == column;) ++end;
    if (!met[begin]) continue;
    places.clear();
    for (int j = begin; j < end; ++j) {
      const int c = slot[j] - column * block;
      std::size_t at = 0;
      for (int k = lower.outerIndexPtr()[j], row; k < lower.outerIndexPtr()[j + 1];) {
        row = node[lower.innerIndexPtr()[k]];
        while (at < places.size() && places[at].row != row) ++at;
        if (at == places.size()) places.push_back(rows.place(row, column));
        const HalfRows::Place place = places[at];
        for (; k < lower.outerIndexPtr()[j + 1] && node[lower.innerIndexPtr()[k]] == row; ++k) {
          if (!place.numbers) continue;
          const int r = slot[lower.innerIndexPtr()[k]] - row * block;
          place.at(block, r, c) = lower.valuePtr()[k];
          if (row == column) place.at(block, c, r) = lower.valuePtr()[k];
        }
      }
    }
  }
  return rows;
}

void add(HalfRows& rows, const Entries& entries) {
  const int block = rows.block;
  for (std::size_t e = 0; e < entries.values.size(); ++e) {
    const int a = entries.rows[e] / block, b = entries.columns[e] / block, r = entries.rows[e] % block, c = entries.columns[e] % block;
    if (!rows.own(a) && !rows.own(b)) continue;
    const HalfRows::Place place = rows.place(a, b);
    if (!place.numbers) throw std::logic_error("own rows: an entry is added where the pattern has none");
    place.at(block, r, c) += entries.values[e];
    if (a == b && r != c) place.at(block, c, r) += entries.values[e];
  }
}

void fill_idle(HalfRows& rows, const std::vector<int>& idle, double number) {
  for (const int row : idle) {
    const int node = row / rows.block, r = row % rows.block;
    if (rows.own(node)) rows.place(node, node).at(rows.block, r, r) = number;
  }
}

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
