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

int size_of(const Numbering& numbering, int rank) { return numbering.first(0)[rank + 1] - numbering.first(0)[rank]; }

}  // namespace

RankVectors::RankVectors(const Workers& workers, std::shared_ptr<const Numbering> numbering, const std::vector<int>& watched)
    : Vectors(static_cast<int>(numbering->slot().size()), watched), workers_(workers.next()), numbering_(std::move(numbering)),
      own_(size_of(*numbering_, 0), workers.ranks().alone()) {
  workers_.run(Task::vectors, [&](int r) { workers_.ranks().send(r, std::vector<int>{size_of(*numbering_, r)}); }, [] {});
}

RankVectors::~RankVectors() {
  const std::lock_guard lock(only_one());
  workers_.tell(Task::drop_vectors);
}

VectorParts receive_vectors(const Ranks& ranks) {
  return {ranks.received<int>(0)[0], false};
}

double RankVectors::run(const VectorOrder& order) {
  const Ranks& ranks = workers_.ranks();
  const std::vector<int> words{static_cast<int>(order.op), order.a, order.b, order.c, order.d};
  return workers_.run(Task::order, [&](int r) { ranks.send(r, words), ranks.send(r, std::vector<double>{order.factor}); },
                      [&] { return run_together(ranks, order, own_); });
}

void run_order(const Ranks& ranks, VectorParts& vectors) {
  const std::vector<int> words = ranks.received<int>(0);
  const std::vector<double> factor = ranks.received<double>(0);
  run_together(ranks, {static_cast<VectorOrder::Op>(words[0]), words[1], words[2], words[3], words[4], factor[0]}, vectors);
}

RankVectors::ByRank RankVectors::by_rank(const std::vector<int>& unknowns) const {
  const auto ranks = static_cast<std::size_t>(workers_.ranks().count());
  ByRank of{std::vector<std::vector<int>>(ranks), std::vector<std::vector<int>>(ranks)};
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const int row = numbering_->slot()[unknowns[k]], rank = numbering_->rank_of(row);
    of.places[rank].push_back(static_cast<int>(k)), of.rows[rank].push_back(row - numbering_->first(0)[rank]);
  }
  return of;
}

void exchange_numbers(const Ranks& ranks, Task task, VectorParts& vectors) {
  std::vector<int> v, rows;
  std::vector<double> numbers;
  ranks.receive(0, v);
  if (task == Task::get) return ranks.send(0, vectors[v[0]]);
  if (task == Task::put) return ranks.receive(0, vectors[v[0]]);
  ranks.receive(0, rows);
  if (task == Task::get_some) return ranks.send(0, vectors.some(v[0], rows));
  ranks.receive(0, numbers), vectors.set_some(v[0], rows, numbers);
}

Vector RankVectors::get(int v) {
  const Ranks& ranks = workers_.ranks();
  return workers_.run(Task::get, [&](int r) { ranks.send(r, std::vector<int>{v}); }, [&] {
    Vector all(static_cast<Eigen::Index>(numbering_->slot().size()));
    numbering_->put(0, own_[v], all);
    std::vector<double> part;
    for (int r = 1; r < ranks.count(); ++r) ranks.receive(r, part), numbering_->put(r, part, all);
    return all;
  });
}

void RankVectors::put(int v, const Vector& numbers) {
  const Ranks& ranks = workers_.ranks();
  const auto part = [&](int rank) { return numbering_->part(rank, [&](int i) { return numbers[i]; }); };
  workers_.run(Task::put, [&](int r) { ranks.send(r, std::vector<int>{v}), ranks.send(r, part(r)); }, [&] { own_[v] = part(0); });
}

Vector RankVectors::some(int v, const std::vector<int>& unknowns) {
  const Ranks& ranks = workers_.ranks();
  const ByRank of = by_rank(unknowns);
  return workers_.run(Task::get_some, [&](int r) { ranks.send(r, std::vector<int>{v}), ranks.send(r, of.rows[r]); }, [&] {
    Vector all(std::ssize(unknowns));
    std::vector<double> part = own_.some(v, of.rows[0]);
    for (int r = 0; r < ranks.count(); ++r) {
      if (r > 0) ranks.receive(r, part);
      for (std::size_t k = 0; k < part.size(); ++k) all[of.places[r][k]] = part[k];
    }
    return all;
  });
}

void RankVectors::set_some(int v, const std::vector<int>& unknowns, const Vector& numbers) {
  const Ranks& ranks = workers_.ranks();
  const ByRank of = by_rank(unknowns);
  const auto part = [&](int rank) {
    std::vector<double> own;
    for (const int k : of.places[rank]) own.push_back(numbers[k]);
    return own;
  };
  workers_.run(Task::set_some, [&](int r) { ranks.send(r, std::vector<int>{v}), ranks.send(r, of.rows[r]), ranks.send(r, part(r)); },
               [&] { own_.set_some(v, of.rows[0], part(0)); });
}

}  // namespace dotyk::multigrid
