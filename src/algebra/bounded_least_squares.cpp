#include "algebra/bounded_least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace dotyk::algebra {
namespace {

enum class Place { low, high, free };

class Iteration {
 public:
  Iteration(const DenseMatrix& A, const Vector& b, const Vector& low, const Vector& high, double tolerance, const Vector& start)
      : A_(A), b_(b), low_(low), high_(high), tolerance_(tolerance), x_(A.cols()), place_(A.cols()), idle_(A.cols(), 0) {
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
    settle();
    Vector residual = b_ - A_ * x_;
    for (int steps = 0; steps <= 20 * A_.cols() + 100; ++steps) {
      const int entering = choose(residual);
      if (entering < 0) return {x_, residual, steps};
      place_[entering] = Place::free;
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
    int best = -1;
    double most = tolerance_;
    for (int j = 0; j < A_.cols(); ++j) {
      if (place_[j] == Place::free) continue;
      const double norm = A_.col(j).norm();
      if (norm == 0) continue;
      double slope = A_.col(j).dot(residual) / (norm * size);
      if (place_[j] == Place::high) slope = -slope;
      if (slope > most && !idle_[j]) most = slope, best = j;
    }
    return best;
  }

  /// Least squares over the free variables; those that would leave their bounds stop there.
  void settle() {
    for (;;) {
      std::vector<int> free;
      for (int j = 0; j < A_.cols(); ++j)
        if (place_[j] == Place::free) free.push_back(j);
      if (free.empty()) return;
      DenseMatrix F(A_.rows(), static_cast<Eigen::Index>(free.size()));
      Vector rest = b_ - A_ * x_;
      for (std::size_t k = 0; k < free.size(); ++k) F.col(k) = A_.col(free[k]);
      Eigen::CompleteOrthogonalDecomposition<DenseMatrix> decomposition;
      decomposition.setThreshold(1e-10);  // rows of A that are zero but for rounding carry nothing
      const Vector step = decomposition.compute(F).solve(rest);
      double length = 1;
      int blocking = -1;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const int j = free[k];
        const double room = step[k] > 0 ? high_[j] - x_[j] : low_[j] - x_[j];
        if (std::abs(step[k]) * length > std::abs(room)) {
          length = std::abs(room / step[k]);
          blocking = j;
        }
      }
      for (std::size_t k = 0; k < free.size(); ++k) x_[free[k]] += length * step[k];
      if (blocking < 0) return;
      const bool up = std::abs(high_[blocking] - x_[blocking]) < std::abs(x_[blocking] - low_[blocking]);
      place_[blocking] = up ? Place::high : Place::low;
      x_[blocking] = up ? high_[blocking] : low_[blocking];
    }
  }

  const DenseMatrix& A_;
  const Vector &b_, &low_, &high_;
  double tolerance_;
  Vector x_;
  std::vector<Place> place_;
  std::vector<char> idle_;
};

}  // namespace

BoundedLeastSquares bounded_least_squares(const DenseMatrix& A, const Vector& b, const Vector& low,
                                          const Vector& high, double tolerance, const Vector& start) {
  return Iteration(A, b, low, high, tolerance, start).run();
}

}  // namespace dotyk::algebra
