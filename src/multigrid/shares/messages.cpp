#include "multigrid/shares/messages.hpp"

#include <algorithm>
#include <utility>

namespace dotyk::multigrid {
namespace {

/// The rank's rows of the functions that give what a displacement of level + 1 is on `level`.
OwnFunctions own_functions(const algebra::CoarseFunctions& functions, const Numbering& numbering, int level, int rank) {
  const std::vector<int>&number = level == 0 ? numbering.slot() : numbering.functions(level), &coarse_number = numbering.functions(level + 1);
  const int first = numbering.first(level)[rank], count = numbering.first(level)[rank + 1] - first, d = functions.dimension, block = level == 0 ? numbering.block() : d;
  OwnFunctions own;
  own.component.assign(static_cast<std::size_t>(count), -1);
  std::vector<int> node_of(static_cast<std::size_t>(count / block), -1);
  for (std::size_t at = 0; at < functions.row.size(); ++at) {
    const int row = functions.row[at] < 0 ? -1 : number[functions.row[at]] - first;
    if (row < 0 || row >= count) continue;
    own.component[row] = static_cast<int>(at) % d, node_of[row / block] = static_cast<int>(at) / d;
  }
  std::size_t means = 0;
  for (const int& node : node_of) means += node >= 0 ? functions.of(node).size() : 0;
  own.starts.reserve(node_of.size() + 1), own.means.reserve(means);
  for (const int& node : node_of) {
    if (node >= 0)
      for (const int p : functions.of(node)) {
        int bits = 0;
        for (int k = 0; k < d; ++k) bits |= (functions.column[d * p + k] >= 0) << k;
        own.means.push_back(coarse_number[d * p] / d * OwnFunctions::kComponents + bits);
      }
    own.starts.push_back(counted(own.means.size()));
  }
  return own;
}

}  // namespace

void send(const Ranks& ranks, int to, const Lists& lists) {
  ranks.send(to, std::vector<int>{counted(lists.whole.size()), counted(lists.real.size())});
  for (const auto& list : lists.whole) ranks.send(to, list);
  for (const auto& list : lists.real) ranks.send(to, list);
}

Lists receive_lists(const Ranks& ranks, int from) {
  const std::vector<int> sizes = ranks.received<int>(from);
  Lists lists;
  lists.whole.resize(static_cast<std::size_t>(sizes[0])), lists.real.resize(static_cast<std::size_t>(sizes[1]));
  for (auto& list : lists.whole) ranks.receive(from, list);
  for (auto& list : lists.real) ranks.receive(from, list);
  return lists;
}

Entries entries_of(int rank, const algebra::Triplets& added, const Numbering& numbering) {
  Entries own;
  for (const auto& entry : added) {
    const int row = numbering.slot()[entry.row()], column = numbering.slot()[entry.col()];
    if (numbering.rank_of(row) != rank && numbering.rank_of(column) != rank) continue;
    own.rows.push_back(row), own.columns.push_back(column), own.values.push_back(entry.value());
  }
  return own;
}

void send(const Ranks& ranks, int to, const Entries& entries) { ranks.send(to, entries.rows), ranks.send(to, entries.columns), ranks.send(to, entries.values); }

Entries receive_entries(const Ranks& ranks) {
  Entries entries;
  ranks.receive(0, entries.rows), ranks.receive(0, entries.columns), ranks.receive(0, entries.values);
  return entries;
}

std::unique_ptr<Slice> told_slice(const Ranks& ranks, HalfRows rows, const std::vector<int>& idle, AllOwnFunctions functions, OwnLoad load) {
  auto slice = std::make_unique<Slice>(ranks, std::move(rows), idle, std::move(functions), std::move(load));
  ranks.send(0, slice->diagonal());
  ranks.send(0, std::vector<double>{static_cast<double>(slice->most_entries()), slice->entries()});
  return slice;
}

std::set<int> sharing_unknowns(const Matrix& matrix) {
  constexpr double kStiffer = 2;
  std::set<int> sharing;
  if (!matrix.unknowns) return sharing;
  const algebra::Vector k = matrix.slices ? matrix.slices->diagonal() : algebra::Vector(matrix.displaced->diagonal());
  const algebra::SparseRows S = *matrix.unknowns;
  algebra::Vector brought = algebra::Vector::Zero(k.size()), carried = brought;  // stiffness, to an unknown by rows, and by a row to others
  const auto each_pair = [&](auto&& visit) {
    for (int i = 0; i < S.rows(); ++i)
      for (algebra::SparseRows::InnerIterator it(S, i); it; ++it)
        if (it.col() != i) visit(i, static_cast<int>(it.col()), it.value());
  };
  each_pair([&](int i, int j, double factor) {
    const double whole = S.coeff(i, i), stiffness = k[i] * (factor / whole) * (factor / whole);
    brought[j] += stiffness, carried[i] += stiffness / k[j];
  });
  each_pair([&](int i, int j, double) {
    if (brought[j] > kStiffer * k[j] || carried[i] > kStiffer) sharing.insert({i, j});
  });
  return sharing;
}

std::vector<Change> changes(const algebra::Triplets& changed, const std::vector<char>& held, const std::set<int>& sharing, const Numbering& numbering,
                            int ranks) {
  const std::vector<int>& slot = numbering.slot();
  std::vector<Change> of(static_cast<std::size_t>(ranks));
  const auto put = [&](int row, int column, double value) {
    Change& own = of[numbering.rank_of(row)];
    own.rows.push_back(row), own.columns.push_back(column), own.values.push_back(value);
  };
  for (const auto& entry : changed) {
    const int row = slot[entry.row()], column = slot[entry.col()];
    put(row, column, entry.value());
    if (row != column) put(column, row, entry.value());
  }
  const auto put_local = [&](std::vector<int> Change::*list, int row) {
    const int rank = numbering.rank_of(row);
    (of[rank].*list).push_back(row - numbering.first(0)[rank]);
  };
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) put_local(&Change::empty, slot[i]);
  for (const int row : numbering.idle()) put_local(&Change::empty, row);
  for (const int i : sharing)
    if (!held[i]) put_local(&Change::shared, slot[i]);
  for (Change& own : of) std::sort(own.shared.begin(), own.shared.end());
  return of;
}

AllOwnFunctions own_functions(const std::vector<algebra::CoarseFunctions>& functions, const Numbering& numbering, int rank) {
  auto all = std::make_shared<std::vector<OwnFunctions>>();
  for (std::size_t l = 0; l < functions.size(); ++l) all->push_back(own_functions(functions[l], numbering, static_cast<int>(l), rank));
  return all;
}

}  // namespace dotyk::multigrid
