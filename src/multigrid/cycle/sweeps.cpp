#include "multigrid/cycle/sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace dotyk::multigrid {

void Sweeps::set(const std::vector<char>& changed, const std::vector<int>& solved) {
  double greatest = 0;
  for (int row = 0; row < A_.rows(); ++row) greatest = std::max(greatest, A_.diagonal(row));
  const double unit = std::exp2(std::ilogb(greatest > 0 && std::isfinite(greatest) ? greatest : 1));
  const bool all = std::exchange(unit_, unit) != unit;
  const auto is_due = [&](int node) { return all || std::any_of(changed.begin() + node * A_.block(), changed.begin() + (node + 1) * A_.block(), std::identity()); };
  for (int node = 0; node < A_.nodes(); ++node)
    if (is_due(node)) take(node);
  // The damping depends on the borders of all ranks: all compute it anew, or none. At border nodes take() has left blocks without it.
  if (A_.ranks().all(solved == solved_ && std::ranges::none_of(A_.border(), is_due))) return;
  solved_ = solved;
  const std::vector<NodeBlock> damped = damped_blocks(A_, solved);
  for (std::size_t k = 0; k < damped.size(); ++k) invert(A_.block(), damped[k].data(), inverse_.data() + static_cast<std::ptrdiff_t>(A_.border()[k]) * A_.block() * A_.block());
  take_border();
}

void Sweeps::take(int node) {
  const HalfBlocks<double> of = A_.half();
  const std::ptrdiff_t square = of.size * of.size;
  for (std::ptrdiff_t k = of.starts[node] * square; k < of.starts[node + 1] * square; ++k) below_[k] = static_cast<float>(of.below[k] / unit_);
  invert(of.size, of.diagonal + node * square, inverse_.data() + node * square);
}

HalfBlocks<float> Sweeps::half() const {
  const HalfBlocks<double> of = A_.half();
  return {of.size, of.starts, of.columns, below_.data(), unit_, of.diagonal};
}

HalfBlocks<float> Sweeps::border() const { return {A_.block(), border_.starts, border_.columns.data(), border_.values.data(), unit_, A_.half().diagonal}; }

void Sweeps::forward(const double* b, double* x, double* left) {
  auto& [solution, residual] = A_.room();
  residual.take(b);
  sweep_forward(half(), inverse_.data(), solution, residual);
  take_off(residual, solution);
  if (moved_) {
    sweep_forward(border(), A_.border(), inverse_.data(), solution, residual, *moved_);
    take_off(residual, *moved_);
  }
  solution.give(x);
  residual.give(left);
}

void Sweeps::backward(const double* b, double* x) {
  auto& [solution, residual] = A_.room();
  residual.take(b);
  solution.take(x);
  if (moved_) {
    PaddedVector& beyond = *moved_;
    A_.times_others(solution, [&](int node, const double* numbers) { std::copy_n(numbers, A_.block(), beyond.of(node)); });
    sweep_backward(border(), A_.border(), inverse_.data(), residual, beyond, solution);
  }
  take_off(residual, solution);
  sweep_backward(half(), inverse_.data(), residual, solution);
  solution.give(x);
}

void Sweeps::take_off(PaddedVector& residual, const PaddedVector& x) {
  A_.times_others(x, [&](int node, const double* numbers) {
    double* own = residual.of(node);
    for (int r = 0; r < A_.block(); ++r) own[r] -= numbers[r];
  });
}

void Sweeps::take_border() {
  const int n = A_.block();
  border_.starts.assign(1, 0), border_.columns.clear(), border_.values.clear();  // their room is kept
  for (const int node : A_.border()) {
    A_.each_block(node, [&](int other, const double* block, HalfMatrix::Read read) {
      if (other >= A_.nodes() || other == node) return;
      border_.columns.push_back(other);
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) border_.values.push_back(static_cast<float>(A_.entry(block, read, r, c) / unit_));
    });
    border_.starts.push_back(counted(border_.columns.size()));
  }
  border_.values.resize(border_.values.size() + kSpare);
}

}  // namespace dotyk::multigrid
