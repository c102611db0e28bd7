#include <cmath>
#include <optional>
#include <random>

#include "algebra/direct/indefinite.hpp"
#include "base/stopwatch.hpp"
#include "program/lcp.hpp"

namespace dotyk::program {

using algebra::SparseMatrix;
using algebra::Vector;

namespace {

constexpr int kUpdates = 64;  ///< of a factor, before it is made anew

/// The basis B of n of the columns of w − Mz − e z₀ = q; variables are w (n), z (n), z₀.
class Basis {
 public:
  explicit Basis(const Lcp& lcp) : lcp_(lcp), n_(lcp.size()), q_(lcp.q), p_(n_), variable_(n_) {
    std::mt19937 engine(1);
    for (double& x : p_) x = 1 + engine() / 4294967296.0;
    for (int i = 0; i < n_; ++i) variable_[i] = i;
    factor();
  }

  int artificial() const { return 2 * n_; }
  int complement(int variable) const { return variable < n_ ? variable + n_ : variable - n_; }
  bool regular() const { return !factor_->singular(); }

  /// B⁻¹ times the column of a variable.
  Vector column(int variable) const {
    Vector c = Vector::Zero(n_);
    if (variable == artificial()) c.setConstant(-1);
    else if (variable < n_) c[variable] = 1;
    else c = -lcp_.M.col(variable - n_);
    return solve(std::move(c));
  }

  /// The row that z₀ enters at.
  int most_negative() const {
    int best = 0;
    for (int i = 1; i < n_; ++i)
      if (less(i, 1, best, 1)) best = i;
    return best;
  }

  /// The row at which a variable of this column enters; −1 on a ray. z₀ leaves whenever it may.
  int leaving(const Vector& entering) const {
    const double least = 1e-11 * std::max(1.0, entering.cwiseAbs().maxCoeff());
    int best = -1;
    for (int i = 0; i < n_; ++i)
      if (entering[i] > least && (best < 0 || less(i, entering[i], best, entering[best]))) best = i;
    if (best < 0) return -1;
    const double ratio = x_[best] / entering[best];
    for (int i = 0; i < n_; ++i)
      if (variable_[i] == artificial() && entering[i] > least && x_[i] / entering[i] <= ratio + 1e-12 * (1 + std::abs(ratio)))
        return i;
    return best;
  }

  /// `entering`, of this column, takes the place of the variable of a row, which is returned.
  int pivot(int row, int entering, Vector column) {
    std::swap(variable_[row], entering);
    updates_.push_back({row, std::move(column)});
    if (updates_.size() == kUpdates) factor();
    else updates_.back().apply(x_), updates_.back().apply(slope_);
    return entering;
  }

  FreeSet free() const {
    FreeSet set(n_, 0);
    for (int variable : variable_)
      if (variable >= n_ && variable < 2 * n_) set[variable - n_] = 1;
    return set;
  }

 private:
  struct Update {
    int row;
    Vector column;
    void apply(Vector& v) const {
      if (v[row] == 0) return;
      const double at = v[row] / column[row];
      v -= at * column;
      v[row] = at;
    }
  };

  void factor() {
    algebra::Triplets entries;
    for (int k = 0; k < n_; ++k)
      if (const int v = variable_[k]; v < n_) entries.emplace_back(v, k, 1);
      else if (v == artificial())
        for (int i = 0; i < n_; ++i) entries.emplace_back(i, k, -1);
      else
        for (SparseMatrix::InnerIterator it(lcp_.M, v - n_); it; ++it) entries.emplace_back(it.row(), k, -it.value());
    matrix_ = algebra::from_triplets(n_, n_, entries);
    factor_.emplace(matrix_);
    updates_.clear();
    if (regular()) x_ = solve(q_), slope_ = solve(p_);
  }

  Vector solve(Vector b) const {
    b = factor_->solve(b);
    for (const Update& update : updates_) update.apply(b);
    return b;
  }

  /// Row a over pivot pa before row b over pb: the solution first, then how it changes with ε.
  bool less(int a, double pa, int b, double pb) const {
    const double value = x_[a] / pa, difference = value - x_[b] / pb;
    if (std::abs(difference) > 1e-12 * (1 + std::abs(value))) return difference < 0;
    return slope_[a] / pa < slope_[b] / pb;
  }

  const Lcp& lcp_;
  int n_;
  Vector q_, p_, x_, slope_;  ///< x = B⁻¹q, slope = B⁻¹p
  std::vector<int> variable_;
  SparseMatrix matrix_;
  std::optional<algebra::SparseLu> factor_;
  std::vector<Update> updates_;
};

}  // namespace

Lemke lemke(const Lcp& lcp, Monitor& monitor, int max_pivots) {
  Lemke out;
  out.z = Vector::Zero(lcp.size());
  if (lcp.size() == 0 || lcp.q.minCoeff() >= 0) {
    out.solved = true;
    return out;
  }
  const Stopwatch clock;
  Basis basis(lcp);
  int entering = basis.artificial();
  for (; out.pivots < max_pivots && basis.regular() && !monitor.stop(); ++out.pivots) {
    Vector column = basis.column(entering);
    const int row = out.pivots == 0 ? basis.most_negative() : basis.leaving(column);
    if (row < 0) {
      out.ray = true;
      return out;
    }
    const int left = basis.pivot(row, entering, std::move(column));
    if (left == basis.artificial()) {
      const Vector z = on_set(lcp, basis.free());  // the basis's numbers carry the errors of updates
      if (z.size()) out.z = z, out.solved = true;
      return out;
    }
    if (out.pivots % kUpdates == 0) monitor.iteration({.iteration = out.pivots, .changed = 1, .seconds = clock.seconds()});
    entering = basis.complement(left);
  }
  return out;
}

}  // namespace dotyk::program
