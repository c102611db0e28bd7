#include "multigrid/sweeps.hpp"

#include <Eigen/Dense>
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
  const auto invert = [&]<int size>() {
    using Block = Eigen::Matrix<double, size, size, Eigen::RowMajor>;
    for (std::size_t at = 0; at < inverse_.size(); at += square) {
      const Block D = Eigen::Map<const Block>(of.diagonal + at, of.size, of.size);
      Block inverse = D.diagonal().cwiseInverse().asDiagonal();
      if (const Eigen::LLT<Block> factor(D); factor.info() == Eigen::Success) inverse = factor.solve(Block::Identity(of.size, of.size));
      Eigen::Map<Block>(inverse_.data() + at, of.size, of.size) = omega / 2 * (inverse + inverse.transpose());
    }
  };
  if (of.size == 3) invert.operator()<3>();
  else invert.operator()<Eigen::Dynamic>();
}

HalfBlocks<float> Sweeps::half() const {
  const HalfBlocks<double> of = A_.half();
  return {of.size, of.starts, of.columns, below_.data(), unit_, of.diagonal};
}

void Sweeps::forward(const double* b, double* x, double* left) {
  auto& [own, remaining] = A_.room();
  remaining.take(b);
  sweep_forward(half(), inverse_.data(), own, remaining);
  own.give(x);
  remaining.give(left);
  A_.times_others(x, [&](int row, double number) { left[row] -= number; });
}

void Sweeps::backward(const double* b, double* x) {
  auto& [own, remaining] = A_.room();
  remaining.take(b);
  own.take(x);
  A_.times_others(x, [&](int row, double number) { remaining[row] -= number; });
  sweep_backward(half(), inverse_.data(), remaining, own);
  own.give(x);
}

}  // namespace dotyk::multigrid
