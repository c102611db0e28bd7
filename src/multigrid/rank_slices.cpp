#include "multigrid/rank_slices.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "multigrid/own_rows.hpp"

namespace dotyk::multigrid {

std::mutex& only_one() {
  static std::mutex mutex;
  return mutex;
}

namespace {

using algebra::LongVector;
using algebra::Vector;

void send(const Ranks& ranks, int to, const Rows& rows) { ranks.send(to, rows.starts), ranks.send(to, rows.columns), ranks.send(to, rows.values); }

Rows receive_full(const Ranks& ranks, int from) {
  Rows rows;
  ranks.receive(from, rows.starts), ranks.receive(from, rows.columns), ranks.receive(from, rows.values);
  return rows;
}

/// Where a rank's rows are, by the numbers of Numbering.
struct Place {
  int block = 1, first = 0, nodes = 0;  ///< rows of a node; own nodes
  std::vector<int> slot = {};           ///< row of each unknown of the rank's share
};

void send(const Ranks& ranks, int to, const Lists& lists, const Place& place, const std::vector<int>& idle) {
  ranks.send(to, std::vector<int>{place.block, place.first, place.nodes, static_cast<int>(lists.whole.size()), static_cast<int>(lists.real.size())});
  ranks.send(to, place.slot);
  for (const auto& list : lists.whole) ranks.send(to, list);
  for (const auto& list : lists.real) ranks.send(to, list);
  ranks.send(to, idle);
}

HalfRows assembled(Assemble assemble, Lists lists, const Place& place) {
  return own_rows(assemble(std::move(lists)), place.slot, place.block, place.first, place.nodes);
}

}  // namespace

std::unique_ptr<Slice> receive_rest(const Ranks& ranks, HalfRows rows) {
  std::vector<int> idle;
  ranks.receive(0, idle);
  auto slice = std::make_unique<Slice>(ranks, std::move(rows), idle);
  ranks.send(0, slice->diagonal());
  ranks.send(0, std::vector<int>{slice->most_entries()});
  return slice;
}

std::unique_ptr<Slice> receive_slice(const Ranks& ranks, Assemble assemble) {
  std::vector<int> sizes;
  ranks.receive(0, sizes);
  Place place{sizes[0], sizes[1], sizes[2]};
  ranks.receive(0, place.slot);
  Lists lists;
  lists.whole.resize(static_cast<std::size_t>(sizes[3])), lists.real.resize(static_cast<std::size_t>(sizes[4]));
  for (auto& list : lists.whole) ranks.receive(0, list);
  for (auto& list : lists.real) ranks.receive(0, list);
  return receive_rest(ranks, assembled(assemble, std::move(lists), place));
}

void multiply(const Ranks& ranks, Slice& slice) {
  std::vector<int> how;
  ranks.receive(0, how);
  std::vector<std::vector<double>> x(static_cast<std::size_t>(how[1]));
  for (auto& part : x) ranks.receive(0, part);
  for (const auto& part : slice.times(static_cast<Slice::Product>(how[0]), x)) ranks.send(0, part);
}

void tell_some(const Ranks& ranks, const Slice& slice) {
  std::vector<int> rows;
  ranks.receive(0, rows);
  send(ranks, 0, slice.some(rows));
}

namespace {

Numbering numbering_of(const Shared& shared, int ranks) {
  const algebra::SparseMatrix none;
  Matrix matrix{none, shared.node, {}};
  matrix.coarse = &shared.coarse, matrix.dimension = shared.dimension;
  return Numbering(matrix, ranks);
}

}  // namespace

RankSlices::RankSlices(const Shared& shared)
    : RankSlices(workers_for(static_cast<double>(shared.node.size())), numbering_of(shared, ranks_now())) {
  workers_.ranks().together([&] {
    slice_ = share_out(shared);
    take_diagonal();
  });
  workers_.made();
  made_ = true;
}

RankSlices::RankSlices(Workers workers, Numbering numbering, HalfRows own) : RankSlices(workers, std::move(numbering)) {
  const Ranks& ranks = workers_.ranks();
  for (int r = 1; r < ranks.count(); ++r) ranks.send(r, idle_of(r));
  slice_ = std::make_unique<Slice>(ranks, std::move(own), idle_of(0));
  take_diagonal();
  workers_.made();
  made_ = true;
}

RankSlices::RankSlices(Workers workers, Numbering numbering) : workers_(workers), numbering_(std::make_shared<const Numbering>(std::move(numbering))) {
  unknown_.assign(static_cast<std::size_t>(numbering_->first(0).back()), -1);
  for (std::size_t i = 0; i < numbering_->slot().size(); ++i) unknown_[numbering_->slot()[i]] = static_cast<int>(i);
}

RankSlices::~RankSlices() {
  if (!made_) return;  // an exception while it was made: the lock is held, and nobody was told
  const std::lock_guard lock(only_one());
  workers_.tell(Task::drop_slice);
}

std::vector<int> RankSlices::idle_of(int rank) const {
  std::vector<int> idle;
  const int begin = numbering_->first(0)[rank], end = numbering_->first(0)[rank + 1];
  std::ranges::copy_if(numbering_->idle(), std::back_inserter(idle), [&](int row) { return row >= begin && row < end; });
  return idle;
}

/// As many shares at a time as there are cores, that of rank 0 among the last.
std::unique_ptr<Slice> RankSlices::share_out(const Shared& matrix) const {
  const Ranks& ranks = workers_.ranks();
  const std::vector<int>&slot = numbering_->slot(), &first = numbering_->first(0);
  const int block = numbering_->block();
  std::vector<Share> some;
  std::vector<Place> places;
  for (int end = ranks.count(), begin; end > 0; end = begin) {
    begin = std::max(0, end - cores());
    some.assign(static_cast<std::size_t>(end - begin), {}), places.assign(some.size(), {});
    parallel_for(static_cast<int>(some.size()), [&](int k) {
      const int from = first[begin + k], to = first[begin + k + 1];
      std::vector<char> own(slot.size());
      for (std::size_t i = 0; i < own.size(); ++i) own[i] = slot[i] >= from && slot[i] < to;
      some[k] = matrix.share(own);
      places[k] = {block, from / block, (to - from) / block};
      for (const int unknown : some[k].unknowns) places[k].slot.push_back(slot[unknown]);
    });
    for (int r = std::max(1, begin); r < end; ++r) {
      workers_.tell(Task::slice, r);
      send(ranks, r, some[r - begin].lists, places[r - begin], idle_of(r));
      some[r - begin] = {};
    }
  }
  return std::make_unique<Slice>(ranks, assembled(matrix.assemble, std::move(some[0].lists), places[0]), idle_of(0));
}

void RankSlices::take_diagonal() {
  const Ranks& ranks = workers_.ranks();
  std::vector<double> all = slice_->diagonal(), part;
  std::vector<int> most;
  most_entries_ = slice_->most_entries();
  for (int r = 1; r < ranks.count(); ++r) {
    ranks.receive(r, part), ranks.receive(r, most);
    all.insert(all.end(), part.begin(), part.end());
    most_entries_ = std::max(most_entries_, most[0]);
  }
  diagonal_ = of_unknowns(all);
}

template <class Number>
std::vector<double> RankSlices::by_rows(const Number& of_unknown) const {
  std::vector<double> all(unknown_.size(), 0.0);
  for (std::size_t i = 0; i < numbering_->slot().size(); ++i) all[numbering_->slot()[i]] = of_unknown(static_cast<Eigen::Index>(i));
  return all;
}

Vector RankSlices::of_unknowns(const std::vector<double>& by_rows) const {
  const std::vector<int>& slot = numbering_->slot();
  Vector x(static_cast<Eigen::Index>(slot.size()));
  for (std::size_t i = 0; i < slot.size(); ++i) x[static_cast<Eigen::Index>(i)] = by_rows[slot[i]];
  return x;
}

RankSlices::Parts RankSlices::product(Slice::Product how, Parts x) const {
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  const std::vector<int>& first = numbering_->first(0);
  return ranks.together([&] {
    workers_.tell(Task::multiply);
    for (int r = 1; r < ranks.count(); ++r) {
      ranks.send(r, std::vector<int>{static_cast<int>(how), static_cast<int>(x.size())});
      for (const auto& part : x) ranks.send(r, std::vector<double>(part.begin() + first[r], part.begin() + first[r + 1]));
    }
    for (auto& part : x) part.resize(static_cast<std::size_t>(first[1]));
    Parts y = slice_->times(how, x);
    std::vector<double> theirs;
    for (int r = 1; r < ranks.count(); ++r)
      for (auto& part : y) ranks.receive(r, theirs), part.insert(part.end(), theirs.begin(), theirs.end());
    return y;
  });
}

Vector RankSlices::times(const Vector& x) const {
  return of_unknowns(product(Slice::Product::plain, {by_rows([&](auto i) { return x[i]; })})[0]);
}

Vector RankSlices::gross_times(const Vector& x) const {
  return of_unknowns(product(Slice::Product::gross, {by_rows([&](auto i) { return std::abs(x[i]); })})[0]);
}

LongVector RankSlices::times(const LongVector& x) const {
  const auto high = [&](auto i) { return static_cast<double>(x[i]); };
  const Parts y = product(Slice::Product::precise, {by_rows(high), by_rows([&](auto i) { return static_cast<double>(x[i] - high(i)); })});
  return of_unknowns(y[0]).cast<long double>() + of_unknowns(y[1]).cast<long double>();
}

algebra::StoredMatrix RankSlices::near(const std::vector<char>& of) const {
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  const std::vector<int>& first = numbering_->first(0);
  std::vector<std::vector<int>> asked(static_cast<std::size_t>(ranks.count()));
  for (int r = 0; r < ranks.count(); ++r)
    for (int row = first[r]; row < first[r + 1]; ++row)
      if (unknown_[row] >= 0 && of[unknown_[row]]) asked[r].push_back(row - first[r]);
  const std::vector<Rows> rows = ranks.together([&] {
    workers_.tell(Task::some);
    for (int r = 1; r < ranks.count(); ++r) ranks.send(r, asked[r]);
    std::vector<Rows> all{slice_->some(asked[0])};
    for (int r = 1; r < ranks.count(); ++r) all.push_back(receive_full(ranks, r));
    return all;
  });
  return lower_triangle(static_cast<int>(diagonal_.size()), [&](int begin, int end, auto&& visit) {
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t k = 0; k < asked[r].size(); ++k) {
        const int i = unknown_[first[r] + asked[r][k]];
        for (int at = rows[r].starts[k]; at < rows[r].starts[k + 1]; ++at) {
          const int j = unknown_[rows[r].columns[at]];
          if (j < 0 || (j > i && of[j])) continue;  // the latter is told with its own row
          if (const int column = std::min(i, j); column >= begin && column < end) visit(std::max(i, j), column, rows[r].values[at]);
        }
      }
  });
}

}  // namespace dotyk::multigrid
