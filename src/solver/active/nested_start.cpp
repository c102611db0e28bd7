#include "solver/active/nested_start.hpp"

#include <algorithm>
#include <cmath>

#include "solver/active/box_barrier.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::Problem;

namespace {

constexpr int kFewest = 8;    ///< rows of the longest chain to begin with
constexpr int kMostSolves = 10;      ///< of active sets on one set of rows
constexpr int kMostByBarrier = 600;  ///< rows; the work grows as their third power
constexpr double kPreciseStart = 1e-7;

}  // namespace

NestedStart::NestedStart(const Problem& problem, const problem::CondensedProblem& condensed, const Vector& rho)
    : problem_(problem), rho_(rho), condensed_(condensed), group_(problem.group_of_rows()), stands_for_(problem.rows(), 1), pieces_(problem.rows(), Piece::between) {
  std::size_t longest = 0;
  for (const auto& chain : problem.chains) longest = std::max(longest, chain.size());
  while (longest / (2 * stride_) >= kFewest) stride_ *= 2;
}

Linearisation NestedStart::run(Step& step) {
  for (int stride = stride_; stride > 1; stride /= 2) {
    keep(stride);
    Linearisation l = begin();
    Vector x;
    const bool done = (stride < stride_ && iterate(step, l, x)) || by_barrier(l, x);
    if (!done && x.size() == 0) break;
    spread(stride, l, x);
  }
  keep(1);
  return begin();
}

/// Every stride-th row of a chain, and its last one; what is left out is borne by the two about it.
void NestedStart::keep(int stride) {
  for (const auto& chain : problem_.chains) {
    const int last = static_cast<int>(chain.size()) - 1;
    for (const int row : chain) stands_for_[row] = 0;
    for (int i = 0; i <= last; i += stride) {
      const int next = std::min(i + stride, last);
      if (i == last) {
        stands_for_[chain[i]] += 0.5;
      } else {
        stands_for_[chain[i]] += (next - i) / 2.0;
        stands_for_[chain[next]] += (next - i) / 2.0;
      }
      if (i == 0) stands_for_[chain[i]] += 0.5;
    }
    if (last % stride != 0) stands_for_[chain[last]] += 0.5;
  }
}

Linearisation NestedStart::begin() const {
  Linearisation l(problem_.rows());
  for (int r = 0; r < problem_.rows(); ++r) set(l, r, pieces_[r]);
  return l;
}

/// The law of as many rows as it stands for: P(y) = f P₁(y/f), ρ likewise.
void NestedStart::set(Linearisation& l, int row, double y) const {
  const double f = stands_for_[row];
  const problem::Projection p = f > 0 ? group_[row]->law->project(row - group_[row]->first, y / f, rho_[row] / f) : problem::Projection{0, 0};
  l.y[row] = y;
  l.value[row] = f * p.lambda;
  l.slope[row] = p.slope;
  l.active[row] = p.slope > 0;
}

void NestedStart::set(Linearisation& l, int row, Piece piece) const {
  const auto [low, high] = group_[row]->law->multipliers(row - group_[row]->first);
  const double f = stands_for_[row];
  double y = 0;
  if (piece == Piece::least) y = f * low - force_;
  else if (piece == Piece::greatest) y = f * high + force_;
  else if (std::isfinite(low) && std::isfinite(high)) y = f * (low + high) / 2;
  else if (std::isfinite(low)) y = f * low + force_;
  else if (std::isfinite(high)) y = f * high - force_;
  set(l, row, y);
}

Linearisation NestedStart::linearise(const Vector& lambda, const Vector& x) const {
  Linearisation l(problem_.rows());
  for (int r = 0; r < problem_.rows(); ++r) set(l, r, lambda[r] + rho_[r] * x[r]);
  return l;
}

NestedStart::Piece NestedStart::piece(const Linearisation& l, int row) const {
  if (l.slope[row] > 0) return Piece::between;
  const auto [low, high] = group_[row]->law->multipliers(row - group_[row]->first);
  if (low == high || stands_for_[row] == 0) return Piece::between;
  return std::isfinite(high) && l.value[row] >= stands_for_[row] * (std::isfinite(low) ? (low + high) / 2 : high) ? Piece::greatest : Piece::least;
}

/// Active sets until they repeat; false where they do not.
bool NestedStart::iterate(Step& step, Linearisation& l, Vector& x) {
  for (int k = 0; k < kMostSolves; ++k) {
    Vector lambda;
    if (!step.solve(l, lambda, x)) return false;
    ++solves_;
    force_ = std::max(lambda.lpNorm<Eigen::Infinity>(), 1e-300);
    const Linearisation next = linearise(lambda, x);
    bool same = true;
    for (int r = 0; r < problem_.rows() && same; ++r) same = next.same_piece(l, r);
    l = next;
    if (same) return true;
  }
  return false;
}

bool NestedStart::by_barrier(Linearisation& l, Vector& x) {
  std::vector<int> rows;
  for (int r = 0; r < problem_.rows(); ++r)
    if (stands_for_[r] > 0) rows.push_back(r);
  if (static_cast<int>(rows.size()) > kMostByBarrier) return false;
  const BoxSolution s = solve_by_barrier(box_program(problem_, condensed_, rows, stands_for_), kPreciseStart);
  solves_ += s.iterations;
  if (!s.converged) return false;
  Vector lambda = Vector::Zero(problem_.rows());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    lambda[rows[k]] = s.lambda[k];
    pieces_[rows[k]] = s.side[k] < 0 ? Piece::least : s.side[k] > 0 ? Piece::greatest : Piece::between;
  }
  force_ = std::max(lambda.lpNorm<Eigen::Infinity>(), 1e-300);
  x = condensed_.jump(lambda, s.alpha);
  l = begin();
  return true;
}

/// To the rows of half the stride.
void NestedStart::spread(int stride, const Linearisation& l, const Vector& x) {
  for (int r = 0; r < problem_.rows(); ++r)
    if (stands_for_[r] > 0) pieces_[r] = piece(l, r);
  for (const auto& chain : problem_.chains) {
    const int last = static_cast<int>(chain.size()) - 1;
    for (int i = 0; i < last; i += stride) {
      const int next = std::min(i + stride, last);
      const Piece a = pieces_[chain[i]], b = pieces_[chain[next]];
      for (int k = i + 1; k < next; ++k) {
        const int row = chain[k];
        if (a == b) pieces_[row] = a;
        else if (x[row] < 0 && (a == Piece::least || b == Piece::least)) pieces_[row] = Piece::least;
        else if (x[row] > 0 && (a == Piece::greatest || b == Piece::greatest)) pieces_[row] = Piece::greatest;
        else pieces_[row] = Piece::between;
      }
    }
  }
}

}  // namespace dotyk::solver
