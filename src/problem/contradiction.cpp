#include "problem/contradiction.hpp"

#include <tuple>

#include "algebra/dense/cone_least_squares.hpp"

namespace dotyk::problem {

using algebra::SparseRows;
using algebra::Vector;

namespace {

/// Of a row's length: a smaller entry gives it no unknown of its own, and moves nothing.
constexpr double kEntry = 1e-6;
/// Rows that only displacements of so many times their violation satisfy are contradictory: a displacement that satisfies them is at least -cᵀμ/‖Bᵀμ‖.
constexpr double kFar = 1e6;

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

/// μ of rows divided by their lengths and by `most`; empty where some displacement satisfies all.
Vector farkas(const Problem& problem, const std::vector<int>& rows, const std::vector<Holds>& kind, double most) {
  const SparseRows B = problem.near_rows().B;
  const Eigen::Index count = B.cols() + 1;  // c after the columns of B
  algebra::Triplets entries;
  algebra::ConvexSet set;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int r = rows[k], own = static_cast<int>(k);
    const double length = B.row(r).norm();
    entries.emplace_back(own, static_cast<int>(B.cols()), problem.c[r] / (length * most));
    for (SparseRows::InnerIterator it(B, r); it; ++it) entries.emplace_back(own, static_cast<int>(it.col()), it.value() / length);
    set.low.push_back(kind[r] == Holds::one_sided ? 0 : -INFINITY), set.high.push_back(INFINITY);
  }
  const SparseRows A = algebra::from_triplets<SparseRows>(static_cast<Eigen::Index>(rows.size()), count, entries);
  const auto found = algebra::cone_least_squares(A, Vector(-Vector::Unit(count, count - 1)), set);
  return found.residual.head(count - 1).norm() * kFar <= 1 + found.residual[count - 1] ? found.x : Vector();
}

}  // namespace

std::optional<Contradiction> contradiction(const Problem& problem, double tol) {
  std::vector<Holds> kind = how_rows_hold(problem);
  double most = 0;
  const auto left = [&] {  // rows, and how much rest violates them
    std::vector<int> rows;
    most = 0;
    for (int r = 0; r < problem.rows(); ++r)
      if (kind[r] != Holds::other) rows.push_back(r), most = std::max(most, kind[r] == Holds::one_sided ? -problem.c[r] : std::abs(problem.c[r]));
    return rows;
  };
  left();
  if (most <= tol) return std::nullopt;  // mostly
  take_away_free(problem, kind);
  const std::vector<int> rows = left();
  if (most <= tol) return std::nullopt;
  const Vector mu = farkas(problem, rows, kind, most);
  std::vector<std::tuple<bool, double, int>> order;  // what counts most last, one-sided rows after bilateral ones
  for (Eigen::Index k = 0; k < mu.size(); ++k)
    if (const int r = rows[static_cast<std::size_t>(k)]; std::abs(mu[k]) > kEntry * mu.lpNorm<Eigen::Infinity>())
      order.emplace_back(kind[r] == Holds::one_sided, std::abs(mu[k]) / problem.B.row(r).norm(), r);
  std::ranges::sort(order);
  if (order.empty() || most <= tol * std::get<1>(order.back())) return std::nullopt;
  Contradiction found{std::get<2>(order.back()), most / std::get<1>(order.back()), {}};
  for (auto it = order.rbegin() + 1; it != order.rend(); ++it) found.others.push_back(std::get<2>(*it));
  return found;
}

}  // namespace dotyk::problem
