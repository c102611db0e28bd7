#include <cmath>

#include "program/lcp.hpp"

namespace dotyk::program {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Rows of the tableau w − Mz − e z₀ = q, columns w (n), z (n), z₀, right-hand side.
class Tableau {
 public:
  explicit Tableau(const Lcp& lcp) : n_(lcp.size()), t_(n_, 2 * n_ + 2), basis_(n_) {
    t_.leftCols(n_).setIdentity();
    t_.middleCols(n_, n_) = -lcp.M;
    t_.col(2 * n_).setConstant(-1);
    t_.col(2 * n_ + 1) = lcp.q;
    for (int i = 0; i < n_; ++i) basis_[i] = i;
  }

  int artificial() const { return 2 * n_; }
  int complement(int variable) const { return variable < n_ ? variable + n_ : variable - n_; }

  /// The lexicographically least row of right-hand side and inverse: z₀ enters there.
  int most_negative() const {
    int best = 0;
    for (int i = 1; i < n_; ++i)
      if (less(i, 1, best, 1)) best = i;
    return best;
  }

  /// Lexicographic ratio test; −1 on a ray. z₀ leaves whenever it may.
  int leaving(int entering) const {
    const double least = 1e-11 * std::max(1.0, t_.col(entering).cwiseAbs().maxCoeff());
    int best = -1;
    for (int i = 0; i < n_; ++i) {
      if (t_(i, entering) <= least) continue;
      if (best < 0 || less(i, t_(i, entering), best, t_(best, entering))) best = i;
    }
    if (best < 0) return -1;
    const double ratio = t_(best, 2 * n_ + 1) / t_(best, entering);
    for (int i = 0; i < n_; ++i)
      if (basis_[i] == artificial() && t_(i, entering) > least &&
          t_(i, 2 * n_ + 1) / t_(i, entering) <= ratio + 1e-12 * (1 + std::abs(ratio)))
        return i;
    return best;
  }

  /// `entering` takes the place of the basic variable of a row, which is returned.
  int pivot(int row, int entering) {
    t_.row(row) /= t_(row, entering);
    for (int i = 0; i < n_; ++i)
      if (i != row && t_(i, entering) != 0) t_.row(i) -= t_(i, entering) * t_.row(row).eval();
    std::swap(basis_[row], entering);
    return entering;
  }

  FreeSet free() const {
    FreeSet set(n_, 0);
    for (int variable : basis_)
      if (variable >= n_ && variable < 2 * n_) set[variable - n_] = 1;
    return set;
  }

 private:
  /// Row a over pivot pa before row b over pb: right-hand side first, then the columns of the inverse.
  bool less(int a, double pa, int b, double pb) const {
    const auto compare = [&](int column) { return t_(a, column) / pa - t_(b, column) / pb; };
    for (int k = -1; k < n_; ++k) {
      const int column = k < 0 ? 2 * n_ + 1 : k;
      const double d = compare(column);
      if (std::abs(d) > 1e-12 * (1 + std::abs(t_(a, column) / pa))) return d < 0;
    }
    return a < b;
  }

  int n_;
  DenseMatrix t_;
  std::vector<int> basis_;
};

}  // namespace

Lemke lemke(const Lcp& lcp, int max_pivots) {
  Lemke out;
  out.z = Vector::Zero(lcp.size());
  if (lcp.size() == 0 || lcp.q.minCoeff() >= 0) {
    out.solved = true;
    return out;
  }
  Tableau tableau(lcp);
  int entering = tableau.complement(tableau.pivot(tableau.most_negative(), tableau.artificial()));
  for (out.pivots = 1; out.pivots < max_pivots; ++out.pivots) {
    const int row = tableau.leaving(entering);
    if (row < 0) {
      out.ray = true;
      return out;
    }
    const int left = tableau.pivot(row, entering);
    if (left == tableau.artificial()) {
      const Vector z = on_set(lcp, tableau.free());  // the tableau's numbers carry the errors of all pivots
      if (z.size()) out.z = z, out.solved = true;
      return out;
    }
    entering = tableau.complement(left);
  }
  return out;
}

}  // namespace dotyk::program
