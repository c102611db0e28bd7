#include "solver/core/turned_nodes.hpp"

#include "algebra/congruent.hpp"
#include "algebra/dense/decompositions.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Block;
using problem::Problem;

namespace {

/// Fewer rows than these cost nothing.
constexpr std::size_t kFewTurned = 100;
/// Of singular values beside the greatest: rows of a node that depend on each other stay rows; motions that turned nodes stop.
constexpr double kDependent = 1e-8, kStopped = 1e-9;

}  // namespace

TurnedNodes::TurnedNodes(const Problem& problem) : RowSubset(problem) {
  const std::vector<int> node = problem::nodes(problem);
  std::map<int, std::vector<int>> rows;  // by node
  std::size_t count = 0;
  for (const problem::RowGroup& group : problem.groups) {
    if (!prescribes(group)) continue;
    for (int r = group.first; r < group.first + group.count; ++r) {
      int at = -1;
      bool one = true;
      for (SparseRows::InnerIterator it(problem.B, r); one && it; ++it) {
        if (it.value() == 0) continue;
        one = at < 0 || node[it.col()] == at;
        at = node[it.col()];
      }
      if (one && at >= 0) rows[at].push_back(r), ++count;
    }
  }
  if (count < kFewTurned) return;
  u0_ = Vector::Zero(problem.unknowns());
  std::vector<char> kept(problem.rows(), 1);
  std::vector<Eigen::Triplet<double>> entries;
  int columns = 0, next = 0;
  const auto keep_until = [&](int end) {
    for (; next < end; ++next) entries.emplace_back(next, columns++, 1);
  };
  for (auto& [number, list] : rows) {
    const auto [begin, end] = std::equal_range(node.begin(), node.end(), number);
    Node n{static_cast<int>(begin - node.begin()), static_cast<int>(end - begin), std::move(list), {}};
    const int given = static_cast<int>(n.rows.size());
    if (given > n.unknowns) continue;
    n.R = DenseMatrix::Zero(given, n.unknowns);
    Vector c(given);
    for (int i = 0; i < given; ++i) {
      c[i] = problem.c[n.rows[i]];
      for (SparseRows::InnerIterator it(problem.B, n.rows[i]); it; ++it) n.R(i, it.col() - n.first) = it.value();
    }
    const algebra::SingularFactors f = algebra::singular_factors(n.R);
    if (f.rank(kDependent * f.values[0]) < given) continue;
    keep_until(n.first);
    for (int k = given; k < n.unknowns; ++k, ++columns)
      for (int i = 0; i < n.unknowns; ++i) entries.emplace_back(n.first + i, columns, f.V(i, k));
    next = n.first + n.unknowns;
    u0_.segment(n.first, n.unknowns) = algebra::MinimumNorm(n.R).solve(c);
    for (const int r : n.rows) kept[r] = 0;
    nodes_.push_back(std::move(n));
  }
  keep_until(problem.unknowns());
  T_.resize(problem.unknowns(), columns);
  T_.setFromTriplets(entries.begin(), entries.end());
  take(std::move(kept));
}

Problem TurnedNodes::turned() const {
  Problem out = restricted();
  out.c -= out.B * u0_;
  out.B = out.B * T_;
  int first = 0;
  auto n = nodes_.begin();
  for (Block& block : out.blocks) {
    const int begin = block.first, end = begin + block.size();
    const int after = static_cast<int>(std::partition_point(nodes_.begin(), nodes_.end(), [&](const Node& some) { return some.first < end; }) - nodes_.begin());
    int rows = 0;
    for (auto k = n; k < nodes_.begin() + after; ++k) rows += static_cast<int>(k->rows.size());
    block.first = first;
    if (rows > 0) {
      const SparseMatrix T = T_.block(begin, first, end - begin, end - begin - rows);
      const Vector u0 = u0_.segment(begin, end - begin);
      const Vector held = block.K.times(u0);
      DenseMatrix moved(rows, block.kernel.cols());  // what the rows notice of motions
      double size = 0;
      std::vector<int> kept_nodes;
      int next = 0, at = 0;
      for (; n < nodes_.begin() + after; ++n) {
        moved.middleRows(at, n->R.rows()) = n->R * block.kernel.middleRows(n->first - begin, n->unknowns);
        at += static_cast<int>(n->R.rows()), size = std::hypot(size, n->R.norm());
        for (; next < n->first - begin + n->unknowns - n->R.rows(); ++next) kept_nodes.push_back(block.node[next]);
        next = n->first - begin + n->unknowns;
      }
      for (; next < end - begin; ++next) kept_nodes.push_back(block.node[next]);
      block.offset += 0.5 * u0.dot(held) - block.f.dot(u0);
      block.f = T.transpose() * (block.f - held);
      block.K = algebra::congruent(block.K, T);
      if (block.kernel.cols() > 0) {
        const algebra::SingularFactors f = algebra::singular_factors(moved);
        const DenseMatrix unnoticed = block.kernel * f.V.rightCols(block.kernel.cols() - f.rank(kStopped * size * block.kernel.norm()));
        block.kernel = T.transpose() * unnoticed;
      }
      block.motions.clear();
      block.node = std::move(kept_nodes);
      if (block.rigid) block.rigid = [rigid = block.rigid, T] { return DenseMatrix(T.transpose() * rigid()); };
      block.coarse = {};
    }
    first += block.size();
  }
  return out;
}

Beginning TurnedNodes::turned(const Beginning& from) const {
  Beginning out = restricted(from);
  if (out.from) out.from = std::make_shared<problem::State>(problem::State{T_.transpose() * (out.from->u.here() - u0_), out.from->lambda});
  return out;
}

void TurnedNodes::extend(Result& result) const {
  RowSubset::extend(result);
  problem::State& state = result.state;
  state.u = T_ * state.u.here() + u0_;
  const Vector left = problem().load() - problem().B.transpose() * state.lambda - problem::stiffness_times(problem(), state.u);
  for (const Node& n : nodes_) {
    const Vector forces = algebra::MinimumNorm(n.R).solve_transposed(left.segment(n.first, n.unknowns));
    for (std::size_t i = 0; i < n.rows.size(); ++i) state.lambda[n.rows[i]] = forces[static_cast<Eigen::Index>(i)];
    for (auto& flags : result.active_sets)
      for (const int r : n.rows) flags[r] = 1;
  }
}

}  // namespace dotyk::solver
