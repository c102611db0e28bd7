#include "algebra/dense/bounded_least_squares.hpp"

#include <Eigen/Householder>
#include <Eigen/Jacobi>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace dotyk::algebra {
namespace {

enum class Place { low, high, free };

/// A column is linearly dependent on others if less than this part of it lies outside their span.
constexpr double kDependent = 1e-10;

/// The QR factorisation of some columns of A, updated when a column is added or removed (Golub and Van Loan 2013 §6.5).
class Columns {
 public:
  explicit Columns(const DenseMatrix& A) : A_(A), Q_(DenseMatrix::Identity(A.rows(), A.rows())), R_(A.rows(), 0), norm_(A.colwise().norm()) {}

  const std::vector<int>& all() const { return columns_; }
  double norm(int column) const { return norm_[column]; }

  /// False, and nothing is added, if the column is linearly dependent on those that are there.
  bool add(int column) {
    const Eigen::Index k = static_cast<Eigen::Index>(columns_.size()), left = A_.rows() - k;
    if (left == 0) return false;
    Vector v = Q_.transpose() * A_.col(column);
    if (!(v.tail(left).norm() > kDependent * norm_[column])) return false;
    Vector essential(left - 1), work(A_.rows());
    double tau, length;
    v.tail(left).makeHouseholder(essential, tau, length);
    Q_.rightCols(left).applyHouseholderOnTheRight(essential, tau, work.data());
    v[k] = length;
    v.tail(left - 1).setZero();
    if (R_.cols() == k) R_.conservativeResize(Eigen::NoChange, std::min(A_.rows(), 2 * k + 8));
    R_.col(k) = v;
    columns_.push_back(column);
    return true;
  }

  void remove(Eigen::Index place) {
    const Eigen::Index k = static_cast<Eigen::Index>(columns_.size());
    for (Eigen::Index i = place; i + 1 < k; ++i) {
      R_.col(i) = R_.col(i + 1);
      Eigen::JacobiRotation<double> turn;
      double length;
      turn.makeGivens(R_(i, i), R_(i + 1, i), &length);
      R_(i, i) = length, R_(i + 1, i) = 0;
      for (Eigen::Index j = i + 2; j < k; ++j) {
        const double above = R_(i, j), below = R_(i + 1, j);
        R_(i, j) = turn.c() * above - turn.s() * below;
        R_(i + 1, j) = turn.s() * above + turn.c() * below;
      }
      Q_.applyOnTheRight(i, i + 1, turn);
    }
    columns_.erase(columns_.begin() + place);
  }

  /// v without its projection on the columns.
  Vector beyond(const Vector& v) const {
    const auto Q = Q_.leftCols(static_cast<Eigen::Index>(columns_.size()));
    return v - Q * (Q.transpose() * v);
  }

  /// The coefficients of the columns in the least-squares approximation of v.
  Vector fit(const Vector& v) const {
    const Eigen::Index k = static_cast<Eigen::Index>(columns_.size());
    return R_.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(Q_.leftCols(k).transpose() * v);
  }

 private:
  const DenseMatrix& A_;
  DenseMatrix Q_, R_;
  const Vector norm_;
  std::vector<int> columns_;
};

class Iteration {
 public:
  Iteration(const DenseMatrix& A, const Vector& b, const Vector& low, const Vector& high, double tolerance, const Vector& start)
      : A_(A), b_(b), low_(low), high_(high), tolerance_(tolerance), x_(A.cols()), place_(A.cols()), idle_(A.cols(), 0), columns_(A) {
    for (int j = 0; j < A.cols(); ++j) {
      // At the bound that is nearest to 0, free about 0: what far bounds cancel would leave rounding of their size.
      place_[j] = low[j] >= 0 ? Place::low : high[j] <= 0 ? Place::high : Place::free;
      x_[j] = place_[j] == Place::low ? low[j] : place_[j] == Place::high ? high[j] : 0;
      if (start.size() == 0) continue;
      place_[j] = start[j] <= low[j] ? Place::low : start[j] >= high[j] ? Place::high : Place::free;
      x_[j] = std::clamp(start[j], low[j], high[j]);
    }
  }

  BoundedLeastSquares run() {
    for (int j = 0; j < A_.cols(); ++j)
      if (place_[j] == Place::free) columns_.add(j);
    settle();
    Vector residual = b_ - A_ * x_;
    for (int steps = 0; steps <= 20 * A_.cols() + 100; ++steps) {
      const int entering = choose(residual);
      if (entering < 0) return {x_, columns_.beyond(residual), steps};
      place_[entering] = Place::free;
      columns_.add(entering);
      settle();
      const Vector next = b_ - A_ * x_;
      // Releasing a variable that rounding (or a column nearly parallel to a free one) made attractive
      // changes next to nothing: not again before another one has.
      const double nothing = std::max(1e-9 * residual.norm(), std::numeric_limits<double>::epsilon() * b_.norm());
      if (next.norm() < residual.norm() - nothing)
        std::fill(idle_.begin(), idle_.end(), 0);
      else
        idle_[entering] = 1;
      residual = next;
    }
    throw std::runtime_error("bounded least squares: no end within 20 steps a column");
  }

 private:
  /// The bound variable whose release decreases the residual most, by the angle.
  int choose(const Vector& residual) const {
    const double size = residual.norm();
    if (!(size > tolerance_ * b_.norm())) return -1;
    const Vector along = A_.transpose() * residual;
    int best = -1;
    double most = tolerance_;
    for (int j = 0; j < A_.cols(); ++j) {
      if (place_[j] == Place::free || columns_.norm(j) == 0) continue;
      double slope = along[j] / (columns_.norm(j) * size);
      if (place_[j] == Place::high) slope = -slope;
      if (slope > most && !idle_[j]) most = slope, best = j;
    }
    return best;
  }

  /// Least squares over the free variables; those that would leave their bounds stop there.
  void settle() {
    while (!columns_.all().empty()) {
      const std::vector<int>& free = columns_.all();
      const Vector step = columns_.fit(b_ - A_ * x_);
      double length = 1;
      Eigen::Index blocking = -1;
      for (Eigen::Index k = 0; k < step.size(); ++k) {
        const int j = free[k];
        const double room = step[k] > 0 ? high_[j] - x_[j] : low_[j] - x_[j];
        if (std::abs(step[k]) * length > std::abs(room)) {
          length = std::abs(room / step[k]);
          blocking = k;
        }
      }
      for (Eigen::Index k = 0; k < step.size(); ++k) x_[free[k]] += length * step[k];
      if (blocking < 0) return;
      bind(blocking);
    }
  }

  /// The variable stops at its bound and its column leaves the factorisation. Free columns that depended on it may now be added.
  void bind(Eigen::Index blocking) {
    const int j = columns_.all()[blocking];
    const bool up = std::abs(high_[j] - x_[j]) < std::abs(x_[j] - low_[j]);
    place_[j] = up ? Place::high : Place::low;
    x_[j] = up ? high_[j] : low_[j];
    columns_.remove(blocking);
    const auto in = [&](int i) { return std::find(columns_.all().begin(), columns_.all().end(), i) != columns_.all().end(); };
    for (int i = 0; i < A_.cols(); ++i)
      if (place_[i] == Place::free && !in(i)) columns_.add(i);
  }

  const DenseMatrix& A_;
  const Vector &b_, &low_, &high_;
  double tolerance_;
  Vector x_;
  std::vector<Place> place_;
  std::vector<char> idle_;
  Columns columns_;  ///< of the free variables, without linearly dependent ones
};

}  // namespace

BoundedLeastSquares bounded_least_squares(const DenseMatrix& A, const Vector& b, const Vector& low,
                                          const Vector& high, double tolerance, const Vector& start) {
  return Iteration(A, b, low, high, tolerance, start).run();
}

}  // namespace dotyk::algebra
