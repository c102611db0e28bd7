#include "multigrid/rank_slices.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "multigrid/processes/petsc_session.hpp"
#include "multigrid/shares/messages.hpp"

namespace dotyk::multigrid {

namespace {

using algebra::Vector;

void send(const Ranks& ranks, int to, const Rows& rows) { ranks.send(to, rows.starts), ranks.send(to, rows.columns), ranks.send(to, rows.values); }

Rows receive_full(const Ranks& ranks, int from) {
  Rows rows;
  ranks.receive(from, rows.starts), ranks.receive(from, rows.columns), ranks.receive(from, rows.values);
  return rows;
}

/// Which rows a rank has, counted as in Numbering.
struct OwnNumbers {
  int block = 1, first = 0, nodes = 0;  ///< rows of a node; own nodes
  std::vector<int> slot = {};           ///< row of each unknown of the rank's share
  std::vector<int> idle = {};           ///< own rows without unknown
};

void send(const Ranks& ranks, int to, const Lists& lists, const OwnNumbers& own) {
  ranks.send(to, std::vector<int>{own.block, own.first, own.nodes});
  ranks.send(to, own.slot), ranks.send(to, own.idle);
  send(ranks, to, lists);
}

HalfRows assembled(const ShareMakers& makers, Lists lists, const OwnNumbers& own) {
  return own_rows(makers.assemble(std::move(lists)), own.slot, own.block, own.first, own.nodes);
}

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

}  // namespace

std::unique_ptr<Slice> receive_rest(const Ranks& ranks, HalfRows rows, AllOwnFunctions functions, OwnLoad load) {
  return told_slice(ranks, std::move(rows), ranks.received<int>(0), std::move(functions), std::move(load));
}

std::unique_ptr<Slice> receive_slice(const Ranks& ranks, const ShareMakers& makers) {
  const std::vector<int> sizes = ranks.received<int>(0);
  OwnNumbers own{sizes[0], sizes[1], sizes[2]};
  ranks.receive(0, own.slot), ranks.receive(0, own.idle);
  Lists lists = receive_lists(ranks, 0);
  AllOwnFunctions functions = receive_own_functions(ranks, 0);
  const Entries added = receive_entries(ranks);
  HalfRows rows = assembled(makers, std::move(lists), own);
  add(rows, added);
  return told_slice(ranks, std::move(rows), own.idle, std::move(functions));
}

void tell_some(const Ranks& ranks, const Slice& slice) { send(ranks, 0, slice.some(ranks.received<int>(0))); }

RankSlices::RankSlices(Workers workers, const Shared& shared)
    : RankSlices(workers, Numbering(shared.coupling, workers.ranks().count())) {
  workers_.ranks().together([&] {
    slice_ = share_out(shared);
    take_diagonal();
  });
  workers_.made();
  made_ = true;
}

RankSlices::RankSlices(Workers workers, const Refined& matrix) : workers_(workers) {
  workers_.ranks().together([&] {
    slice_ = share_out(matrix);
    take_diagonal();
  });
  workers_.made();
  made_ = true;
}

RankSlices::RankSlices(Workers workers, Numbering numbering, HalfRows own, AllOwnFunctions functions, OwnLoad load) : RankSlices(workers, std::move(numbering)) {
  const Ranks& ranks = workers_.ranks();
  for (int r = 1; r < ranks.count(); ++r) ranks.send(r, idle_of(r));
  slice_ = std::make_unique<Slice>(ranks, std::move(own), idle_of(0), std::move(functions), std::move(load));
  take_diagonal();
  workers_.made();
  made_ = true;
}

RankSlices::RankSlices(Workers workers, Numbering numbering) : workers_(workers), numbering_(std::make_shared<const Numbering>(std::move(numbering))) {}

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
  std::vector<OwnNumbers> numbers;
  std::vector<AllOwnFunctions> functions;
  for (int end = ranks.count(), begin; end > 0; end = begin) {
    begin = std::max(0, end - cores());
    some.assign(static_cast<std::size_t>(end - begin), {}), numbers.assign(some.size(), {}), functions.assign(some.size(), nullptr);
    parallel_for(static_cast<int>(some.size()), [&](int k) {
      const int from = first[begin + k], to = first[begin + k + 1];
      std::vector<char> own(slot.size());
      for (std::size_t i = 0; i < own.size(); ++i) own[i] = slot[i] >= from && slot[i] < to;
      some[k] = matrix.share(own);
      numbers[k] = {block, from / block, (to - from) / block, {}, idle_of(begin + k)};
      for (const int unknown : some[k].unknowns) numbers[k].slot.push_back(slot[unknown]);
      functions[k] = own_functions(matrix.coupling.coarse, *numbering_, begin + k);
    });
    for (int r = std::max(1, begin); r < end; ++r) {
      workers_.tell(Task::slice, r);
      send(ranks, r, some[r - begin].lists, numbers[r - begin]);
      send(ranks, r, functions[r - begin]);
      send(ranks, r, entries_of(r, matrix.added, *numbering_));
      some[r - begin] = {}, functions[r - begin] = nullptr;
    }
  }
  HalfRows rows = assembled(matrix.makers, std::move(some[0].lists), numbers[0]);
  add(rows, entries_of(0, matrix.added, *numbering_));
  return std::make_unique<Slice>(ranks, std::move(rows), numbers[0].idle, functions[0]);
}

void RankSlices::take_diagonal() {
  hides_ = numbering_->hides();
  const Ranks& ranks = workers_.ranks();
  std::vector<double> part = slice_->diagonal();
  std::vector<double> counts{static_cast<double>(slice_->most_entries()), slice_->entries()};
  diagonal_.resize(static_cast<Eigen::Index>(numbering_->slot().size()));
  for (int r = 0; r < ranks.count(); ++r) {
    if (r > 0) ranks.receive(r, part), ranks.receive(r, counts);
    numbering_->put(r, part, diagonal_);
    most_entries_ = std::max(most_entries_, static_cast<int>(counts[0])), entries_ += counts[1];
  }
}

std::shared_ptr<algebra::Vectors> RankSlices::vectors(const std::vector<int>& watched) const { return std::make_shared<RankVectors>(workers_, numbering_, watched); }

void RankSlices::multiply(Slice::Product how, RankVectors& v, const Slice::Factors& of) const {
  workers_.run(Task::multiply, [&](int r) { workers_.ranks().send(r, std::vector<int>{v.number(), static_cast<int>(how), of.x, of.x_low, of.y}); },
               [&] { slice_->multiply(how, v.own(), of); });
}

bool RankSlices::holds(const algebra::Vectors& vectors) const {
  const auto* of_ranks = dynamic_cast<const RankVectors*>(&vectors);
  return of_ranks && &of_ranks->numbering() == numbering_.get();
}

void RankSlices::take_product(const algebra::LongField& u, bool precisely, algebra::Field& from) const {
  if (!holds(*from.where()) || from.where() != u.high.where()) throw std::logic_error("slices: vectors that lie elsewhere");
  multiply(precisely ? Slice::Product::taken_precisely : Slice::Product::taken, dynamic_cast<RankVectors&>(*from.where()), {u.high.number(), u.low.number(), from.number()});
}

void RankSlices::add_load(algebra::Field& to) const {
  if (slice_->load()) multiply(Slice::Product::load, dynamic_cast<RankVectors&>(*to.where()), {0, 0, to.number()});
}

Vector RankSlices::product(Slice::Product how, const Vector& x) const {
  const auto room = std::make_shared<RankVectors>(workers_, numbering_, std::vector<int>());
  algebra::Field factor(room), result(room);
  factor.put(x);
  multiply(how, *room, {factor.number(), 0, result.number()});
  return result.get();
}

Vector RankSlices::times(const Eigen::Ref<const Vector>& x) const { return product(Slice::Product::plain, x); }

Vector RankSlices::gross_times(const Vector& x) const { return product(Slice::Product::gross, x.cwiseAbs()); }

RankSlices::Asked RankSlices::ask(const std::vector<int>& unknowns) const {
  const Ranks& ranks = workers_.ranks();
  Asked asked{std::vector<std::vector<int>>(static_cast<std::size_t>(ranks.count())), {}};
  for (const int i : unknowns) {
    const int row = numbering_->slot()[i], rank = numbering_->rank_of(row);
    asked.numbers[rank].push_back(row - numbering_->first(0)[rank]);
  }
  for (auto& of_rank : asked.numbers) std::ranges::sort(of_rank);
  ranks.together([&] {
    workers_.tell(Task::some);
    for (int r = 1; r < ranks.count(); ++r) ranks.send(r, asked.numbers[r]);
    asked.rows.push_back(slice_->some(asked.numbers[0]));
    for (int r = 1; r < ranks.count(); ++r) asked.rows.push_back(receive_full(ranks, r));
  });
  return asked;
}

algebra::StoredMatrix RankSlices::near(std::vector<char>& of, int layers) const {
  const std::lock_guard lock(only_one());
  std::vector<int> outermost;
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i]) outermost.push_back(static_cast<int>(i));
  const double entries = entries_ * static_cast<double>(outermost.size()) / static_cast<double>(numbering_->first(0).back());
  if (entries > std::numeric_limits<int>::max())
    throw InputError(text("the stiffness has ", entries, " entries, too many to be put together; dotyk.solver.multigrid{} does without"));
  require_memory(18 * entries, "the stiffness, put together from its slices,");  // all entries, and 12 bytes for each of half of them
  std::vector<Asked> all;
  for (;; --layers) {
    all.push_back(ask(outermost));
    if (layers == 0) break;
    outermost.clear();
    for (const Rows& rows : all.back().rows)
      for (const int column : rows.columns)
        if (const int j = numbering_->unknown(column); j >= 0 && !std::exchange(of[j], 1)) outermost.push_back(j);
  }
  return lower_triangle(static_cast<int>(diagonal_.size()), [&](int begin, int end, auto&& visit) {
    for (const auto& [numbers, rows] : all)
      for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t k = 0; k < numbers[r].size(); ++k) {
          const int i = numbering_->unknown(numbering_->first(0)[r] + numbers[r][k]);
          for (int at = rows[r].starts[k]; at < rows[r].starts[k + 1]; ++at) {
            const int j = numbering_->unknown(rows[r].columns[at]);
            if (j < 0 || (j > i && of[j])) continue;  // the latter is told with its own row
            if (const int column = std::min(i, j); column >= begin && column < end) visit(std::max(i, j), column, rows[r].values[at]);
          }
        }
  });
}

}  // namespace dotyk::multigrid
