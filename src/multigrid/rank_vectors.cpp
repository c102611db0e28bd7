#include "multigrid/rank_vectors.hpp"

#include <utility>

#include "multigrid/processes/petsc_session.hpp"

namespace dotyk::multigrid {

namespace {

using algebra::Vector;
using algebra::VectorOrder;
using algebra::VectorParts;

/// Runs an order on each rank's part; what it tells is that of all parts together. Collective.
double run_together(const Ranks& ranks, const VectorOrder& order, VectorParts& own) {
  const double told = own.run(order);
  switch (order.op) {
    case VectorOrder::Op::dot:
    case VectorOrder::Op::moduli: return ranks.sum(told);
    case VectorOrder::Op::greatest: return ranks.greatest(told);
    default: return 0;
  }
}

/// By rank the places, among `watched`, of the unknowns that it has.
std::vector<std::vector<int>> by_rank(const Numbering& numbering, const std::vector<int>& watched, int ranks) {
  std::vector<std::vector<int>> places(static_cast<std::size_t>(ranks));
  for (std::size_t k = 0; k < watched.size(); ++k) places[numbering.rank_of(numbering.slot()[watched[k]])].push_back(static_cast<int>(k));
  return places;
}

/// Rows of the watched unknowns in a rank's part, counted from its first; `of_ranks`: as by_rank() gives them.
std::vector<int> own_places(const Numbering& numbering, const std::vector<int>& watched, const std::vector<std::vector<int>>& of_ranks, int rank) {
  std::vector<int> rows;
  for (const int k : of_ranks[rank]) rows.push_back(numbering.slot()[watched[k]] - numbering.first(0)[rank]);
  return rows;
}

int size_of(const Numbering& numbering, int rank) { return numbering.first(0)[rank + 1] - numbering.first(0)[rank]; }

}  // namespace

RankVectors::RankVectors(const Workers& workers, std::shared_ptr<const Numbering> numbering, const std::vector<int>& watched)
    : workers_(workers.next()), numbering_(std::move(numbering)), watched_(by_rank(*numbering_, watched, workers.ranks().count())),
      own_(size_of(*numbering_, 0), own_places(*numbering_, watched, watched_, 0), workers.ranks().alone()) {
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  ranks.together([&] {
    workers_.tell(Task::vectors);
    for (int r = 1; r < ranks.count(); ++r) ranks.send(r, std::vector<int>{size_of(*numbering_, r)}), ranks.send(r, own_places(*numbering_, watched, watched_, r));
  });
}

RankVectors::~RankVectors() {
  const std::lock_guard lock(only_one());
  workers_.tell(Task::drop_vectors);
}

VectorParts receive_vectors(const Ranks& ranks) {
  std::vector<int> size, watched;
  ranks.receive(0, size), ranks.receive(0, watched);
  return {size[0], std::move(watched), false};
}

double RankVectors::run(const VectorOrder& order) {
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  return ranks.together([&] {
    workers_.tell(Task::order);
    for (int r = 1; r < ranks.count(); ++r)
      ranks.send(r, std::vector<int>{static_cast<int>(order.op), order.a, order.b, order.c, order.d}), ranks.send(r, std::vector<double>{order.factor});
    return run_together(ranks, order, own_);
  });
}

void run_order(const Ranks& ranks, VectorParts& vectors) {
  std::vector<int> words;
  std::vector<double> factor;
  ranks.receive(0, words), ranks.receive(0, factor);
  run_together(ranks, {static_cast<VectorOrder::Op>(words[0]), words[1], words[2], words[3], words[4], factor[0]}, vectors);
}

void RankVectors::tell(Task task, int v) const {
  workers_.tell(task);
  for (int r = 1; r < workers_.ranks().count(); ++r) workers_.ranks().send(r, std::vector<int>{v});
}

void exchange_numbers(const Ranks& ranks, Task task, VectorParts& vectors) {
  std::vector<int> v;
  std::vector<double> numbers;
  ranks.receive(0, v);
  switch (task) {
    case Task::get: ranks.send(0, vectors[v[0]]); break;
    case Task::put: ranks.receive(0, vectors[v[0]]); break;
    case Task::watched: ranks.send(0, vectors.watched(v[0])); break;
    default: ranks.receive(0, numbers), vectors.set_watched(v[0], numbers);
  }
}

Vector RankVectors::get(int v) {
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  return ranks.together([&] {
    tell(Task::get, v);
    Vector all(static_cast<Eigen::Index>(numbering_->slot().size()));
    numbering_->put(0, own_[v], all);
    std::vector<double> part;
    for (int r = 1; r < ranks.count(); ++r) ranks.receive(r, part), numbering_->put(r, part, all);
    return all;
  });
}

void RankVectors::put(int v, const Vector& numbers) {
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  const auto part = [&](int rank) { return numbering_->part(rank, [&](int i) { return numbers[i]; }); };
  ranks.together([&] {
    tell(Task::put, v);
    for (int r = 1; r < ranks.count(); ++r) ranks.send(r, part(r));
    own_[v] = part(0);
  });
}

Vector RankVectors::watched(int v) {
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  return ranks.together([&] {
    tell(Task::watched, v);
    Eigen::Index count = 0;
    for (const auto& places : watched_) count += std::ssize(places);
    Vector all(count);
    std::vector<double> part = own_.watched(v);
    for (int r = 0; r < ranks.count(); ++r) {
      if (r > 0) ranks.receive(r, part);
      for (std::size_t k = 0; k < part.size(); ++k) all[watched_[r][k]] = part[k];
    }
    return all;
  });
}

void RankVectors::set_watched(int v, const Vector& numbers) {
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  const auto part = [&](int rank) {
    std::vector<double> own;
    for (const int k : watched_[rank]) own.push_back(numbers[k]);
    return own;
  };
  ranks.together([&] {
    tell(Task::set_watched, v);
    for (int r = 1; r < ranks.count(); ++r) ranks.send(r, part(r));
    own_.set_watched(v, part(0));
  });
}

}  // namespace dotyk::multigrid
