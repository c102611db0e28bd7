#include "multigrid/half_matrix.hpp"

#include <numeric>
#include <utility>

namespace dotyk::multigrid {

HalfMatrix::HalfMatrix(const Ranks& ranks, int block, const Rows& nodes)
    : ranks_(ranks), block_(block), starts_(1, 0), other_starts_(1, 0), room_{{block, static_cast<int>(nodes.starts.size()) - 1}, {block, static_cast<int>(nodes.starts.size()) - 1}} {
  const int own = static_cast<int>(nodes.starts.size()) - 1;
  first_ = ranks.before(own);
  for (const int node : nodes.columns)
    if (node < first_ || node >= first_ + own) others_.push_back(node);
  std::ranges::sort(others_);
  others_.erase(std::ranges::unique(others_).begin(), others_.end());
  for (int i = 0; i < own; ++i) {
    for (int k = nodes.starts[i]; k < nodes.starts[i + 1]; ++k) {
      const int node = nodes.columns[k], local = node - first_;
      if (local >= 0 && local < i) columns_.push_back(local);
      else if (local < 0 || local >= own) other_columns_.push_back(static_cast<int>(std::ranges::lower_bound(others_, node) - others_.begin()));
    }
    starts_.push_back(static_cast<int>(columns_.size()));
    if (static_cast<int>(other_columns_.size()) > other_starts_.back()) border_.push_back(i);
    other_starts_.push_back(static_cast<int>(other_columns_.size()));
  }
  const auto each = [&](auto&& visit) {
    for (int i = 0; i < own; ++i)
      for (int k = starts_[i]; k < starts_[i + 1]; ++k) visit(columns_[k], i, k);
  };
  above_ = Buckets(own, [&](auto&& put) { each([&](int column, int i, int) { put(column, i); }); });
  above_places_ = Buckets(own, [&](auto&& put) { each([&](int column, int, int k) { put(column, k); }); });
  const std::size_t square = static_cast<std::size_t>(block) * block;
  below_.assign(columns_.size() * square + kSpare, 0.0), diagonal_.assign(own * square, 0.0), other_.assign(other_columns_.size() * square, 0.0);
  theirs_.assign(others_.size() * block, 0.0);
  if (ranks.alone()) return;
  std::vector<int> firsts = ranks.gather(first_);
  std::vector<std::vector<int>> needed(static_cast<std::size_t>(ranks.count()));
  for (const int node : others_) needed[std::ranges::upper_bound(firsts, node) - firsts.begin() - 1].push_back(node);
  for (const auto& of_rank : needed) other_counts_.push_back(static_cast<int>(of_rank.size()) * block);
  asked_ = ranks.exchange(needed);
  for (auto& of_rank : asked_)
    for (int& node : of_rank) node -= first_;
}

double* HalfMatrix::find(int row, int column) {
  const int a = row / block_, r = row % block_, node = column / block_, c = column % block_, b = node - first_;
  const std::size_t square = static_cast<std::size_t>(block_) * block_;
  const auto in = [&](const std::vector<int>& columns, const std::vector<int>& starts, int i, int j, std::vector<double>& numbers, int place) -> double* {
    const auto begin = columns.begin() + starts[i], end = columns.begin() + starts[i + 1], at = std::lower_bound(begin, end, j);
    return at == end || *at != j ? nullptr : numbers.data() + static_cast<std::size_t>(at - columns.begin()) * square + place;
  };
  const int place = r * block_ + c, across = c * block_ + r;
  if (b == a) return diagonal_.data() + static_cast<std::size_t>(a) * square + place;
  if (b >= 0 && b < nodes()) return b < a ? in(columns_, starts_, a, b, below_, place) : in(columns_, starts_, b, a, below_, across);
  const auto at = std::ranges::lower_bound(others_, node);
  return at == others_.end() || *at != node ? nullptr : in(other_columns_, other_starts_, a, static_cast<int>(at - others_.begin()), other_, place);
}

void HalfMatrix::fetch(const double* x) {
  std::vector<std::vector<double>> to(asked_.size());
  for (std::size_t rank = 0; rank < asked_.size(); ++rank)
    for (const int node : asked_[rank]) to[rank].insert(to[rank].end(), x + static_cast<std::size_t>(node) * block_, x + static_cast<std::size_t>(node + 1) * block_);
  ranks_.exchange(to, other_counts_, theirs_);
}

void HalfMatrix::times(const double* x, double* y) {
  room_.x.take(x);
  multiply(half(), room_.x, room_.y);
  room_.y.give(y);
  times_others(x, [&](int row, double number) { y[row] += number; });
}

std::vector<int> HalfMatrix::border_rows() const {
  std::vector<int> rows;
  for (const int node : border_)
    for (int r = 0; r < block_; ++r) rows.push_back(node * block_ + r);
  return rows;
}

Rows HalfMatrix::full(const std::vector<int>& rows) const {
  struct Part {
    int column;  // node
    const double* block;
    Read read;
  };
  Rows out;
  std::vector<Part> parts;
  for (int before = -1; const int row : rows) {
    const int node = row / block_, r = row % block_;
    if (std::exchange(before, node) != node) {
      parts.clear();
      each_block(node, [&](int other, const double* block, Read read) { parts.push_back({number(other), block, read}); });
      std::ranges::sort(parts, {}, &Part::column);
    }
    for (const auto& [column, block, read] : parts)
      for (int c = 0; c < block_; ++c) {
        out.columns.push_back(column * block_ + c);
        out.values.push_back(block[read == Read::transposed ? c * block_ + r : r * block_ + c]);
      }
    out.starts.push_back(static_cast<int>(out.columns.size()));
  }
  return out;
}

Rows HalfMatrix::full() const {
  std::vector<int> all(static_cast<std::size_t>(rows()));
  std::iota(all.begin(), all.end(), 0);
  return full(all);
}

double HalfMatrix::bytes() const {
  return 8.0 * static_cast<double>(below_.size() + diagonal_.size() + other_.size()) + 4.0 * static_cast<double>(starts_.size() + columns_.size() + other_columns_.size()) +
         static_cast<double>(above_.bytes() + above_places_.bytes()) + room_.x.bytes() + room_.y.bytes();
}

}  // namespace dotyk::multigrid
