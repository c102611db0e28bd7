#include "multigrid/sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace dotyk::multigrid {

namespace {

/// The matrix D^−1/2 A_between D^−1/2. Only this rank's border rows are stored: those with entries in columns of other ranks, except the rows left out.
/// All other rows are zero.
class Between {
 public:
  Between(HalfMatrix& A, const std::vector<int>& left_out) : A_(A), all_(static_cast<std::size_t>(A.rows()), 0.0), product_(all_) {
    for (const int row : A.border_rows())
      if (!std::ranges::binary_search(left_out, row)) border_.push_back(row), scale_.push_back(1 / std::sqrt(std::abs(A.diagonal(row))));
  }

  std::size_t count() const { return border_.size(); }

  /// Collective.
  std::vector<double> times(const std::vector<double>& v) {
    for (std::size_t k = 0; k < count(); ++k) all_[border_[k]] = scale_[k] * v[k];
    A_.times_others(all_.data(), [&](int row, double number) { product_[row] = number; });
    std::vector<double> product;
    for (std::size_t k = 0; k < count(); ++k) product.push_back(scale_[k] * product_[border_[k]]);
    return product;
  }

 private:
  HalfMatrix& A_;
  std::vector<int> border_;
  std::vector<double> scale_, all_, product_;  // the last two: by own rows
};

/// The greatest eigenvalue of a symmetric tridiagonal matrix T, or 0 if that is negative. By bisection: T − x has only negative pivots exactly if x is
/// greater than all eigenvalues.
double greatest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  double bound = 0;
  for (const auto* entries : {&diagonal, &beside})
    for (const double entry : *entries) bound = std::max(bound, 3 * std::abs(entry));
  double high = bound;
  for (double low = 0; high - low > 1e-4 * bound;) {
    const double x = (low + high) / 2;
    double pivot = diagonal[0] - x;
    bool above = pivot < 0;
    for (std::size_t k = 1; above && k < diagonal.size(); ++k) above = (pivot = diagonal[k] - x - beside[k - 1] * beside[k - 1] / pivot) < 0;
    (above ? high : low) = x;
  }
  return high;
}

}  // namespace

double damping(HalfMatrix& A, const std::vector<int>& solved) {
  constexpr int kSteps = 12;        // of Lanczos, from numbers at random: within 1 % on all levels tried
  constexpr double kAbove = 1.03;
  const Ranks& ranks = A.ranks();
  if (ranks.alone()) return 1;
  Between between(A, solved);
  const auto dot = [&](const std::vector<double>& a, const std::vector<double>& b) { return ranks.sum(std::inner_product(a.begin(), a.end(), b.begin(), 0.0)); };
  const auto add = [](std::vector<double>& to, double factor, const std::vector<double>& v) {
    for (std::size_t k = 0; k < to.size(); ++k) to[k] += factor * v[k];
  };
  const auto normalise = [&](std::vector<double>& v) {
    const double size = std::sqrt(dot(v, v));
    for (double& number : v) number /= size > 0 ? size : 1;
    return size;
  };
  std::minstd_rand numbers(1);
  std::vector<double> v(between.count()), before(v.size()), diagonal, beside;
  for (double& number : v) number = std::uniform_real_distribution<>(0, 1)(numbers);
  normalise(v);
  for (int k = 0; k < kSteps; ++k) {
    std::vector<double> w = between.times(v);
    diagonal.push_back(dot(w, v));
    add(w, -diagonal.back(), v);
    if (k > 0) add(w, -beside.back(), before);
    before = std::exchange(v, std::move(w));
    const double size = normalise(v);
    if (size == 0) break;
    beside.push_back(size);
  }
  return std::min(1.0, 2 / (1 + kAbove * greatest_eigenvalue(diagonal, beside)));
}

}  // namespace dotyk::multigrid
