#include "algebra/dense/cone_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algebra/direct/cholesky.hpp"
#include "algebra/direct/stop_factoring.hpp"

namespace dotyk::algebra {
namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

/// s at first and at most, in units of what makes sAᵀA of size 1; by what it grows.
constexpr double kFirst = 1e2, kLast = 1e11, kGrows = 1e3, kGrowsSlowly = 4, kBack = 20;
constexpr int kFew = 6;  ///< Newton steps, after which it grows much
constexpr int kMostProximal = 60, kMostNewton = 40, kMostHalvings = 30;
/// Of the residual: what rounding of x, blown up by s, may leave in it.
constexpr double kNoise = 1e-3;
/// Of the data: rounding in b − Aᵀx, and what a proximal step may leave in A w.
constexpr double kRounding = 1e-15, kSmall = 1e-12;

/// Π and a derivative of it, of a round.
void project(const ConvexSet::Round& round, const SmallVector& y, SmallVector& value, Small& slope) {
  const Eigen::Index d = round.components, k = round.variables();
  const double length = y.tail(d).norm();
  value = y, slope = Small::Identity(k, k);
  if (!(round.slope > 0)) {
    if (length <= round.radius) return;
    const SmallVector along = y / length;
    value = round.radius * along;
    slope = round.radius / length * (Small::Identity(d, d) - along * along.transpose());
    return;
  }
  const double mu = round.slope, n = y[0];
  if (length <= mu * n) return;
  if (mu * length < -n) {
    value.setZero(), slope.setZero();
    return;
  }
  const SmallVector along = y.tail(d) / length;
  const double nearest = (n + mu * length) / (1 + mu * mu);
  value[0] = nearest, value.tail(d) = mu * nearest * along;
  SmallVector edge(k);
  edge << 1, mu * along;
  slope = edge * edge.transpose() / (1 + mu * mu);
  slope.bottomRightCorner(d, d) += mu * nearest / length * (Small::Identity(d, d) - along * along.transpose());
}

/// Variables of one factor of the set: their rows of A on the columns that these have, and where the products stand in H.
struct Factor {
  int first;
  const ConvexSet::Round* round;  ///< none: an interval
  DenseMatrix rows;
  std::vector<int> place;  ///< of the pairs of columns, lower triangle by columns
};

class Minimisation {
 public:
  Minimisation(const SparseRows& A, const Vector& b, const ConvexSet& set, double enough)
      : A_(A), lengths_(A.cwiseAbs()), b_(b), set_(set), enough_(enough * b.norm()), x_(Vector::Zero(A.rows())), w_(b) {
    std::vector<std::vector<int>> columns;
    int first = 0;
    for (std::size_t k = 0; k < set.low.size(); ++k) add(first++, 1, nullptr, columns);
    for (const ConvexSet::Round& round : set.rounds) add(first, round.variables(), &round, columns), first += round.variables();
    make_pattern(columns);
  }

  ConeLeastSquares run() {
    double unit = 0;
    for (int r = 0; r < A_.rows(); ++r) unit += A_.row(r).squaredNorm();
    unit = unit > 0 ? static_cast<double>(A_.cols()) / unit : 1;
    std::vector<int> own(static_cast<std::size_t>(A_.cols()));
    std::iota(own.begin(), own.end(), 0);
    if (A_.rows() > 0) cholesky_.emplace_back(H_, own, std::vector<int>{});
    s_ = kLast * unit;
    if (!start_without_limits()) s_ = kFirst * unit;
    residual_ = b_ - A_.transpose() * x_;
    w_ = residual_;
    bool done = residual_.norm() <= enough_ || A_.rows() == 0;
    for (int k = 0; !done && k < kMostProximal; ++k) {
      const int before = steps_;
      begin();
      if (!newton()) {  // too far at once
        s_ /= kBack;
        w_ = residual_;
        last_s_ = 0;
        grows_ = kGrowsSlowly;
        continue;
      }
      const double moved = (value_ - x_).lpNorm<Eigen::Infinity>() / s_;
      x_ = value_;
      residual_ = b_ - A_.transpose() * x_;
      const double size = residual_.norm();
      done = size <= enough_;
      if (!done && moved <= kSmall * size && (w_ - residual_).norm() <= kNoise * size) {
        residual_ = w_;  // s does not blow up its rounding, as it does in x
        done = true;
      }
      last_s_ = s_;
      if (steps_ - before > kFew) grows_ = kGrowsSlowly;
      s_ = std::min(s_ * grows_, kLast * unit);
    }
    return {x_, residual_, steps_, done};
  }

 private:
  void add(int first, int count, const ConvexSet::Round* round, std::vector<std::vector<int>>& columns) {
    std::vector<int> own;
    for (int r = first; r < first + count; ++r)
      for (SparseRows::InnerIterator it(A_, r); it; ++it) own.push_back(static_cast<int>(it.col()));
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    Factor factor{first, round, DenseMatrix::Zero(count, static_cast<Eigen::Index>(own.size())), {}};
    for (int r = first; r < first + count; ++r)
      for (SparseRows::InnerIterator it(A_, r); it; ++it)
        factor.rows(r - first, std::lower_bound(own.begin(), own.end(), static_cast<int>(it.col())) - own.begin()) = it.value();
    factors_.push_back(std::move(factor));
    columns.push_back(std::move(own));
  }

  void make_pattern(const std::vector<std::vector<int>>& columns) {
    Triplets entries;
    for (int j = 0; j < A_.cols(); ++j) entries.emplace_back(j, j, 1.0);
    for (const auto& own : columns)
      for (std::size_t j = 0; j < own.size(); ++j)
        for (std::size_t i = j; i < own.size(); ++i) entries.emplace_back(own[i], own[j], 0.0);
    H_ = from_triplets(A_.cols(), A_.cols(), entries);
    const int *start = H_.outerIndexPtr(), *row = H_.innerIndexPtr();
    for (std::size_t f = 0; f < columns.size(); ++f)
      for (std::size_t j = 0; j < columns[f].size(); ++j)
        for (std::size_t i = j; i < columns[f].size(); ++i) {
          const int c = columns[f][j];
          factors_[f].place.push_back(static_cast<int>(std::lower_bound(row + start[c], row + start[c + 1], columns[f][i]) - row));
        }
  }

  /// Π(y) in value_, and its derivative.
  void project(const Vector& y) {
    value_.resize(y.size());
    slopes_.resize(factors_.size());
    for (std::size_t f = 0; f < factors_.size(); ++f) {
      const Factor& factor = factors_[f];
      if (!factor.round) {
        const double low = set_.low[f], high = set_.high[f], own = y[factor.first];
        value_[factor.first] = std::clamp(own, low, high);
        slopes_[f] = Small::Constant(1, 1, own >= low && own <= high && low < high ? 1 : 0);
        continue;
      }
      SmallVector value;
      algebra::project(*factor.round, y.segment(factor.first, factor.round->variables()), value, slopes_[f]);
      value_.segment(factor.first, value.size()) = value;
    }
  }

  /// The function whose gradient in w is w − b + AᵀΠ(x + sAw); sets the gradient and value_.
  double at(const Vector& w) {
    const Vector y = x_ + s_ * (A_ * w);
    project(y);
    gradient_ = w - b_ + A_.transpose() * value_;
    // yᵀΠ(y) − ½‖Π(y)‖² less its value at s = 0, without cancellation
    return 0.5 * w.squaredNorm() - b_.dot(w) + (value_.dot(y) - 0.5 * value_.squaredNorm() - 0.5 * x_.squaredNorm()) / s_;
  }

  bool factor() {
    std::fill_n(H_.valuePtr(), H_.nonZeros(), 0.0);
    for (int j = 0; j < H_.cols(); ++j) H_.valuePtr()[H_.outerIndexPtr()[j]] = 1;  // the diagonal comes first
    for (std::size_t f = 0; f < factors_.size(); ++f) {
      if (slopes_[f].isZero(0)) continue;
      const Factor& factor = factors_[f];
      std::size_t k = 0;
      const auto put = [&](const auto& product) {
        for (Eigen::Index j = 0; j < product.cols(); ++j)
          for (Eigen::Index i = j; i < product.rows(); ++i) H_.valuePtr()[factor.place[k++]] += s_ * product(i, j);
      };
      if (!factor.round) {
        for (Eigen::Index j = 0; j < factor.rows.cols(); ++j)
          for (Eigen::Index i = j; i < factor.rows.cols(); ++i) H_.valuePtr()[factor.place[k++]] += s_ * factor.rows(0, i) * factor.rows(0, j);
      } else {
        put(DenseMatrix(factor.rows.transpose() * slopes_[f] * factor.rows));
      }
    }
    return cholesky_.front().factor(H_);
  }

  /// Of all x that fit b best without limits, the shortest: if it lies in the set, starts there and returns true (long steps may follow).
  /// Otherwise starts at the point of the set nearest to 0 and returns false.
  bool start_without_limits() {
    project(x_);
    const Vector nearest = value_;
    for (Small& slope : slopes_) slope.setIdentity();
    const bool solved = A_.rows() > 0 && factor();
    steps_ += solved;
    const Vector shortest = solved ? Vector(s_ * (A_ * cholesky_.front().solve(b_))) : nearest;
    project(shortest);
    const bool within = solved && value_ == shortest;
    x_ = within ? shortest : nearest;
    return within;
  }

  /// The better beginning of two: the last w, as where nothing balances b; or less by as much as s has grown, as where w is on its way to 0.
  void begin() {
    if (!(last_s_ > 0)) return;
    const Vector less = last_s_ / s_ * w_;
    if (at(less) < at(w_)) w_ = less;
  }

  /// w of a proximal step; value_ is then its x. False where that takes too long.
  bool newton() {
    double energy = at(w_), before = INFINITY;
    const double first = gradient_.norm();
    for (int step = 0; step < kMostNewton; ++step) {
      ask_to_stop();
      const double size = gradient_.norm();
      const double rounding = kRounding * (b_.norm() + w_.norm() + (lengths_.transpose() * (x_.cwiseAbs() + s_ * (lengths_ * w_.cwiseAbs()))).norm());
      const double residual = (w_ - gradient_).norm();
      if (size <= std::max(rounding, kSmall * residual) || residual <= enough_) return true;
      const bool small = size <= kNoise * residual;  // near enough where rounding leaves no more
      if (!factor()) return small;
      ++steps_;
      const Vector gradient = gradient_, from = w_;
      const Vector direction = -cholesky_.front().solve(gradient);
      const double descent = gradient.dot(direction);
      if (!(descent < 0) || !direction.allFinite()) return small;
      const bool last = size <= 1e-6 * first && size > 0.5 * before;  // rounding, which the bound above did not see
      before = size;
      if (last) return small;
      double length = 1;
      for (int halving = 0;; ++halving, length /= 2) {
        w_ = from + length * direction;
        const double next = at(w_);
        const bool equal = next <= energy + 1e-13 * (from.squaredNorm() + std::abs(b_.dot(from)) + x_.squaredNorm() / s_);
        if (next <= energy + 1e-4 * length * descent || (equal && gradient_.norm() <= 0.5 * size)) {
          energy = next;
          break;
        }
        if (halving == kMostHalvings) {  // nothing but rounding is left to gain
          w_ = from;
          at(w_);
          return small;
        }
      }
    }
    return false;
  }

  const SparseRows& A_;
  const SparseRows lengths_;  ///< |A|, entry by entry
  const Vector& b_;
  const ConvexSet& set_;
  double enough_, s_ = 1, last_s_ = 0, grows_ = kGrows;
  Vector x_, w_, value_, gradient_, residual_;
  std::vector<Factor> factors_;
  std::vector<Small> slopes_;
  SparseMatrix H_;
  std::vector<Cholesky> cholesky_;
  int steps_ = 0;
};

}  // namespace

ConeLeastSquares cone_least_squares(const SparseRows& A, const Vector& b, const ConvexSet& set, double enough) {
  return Minimisation(A, b, set, enough).run();
}

}  // namespace dotyk::algebra
