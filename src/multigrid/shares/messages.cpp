#include "multigrid/shares/messages.hpp"

#include <utility>

namespace dotyk::multigrid {

void send(const Ranks& ranks, int to, const Lists& lists) {
  ranks.send(to, std::vector<int>{counted(lists.whole.size()), counted(lists.real.size())});
  for (const auto& list : lists.whole) ranks.send(to, list);
  for (const auto& list : lists.real) ranks.send(to, list);
}

Lists receive_lists(const Ranks& ranks, int from) {
  std::vector<int> sizes;
  ranks.receive(from, sizes);
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

}  // namespace dotyk::multigrid
