#include "multigrid/sweeps.hpp"

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

/// to += factor × a matrix of n rows times x; entry(r, c): its numbers.
template <class Entry>
void add_product(int n, const Entry& entry, double factor, const double* x, double* to) {
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) to[r] += factor * entry(r, c) * x[c];
}

}  // namespace

auto Sweeps::inverse_of(int node) const {
  const int n = A_.block();
  return [of = inverse_.data() + static_cast<std::size_t>(node) * n * n, n](int r, int c) { return of[r * n + c]; };
}

void Sweeps::sweep_border_forward(double* x, double* left) {
  if (A_.ranks().alone()) return;
  const int n = A_.block();
  for (const int node : A_.border()) {
    double* change = work_.data() + static_cast<std::size_t>(node) * n;
    std::fill_n(change, n, 0.0);
    add_product(n, inverse_of(node), 1, left + static_cast<std::size_t>(node) * n, change);
    for (int r = 0; r < n; ++r) x[static_cast<std::size_t>(node) * n + r] += change[r];
    A_.each_block(node, [&](int other, const double* block, HalfMatrix::Read read) {  // the block of row `other` and column `node` is its transpose
      const auto transposed = [&](int r, int c) { return A_.entry(block, read, c, r); };
      if (other < A_.nodes()) add_product(n, transposed, -1, change, left + static_cast<std::size_t>(other) * n);
    });
  }
  A_.times_others(work_.data(), [&](int row, double number) { left[row] -= number; });
}

void Sweeps::sweep_border_backward(const double* b, double* x) {
  if (A_.ranks().alone()) return;
  const int n = A_.block();
  A_.times_others(x, [&](int row, double number) { work_[row] = number; });
  double left[kMostRows];
  for (std::size_t k = A_.border().size(); k-- > 0;) {
    const int node = A_.border()[k];
    const std::size_t first = static_cast<std::size_t>(node) * n;
    for (int r = 0; r < n; ++r) left[r] = b[first + r] - work_[first + r];
    A_.each_block(node, [&](int other, const double* block, HalfMatrix::Read read) {
      const auto numbers = [&](int r, int c) { return A_.entry(block, read, r, c); };
      if (other < A_.nodes()) add_product(n, numbers, -1, x + static_cast<std::size_t>(other) * n, left);
    });
    add_product(n, inverse_of(node), 1, left, x + first);
  }
}

}  // namespace dotyk::multigrid
