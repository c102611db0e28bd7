#include "problem/contradiction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algebra/dense/cone_least_squares.hpp"

namespace dotyk::problem {

using algebra::SparseRows;
using algebra::Vector;

namespace {

/// Of a row's length: a smaller entry gives it no unknown of its own, and moves nothing.
constexpr double kEntry = 1e-6;
/// The least residual, of 1, that is one: rows which only displacements a billion times their violation satisfy are contradictory.
constexpr double kNone = 1e-9;

enum class Holds : char { other, one_sided, bilateral };

std::vector<Holds> how_rows_hold(const Problem& problem) {
  std::vector<Holds> kind(static_cast<std::size_t>(problem.rows()), Holds::other);
  for (const auto& [law, k, r] : problem.scalar_rows())
    if (!(problem.B.row(r).norm() > 0)) continue;
    else if (law.unilateral()) kind[r] = Holds::one_sided;
    else if (const auto stiffness = law.linear_stiffness(k); stiffness && std::isinf(*stiffness)) kind[r] = Holds::bilateral;
  return kind;
}

/// Takes rows away as long as one has an unknown of its own, which can satisfy it whatever the others do.
void take_away_free(const Problem& problem, std::vector<Holds>& kind) {
  const algebra::SparseMatrix columns = problem.B;
  std::vector<int> count(static_cast<std::size_t>(columns.cols()), 0), left;
  for (int r = 0; r < problem.rows(); ++r)
    for (SparseRows::InnerIterator it(problem.B, r); it; ++it) count[it.col()] += kind[r] != Holds::other;
  const auto free = [&](int r) {
    const double length = problem.B.row(r).norm();
    for (SparseRows::InnerIterator it(problem.B, r); it; ++it)
      if (count[it.col()] == 1 && std::abs(it.value()) > kEntry * length) return true;
    return false;
  };
  for (int r = problem.rows(); r-- > 0;) left.push_back(r);
  while (!left.empty()) {
    const int r = left.back();
    left.pop_back();
    if (kind[r] == Holds::other || !free(r)) continue;
    kind[r] = Holds::other;
    for (SparseRows::InnerIterator it(problem.B, r); it; ++it)
      if (--count[it.col()] == 1)
        for (algebra::SparseMatrix::InnerIterator at(columns, it.col()); at; ++at) left.push_back(static_cast<int>(at.row()));
  }
}

/// The rows that share unknowns, directly or through others, group by group.
std::vector<std::vector<int>> in_groups(const Problem& problem, const std::vector<Holds>& kind) {
  std::vector<int> root(static_cast<std::size_t>(problem.rows())), of(static_cast<std::size_t>(problem.B.cols()), -1);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int r) {
    while (root[r] != r) r = root[r] = root[root[r]];
    return r;
  };
  for (int r = 0; r < problem.rows(); ++r)
    for (SparseRows::InnerIterator it(problem.B, r); kind[r] != Holds::other && it; ++it)
      if (of[it.col()] < 0) of[it.col()] = r;
      else root[find(r)] = find(of[it.col()]);
  std::vector<std::vector<int>> all(root.size());
  for (int r = 0; r < problem.rows(); ++r)
    if (kind[r] != Holds::other) all[find(r)].push_back(r);
  std::erase_if(all, [](const auto& rows) { return rows.empty(); });
  return all;
}

/// μ of rows divided by their lengths and by `most`, one-sided ones first; empty where some displacement satisfies them.
Vector farkas(const Problem& problem, const std::vector<int>& rows, std::size_t one_sided, double most) {
  algebra::Triplets entries;
  std::vector<int> place(static_cast<std::size_t>(problem.B.cols()), -1);
  int count = 1;  // c before the columns of B
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int r = rows[k], own = static_cast<int>(k);
    const double length = problem.B.row(r).norm();
    entries.emplace_back(own, 0, problem.c[r] / (length * most));
    for (SparseRows::InnerIterator it(problem.B, r); it; ++it) {
      if (place[it.col()] < 0) place[it.col()] = count++;
      entries.emplace_back(own, place[it.col()], it.value() / length);
    }
  }
  const SparseRows A = algebra::from_triplets<SparseRows>(static_cast<Eigen::Index>(rows.size()), count, entries);
  algebra::ConvexSet set{std::vector<double>(rows.size(), -INFINITY), std::vector<double>(rows.size(), INFINITY), {}};
  std::fill_n(set.low.begin(), one_sided, 0.0);
  const auto found = algebra::cone_least_squares(A, Vector(-Vector::Unit(count, 0)), set, kNone);
  return found.residual.norm() <= kNone ? found.x : Vector();
}

}  // namespace

std::optional<Contradiction> contradiction(const Problem& problem, double tol) {
  std::vector<Holds> kind = how_rows_hold(problem);
  const auto violated = [&](int r) { return kind[r] == Holds::one_sided ? -problem.c[r] : kind[r] == Holds::bilateral ? std::abs(problem.c[r]) : 0; };
  const auto any = [&] {
    for (int r = 0; r < problem.rows(); ++r)
      if (violated(r) > tol) return true;
    return false;
  };
  if (!any()) return std::nullopt;  // mostly
  take_away_free(problem, kind);
  if (!any()) return std::nullopt;
  for (std::vector<int>& rows : in_groups(problem, kind)) {
    double most = 0;
    for (const int r : rows) most = std::max(most, violated(r));
    if (most <= tol) continue;
    const auto bilateral = std::stable_partition(rows.begin(), rows.end(), [&](int r) { return kind[r] == Holds::one_sided; });
    const Vector mu = farkas(problem, rows, static_cast<std::size_t>(bilateral - rows.begin()), most);
    if (mu.size() == 0) continue;
    const auto weight = [&](int k) { return std::abs(mu[k]) / problem.B.row(rows[k]).norm(); };
    std::vector<int> order(rows.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&, least = kEntry * mu.lpNorm<Eigen::Infinity>()](int k) { return std::abs(mu[k]) <= least; });
    std::ranges::sort(order, [&](int a, int b) {
      const bool first = kind[rows[a]] == Holds::one_sided, second = kind[rows[b]] == Holds::one_sided;
      return first != second ? first : weight(a) > weight(b);
    });
    Contradiction found{rows[order.front()], most / weight(order.front()), {}};
    if (found.by <= tol) continue;
    for (std::size_t k = 1; k < order.size(); ++k) found.others.push_back(rows[order[k]]);
    return found;
  }
  return std::nullopt;
}

}  // namespace dotyk::problem
