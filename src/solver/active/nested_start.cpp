#include "solver/active/nested_start.hpp"

#include "solver/active/box_barrier.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using problem::Problem;

constexpr int kFewest = 8;           ///< rows of the longest chain to begin with
constexpr int kMostSolves = 10;      ///< of active sets on one set of rows
constexpr int kMostByBarrier = 600;  ///< rows; the work grows as their third power
constexpr double kPreciseStart = 1e-7;

class ChainedRows {
 public:
  ChainedRows(const Problem& problem, const problem::CondensedProblem& condensed, const problem::Measure& measure, const Vector& rho)
      : problem_(problem), measure_(measure), rho_(rho), condensed_(condensed), group_(problem.group_of_rows()), stands_for_(problem.rows(), 1), pieces_(problem.rows(), Piece::between) {}

  /// From every `widest`-th row on.
  NestedStart run(int widest, Step& step) {
    for (int stride = widest; stride > 1; stride /= 2) {
      keep(stride);
      Linearisation l = begin();
      Vector x;
      const bool done = (stride < widest && iterate(step, l, x)) || by_barrier(l, x);
      if (!done && x.size() == 0) break;
      spread(stride, l, x);
    }
    keep(1);
    return {begin(), solves_};
  }

 private:
  enum class Piece : char { least, between, greatest };

  /// Every stride-th row of a chain, and its last one; what is left out is borne by the two about it.
  void keep(int stride) {
    for (const auto& chain : problem_.chains) {
      const int last = static_cast<int>(chain.size()) - 1;
      for (const int row : chain) stands_for_[row] = 0;
      for (int i = 0, next; i < last; i = next) {
        next = std::min(i + stride, last);
        for (const int end : {i, next}) stands_for_[chain[end]] += (next - i) / 2.0;
      }
      for (const int end : {0, last}) stands_for_[chain[end]] += 0.5;
    }
  }

  Linearisation begin() const {
    Linearisation l(problem_.rows());
    for (int r = 0; r < problem_.rows(); ++r) {
      const auto [low, high] = bounds(r);
      const double f = stands_for_[r];
      double y = 0;
      if (pieces_[r] == Piece::least) y = f * low - force_;
      else if (pieces_[r] == Piece::greatest) y = f * high + force_;
      else if (std::isfinite(low) && std::isfinite(high)) y = f * (low + high) / 2;
      else if (std::isfinite(low)) y = f * low + force_;
      else if (std::isfinite(high)) y = f * high - force_;
      set(l, r, y);
    }
    return l;
  }

  problem::Interval bounds(int row) const { return group_[row]->law->multipliers(row - group_[row]->first); }

  /// The law of as many rows as it stands for: P(y) = f P₁(y/f), ρ likewise.
  void set(Linearisation& l, int row, double y) const {
    const double f = stands_for_[row];
    const problem::Projection p = f > 0 ? group_[row]->law->project(row - group_[row]->first, y / f, rho_[row] / f) : problem::Projection{0, 0};
    l.set(row, y, {f * p.lambda, p.slope});
  }

  Piece piece(const Linearisation& l, int row) const {
    const auto [low, high] = bounds(row);
    if (l.slope[row] > 0 || low == high || stands_for_[row] == 0) return Piece::between;
    return std::isfinite(high) && l.value[row] >= stands_for_[row] * (std::isfinite(low) ? (low + high) / 2 : high) ? Piece::greatest : Piece::least;
  }

  void size(const Vector& lambda) { force_ = std::max(lambda.lpNorm<Eigen::Infinity>(), 1e-300); }

  /// Active sets until they repeat; false where they do not.
  bool iterate(Step& step, Linearisation& l, Vector& x) {
    for (int k = 0; k < kMostSolves; ++k) {
      Vector lambda;
      if (!step.solve(l, lambda, x)) return false;
      ++solves_;
      size(lambda);
      Linearisation next(problem_.rows());
      for (int r = 0; r < problem_.rows(); ++r) set(next, r, lambda[r] + rho_[r] * x[r]);
      std::swap(l, next);
      if (l.changed(next).empty()) return true;
    }
    return false;
  }

  bool by_barrier(Linearisation& l, Vector& x) {
    std::vector<int> rows;
    for (int r = 0; r < problem_.rows(); ++r)
      if (stands_for_[r] > 0) rows.push_back(r);
    if (static_cast<int>(rows.size()) > kMostByBarrier) return false;
    const BoxSolution s = solve_by_barrier(box_program(problem_, condensed_, measure_, rows, stands_for_), kPreciseStart);
    solves_ += s.iterations;
    if (!s.converged) return false;
    Vector lambda = Vector::Zero(problem_.rows());
    lambda(rows) = s.lambda;
    for (std::size_t k = 0; k < rows.size(); ++k)
      pieces_[rows[k]] = s.side[k] < 0 ? Piece::least : s.side[k] > 0 ? Piece::greatest : Piece::between;
    size(lambda);
    x = condensed_.jump(lambda, s.alpha);
    l = begin();
    return true;
  }

  /// To the rows of half the stride.
  void spread(int stride, const Linearisation& l, const Vector& x) {
    for (int r = 0; r < problem_.rows(); ++r)
      if (stands_for_[r] > 0) pieces_[r] = piece(l, r);
    for (const auto& chain : problem_.chains) {
      const int last = static_cast<int>(chain.size()) - 1;
      for (int i = 0, next; i < last; i = next) {
        next = std::min(i + stride, last);
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

  const Problem& problem_;
  const problem::Measure& measure_;
  const Vector& rho_;
  const problem::CondensedProblem& condensed_;
  const std::vector<const problem::RowGroup*> group_;  ///< of a row
  std::vector<double> stands_for_;                     ///< rows that a kept one stands for; 0: left out
  std::vector<Piece> pieces_;
  double force_ = 1;                                   ///< scale of multipliers
  int solves_ = 0;
};

}  // namespace

std::optional<NestedStart> nested_start(const Problem& problem, const problem::CondensedProblem& condensed, const problem::Measure& measure,
                                        const Vector& rho, Step& step) {
  std::size_t longest = 0;
  for (const auto& chain : problem.chains) longest = std::max(longest, chain.size());
  int widest = 1;
  while (longest / (2 * widest) >= kFewest) widest *= 2;
  if (widest == 1) return std::nullopt;
  return ChainedRows(problem, condensed, measure, rho).run(widest, step);
}

}  // namespace dotyk::solver
