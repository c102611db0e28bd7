#include "multigrid/cycle/sweeps.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace dotyk::multigrid {

namespace {

/// The matrix G⁻¹ A_between G⁻ᵀ, where D = G Gᵀ, on the nodes of this rank that are coupled to others. Rows and columns left out are zero.
class Between {
 public:
  Between(HalfMatrix& A, const std::vector<int>& left_out) : A_(A), all_(static_cast<std::size_t>(A.rows()), 0.0), product_(all_) {
    const int n = A.block();
    for (const int node : A.border()) {
      Block D = Eigen::Map<const Block>(A.half().diagonal + static_cast<std::ptrdiff_t>(node) * n * n, n, n);
      Eigen::VectorXd kept = Eigen::VectorXd::Ones(n);
      for (int r = 0; r < n; ++r)
        if (std::ranges::binary_search(left_out, node * n + r)) kept[r] = 0, D.row(r).setZero(), D.col(r).setZero(), D(r, r) = 1;
      Eigen::LLT<Block> factor(D);
      if (factor.info() != Eigen::Success) factor.compute((n * D.diagonal().cwiseAbs()).asDiagonal());  // as in invert()
      factors_.push_back(std::move(factor)), kept_.push_back(std::move(kept));
    }
  }

  std::size_t count() const { return factors_.size() * static_cast<std::size_t>(A_.block()); }

  /// Collective.
  std::vector<double> times(const std::vector<double>& v) {
    std::vector<double> product(v.size());
    each_node([&](std::size_t k, double* all, double*) { of(all) = kept_[k].cwiseProduct(factors_[k].matrixU().solve(of(v.data() + k * A_.block()))); });
    A_.times_others(all_.data(), [&](int node, const double* numbers) { std::copy_n(numbers, A_.block(), product_.begin() + node * A_.block()); });
    each_node([&](std::size_t k, double*, double* own) { of(product.data() + k * A_.block()) = factors_[k].matrixL().solve(kept_[k].cwiseProduct(of(own))); });
    return product;
  }

 private:
  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMostRows, kMostRows>;

  Eigen::Map<Eigen::VectorXd> of(double* numbers) const { return {numbers, A_.block()}; }
  Eigen::Map<const Eigen::VectorXd> of(const double* numbers) const { return {numbers, A_.block()}; }
  template <class Work>
  void each_node(const Work& work) {
    for (std::size_t k = 0; k < factors_.size(); ++k) {
      const auto first = static_cast<std::size_t>(A_.border()[k]) * A_.block();
      work(k, all_.data() + first, product_.data() + first);
    }
  }

  HalfMatrix& A_;
  std::vector<Eigen::LLT<Block>> factors_;  // of nodes of the border
  std::vector<Eigen::VectorXd> kept_;       // 1, or 0 where a row is left out
  std::vector<double> all_, product_;       // by own rows
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
