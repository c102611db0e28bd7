#include "multigrid/cycle/sweeps.hpp"

#include <cmath>

namespace dotyk::multigrid {

void Sweeps::set(double omega) {
  double greatest = 0;
  for (int row = 0; row < A_.rows(); ++row) greatest = std::max(greatest, A_.diagonal(row));
  unit_ = std::exp2(std::ilogb(greatest > 0 && std::isfinite(greatest) ? greatest : 1));
  const HalfBlocks<double> of = A_.half();
  const std::size_t square = static_cast<std::size_t>(of.size) * of.size, count = static_cast<std::size_t>(of.starts.back()) * square;
  below_.resize(count + kSpare);
  for (std::size_t k = 0; k < count; ++k) below_[k] = static_cast<float>(of.below[k] / unit_);
  inverse_.resize(static_cast<std::size_t>(of.nodes()) * square);
  for (std::size_t at = 0; at < inverse_.size(); at += square) invert(of.size, of.diagonal + at, inverse_.data() + at);
  for (const int node : A_.border())
    for (std::size_t k = 0; k < square; ++k) inverse_[node * square + k] *= omega;
  take_border();
}

HalfBlocks<float> Sweeps::half() const {
  const HalfBlocks<double> of = A_.half();
  return {of.size, of.starts, of.columns, below_.data(), unit_, of.diagonal};
}

void Sweeps::forward(const double* b, double* x, double* left) {
  auto& [solution, residual] = A_.room();
  residual.take(b);
  sweep_forward(half(), inverse_.data(), solution, residual);
  solution.give(x);
  residual.give(left);
  A_.times_others(x, [&](int row, double number) { left[row] -= number; });
  sweep_border_forward(x, left);
}

void Sweeps::backward(const double* b, double* x) {
  sweep_border_backward(b, x);
  auto& [solution, residual] = A_.room();
  residual.take(b);
  solution.take(x);
  A_.times_others(x, [&](int row, double number) { residual[row] -= number; });
  sweep_backward(half(), inverse_.data(), residual, solution);
  solution.give(x);
}

namespace {

/// to += factor A x, A an n × n matrix, row by row, or its transpose.
void add_product(int n, double factor, const double* A, const double* x, double* to) {
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) to[r] += factor * A[r * n + c] * x[c];
}
void add_transposed(int n, double factor, const double* A, const double* x, double* to) {
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) to[c] += factor * A[r * n + c] * x[r];
}

}  // namespace

void Sweeps::take_border() {
  const int n = A_.block();
  border_.starts.assign(1, 0), border_.columns.clear(), border_.values.clear();  // their room is kept
  for (const int node : A_.border()) {
    A_.each_block(node, [&](int other, const double* block, HalfMatrix::Read read) {
      if (other >= A_.nodes()) return;
      border_.columns.push_back(other);
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) border_.values.push_back(A_.entry(block, read, r, c));
    });
    border_.starts.push_back(static_cast<int>(border_.columns.size()));
  }
}

void Sweeps::sweep_border_forward(double* x, double* left) {
  if (A_.ranks().alone()) return;
  const int n = A_.block();
  const std::size_t square = static_cast<std::size_t>(n) * n;
  for (std::size_t k = 0; k < A_.border().size(); ++k) {
    const std::size_t first = static_cast<std::size_t>(A_.border()[k]) * n;
    double* change = work_.data() + first;
    std::fill_n(change, n, 0.0);
    add_product(n, 1, inverse_.data() + first * n, left + first, change);
    for (int r = 0; r < n; ++r) x[first + r] += change[r];
    for (int e = border_.starts[k]; e < border_.starts[k + 1]; ++e)  // the block of row `other` and column `node` is the transpose
      add_transposed(n, -1, border_.values.data() + e * square, change, left + static_cast<std::size_t>(border_.columns[e]) * n);
  }
  A_.times_others(work_.data(), [&](int row, double number) { left[row] -= number; });
}

void Sweeps::sweep_border_backward(const double* b, double* x) {
  if (A_.ranks().alone()) return;
  const int n = A_.block();
  const std::size_t square = static_cast<std::size_t>(n) * n;
  A_.times_others(x, [&](int row, double number) { work_[row] = number; });
  double left[kMostRows];
  for (std::size_t k = A_.border().size(); k-- > 0;) {
    const std::size_t first = static_cast<std::size_t>(A_.border()[k]) * n;
    for (int r = 0; r < n; ++r) left[r] = b[first + r] - work_[first + r];
    for (int e = border_.starts[k]; e < border_.starts[k + 1]; ++e)
      add_product(n, -1, border_.values.data() + e * square, x + static_cast<std::size_t>(border_.columns[e]) * n, left);
    add_product(n, 1, inverse_.data() + first * n, left, x + first);
  }
}

}  // namespace dotyk::multigrid
