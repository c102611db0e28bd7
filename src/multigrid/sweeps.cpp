#include "multigrid/sweeps.hpp"

#include <cmath>

namespace dotyk::multigrid {

void Sweeps::set(double omega) {
  double greatest = 0;
  for (int row = 0; row < A_.rows(); ++row) greatest = std::max(greatest, A_.diagonal(row));
  scale_ = std::exp2(-std::ilogb(greatest > 0 && std::isfinite(greatest) ? greatest : 1));
  const HalfBlocks<double> of = A_.half();
  const std::size_t square = static_cast<std::size_t>(of.size) * of.size, blocks = static_cast<std::size_t>(of.starts.back());
  const auto rough = [&](const double* numbers, std::size_t count, std::vector<float>& to) {
    to.resize(count);
    for (std::size_t k = 0; k < count; ++k) to[k] = static_cast<float>(scale_ * numbers[k]);
  };
  rough(of.below, blocks * square + kSpare, below_);
  rough(of.diagonal, static_cast<std::size_t>(of.nodes()) * square, diagonal_);
  inverse_.resize(static_cast<std::size_t>(A_.rows()));
  for (int row = 0; row < A_.rows(); ++row) inverse_[row] = static_cast<float>(omega / (scale_ * A_.diagonal(row)));
}

HalfBlocks<float> Sweeps::half() const {
  const HalfBlocks<double> of = A_.half();
  return {of.size, of.starts, of.columns, below_.data(), diagonal_.data()};
}

void Sweeps::forward(const double* b, double* x, double* left) {
  auto& [own, remaining] = A_.room();
  remaining.take(b, scale_);
  sweep_forward(half(), inverse_.data(), own, remaining);
  own.give(x);
  remaining.give(left, 1 / scale_);
  A_.times_others(x, [&](int row, double number) { left[row] -= number; });
}

void Sweeps::backward(const double* b, double* x) {
  auto& [own, remaining] = A_.room();
  remaining.take(b, scale_);
  own.take(x);
  A_.times_others(x, [&](int row, double number) { remaining[row] -= scale_ * number; });
  sweep_backward(half(), inverse_.data(), remaining, own);
  own.give(x);
}

}  // namespace dotyk::multigrid
