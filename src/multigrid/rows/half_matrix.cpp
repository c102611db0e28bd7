#include "multigrid/rows/half_matrix.hpp"

#include <numeric>
#include <utility>

namespace dotyk::multigrid {

HalfRows::HalfRows(int block, int first, const Rows& nodes) : block(block), first(first) {
  const int count = static_cast<int>(nodes.starts.size()) - 1;
  for (int i = 0; i < count; ++i) {
    for (int k = nodes.starts[i]; k < nodes.starts[i + 1]; ++k) {
      const int local = nodes.columns[k] - first;
      if (local >= 0 && local < i) columns.push_back(local);
      else if (local < 0 || local >= count) others.push_back(nodes.columns[k]);
    }
    starts.push_back(counted(columns.size())), other_starts.push_back(counted(others.size()));
  }
  const std::size_t square = static_cast<std::size_t>(block) * block;
  below.assign(columns.size() * square + kSpare, 0.0), diagonal.assign(count * square, 0.0), other.assign(others.size() * square, 0.0);
}

HalfRows::Place HalfRows::place(int row, int column) {
  const std::size_t square = static_cast<std::size_t>(block) * block;
  const auto in = [&](const std::vector<int>& nodes, const std::vector<int>& begins, int i, int j, std::vector<double>& numbers) -> double* {
    const auto begin = nodes.begin() + begins[i], end = nodes.begin() + begins[i + 1], at = std::lower_bound(begin, end, j);
    return at == end || *at != j ? nullptr : numbers.data() + static_cast<std::size_t>(at - nodes.begin()) * square;
  };
  Place out{row, column, nullptr, !own(row) || (own(column) && column > row)};
  const int i = (out.transposed ? column : row) - first, j = out.transposed ? row : column;
  if (!own(i + first)) return out;
  if (row == column) out.numbers = diagonal.data() + static_cast<std::size_t>(i) * square;
  else if (own(j)) out.numbers = in(columns, starts, i, j - first, below);
  else out.numbers = in(others, other_starts, i, j, other);
  return out;
}

HalfRows widened(const HalfRows& rows, const std::vector<std::array<int, 2>>& pairs) {
  const int count = rows.nodes(), first = rows.first;
  const Buckets more(count, [&](auto&& put) {
    for (const auto& [a, b] : pairs) {
      if (rows.own(a)) put(a - first, b);
      if (rows.own(b)) put(b - first, a);
    }
  });
  Rows nodes;
  std::vector<int> row;
  for (int i = 0; i < count; ++i) {
    row.assign(more[i].begin(), more[i].end());
    for (int k = rows.starts[i]; k < rows.starts[i + 1]; ++k) row.push_back(first + rows.columns[k]);
    row.insert(row.end(), rows.others.begin() + rows.other_starts[i], rows.others.begin() + rows.other_starts[i + 1]);
    nodes.append_columns(row);
  }
  HalfRows wider(rows.block, first, nodes);
  nodes = {};
  const std::ptrdiff_t square = rows.block * rows.block;
  const auto copy = [&](const std::vector<int>& starts, const std::vector<int>& columns, const std::vector<double>& numbers, const std::vector<int>& to_starts,
                        const std::vector<int>& to_columns, std::vector<double>& to) {
    for (int i = 0; i < count; ++i)
      for (int k = starts[i], at = to_starts[i]; k < starts[i + 1]; ++k) {
        while (to_columns[at] != columns[k]) ++at;
        std::copy_n(numbers.begin() + k * square, square, to.begin() + at * square);
      }
  };
  wider.diagonal = rows.diagonal;
  copy(rows.starts, rows.columns, rows.below, wider.starts, wider.columns, wider.below);
  copy(rows.other_starts, rows.others, rows.other, wider.other_starts, wider.others, wider.other);
  return wider;
}

HalfMatrix::HalfMatrix(const Ranks& ranks, HalfRows rows)
    : ranks_(ranks), rows_(std::move(rows)), others_(rows_.others), room_{{block(), nodes()}, {block(), nodes()}} {
  std::ranges::sort(others_);
  others_.erase(std::ranges::unique(others_).begin(), others_.end());
  for (const int node : rows_.others) other_places_.push_back(static_cast<int>(std::ranges::lower_bound(others_, node) - others_.begin()));
  for (int i = 0; i < nodes(); ++i)
    if (rows_.other_starts[i] < rows_.other_starts[i + 1]) border_.push_back(i);
  const auto each = [&](auto&& visit) {
    for (int i = 0; i < nodes(); ++i)
      for (int k = rows_.starts[i]; k < rows_.starts[i + 1]; ++k) visit(rows_.columns[k], i, k);
  };
  above_ = Buckets(nodes(), [&](auto&& put) { each([&](int column, int i, int) { put(column, i); }); });
  above_places_ = Buckets(nodes(), [&](auto&& put) { each([&](int column, int, int k) { put(column, k); }); });
  theirs_.assign(others_.size() * block(), 0.0);
  if (ranks.alone()) return;
  const std::vector<int> firsts = ranks.gather(rows_.first);
  std::vector<std::vector<int>> needed(static_cast<std::size_t>(ranks.count()));
  for (const int node : others_) needed[rank_with(firsts, node)].push_back(node);
  for (const auto& of_rank : needed) other_counts_.push_back(counted(of_rank.size() * block()));
  asked_ = ranks.exchange(needed);
  for (auto& of_rank : asked_)
    for (int& node : of_rank) node -= rows_.first;
}

void HalfMatrix::take(const std::vector<double>& below, const std::vector<double>& diagonal, std::vector<char>& changed) {
  const std::ptrdiff_t square = block() * block();
  const auto flag = [&](int node) { std::fill_n(changed.begin() + node * block(), block(), char{1}); };
  for (int node = 0; node < nodes(); ++node) {
    if (!std::equal(diagonal.begin() + node * square, diagonal.begin() + (node + 1) * square, rows_.diagonal.begin() + node * square)) flag(node);
    for (int k = rows_.starts[node]; k < rows_.starts[node + 1]; ++k)
      if (!std::equal(below.begin() + k * square, below.begin() + (k + 1) * square, rows_.below.begin() + k * square)) flag(node), flag(rows_.columns[k]);
  }
  std::ranges::copy(below, rows_.below.begin());
  rows_.diagonal = diagonal;
}

double* HalfMatrix::find(int row, int column) {
  const int r = row % block(), c = column % block();
  const HalfRows::Place at = rows_.place(rows_.first + row / block(), column / block());
  return at.numbers ? &at.at(block(), r, c) : nullptr;
}

void HalfMatrix::fetch(const double* x, int width) {
  sent_.resize(asked_.size());
  for (std::size_t rank = 0; rank < asked_.size(); ++rank) {
    sent_[rank].clear();
    for (const int node : asked_[rank]) {
      const double* own = x + static_cast<std::size_t>(node) * width;
      sent_[rank].insert(sent_[rank].end(), own, own + block());
    }
  }
  ranks_.exchange(sent_, other_counts_, theirs_);
}

void HalfMatrix::times(const double* x, double* y) {
  room_.x.take(x);
  multiply(half(), room_.x, room_.y);
  room_.y.give(y);
  times_others(x, [&](int node, const double* numbers) {
    for (int r = 0; r < block(); ++r) y[node * block() + r] += numbers[r];
  });
}

Rows HalfMatrix::full(const std::vector<int>& rows) const {
  struct Part {
    int column;  // node
    const double* block;
    Read read;
  };
  const int n = block();
  std::size_t count = 0;
  for (const int row : rows) each_block(row / n, [&](auto&&...) { count += static_cast<std::size_t>(n); });
  Rows out;
  out.columns.reserve(count), out.values.reserve(count), out.starts.reserve(rows.size() + 1);
  std::vector<Part> parts;
  for (int before = -1; const int row : rows) {
    const int node = row / n, r = row % n;
    if (std::exchange(before, node) != node) {
      parts.clear();
      each_block(node, [&](int other, const double* block, Read read) { parts.push_back({number(other), block, read}); });
      std::ranges::sort(parts, {}, &Part::column);
    }
    for (const auto& [column, block, read] : parts)
      for (int c = 0; c < n; ++c) {
        out.columns.push_back(column * n + c);
        out.values.push_back(entry(block, read, r, c));
      }
    out.starts.push_back(counted(out.columns.size()));
  }
  return out;
}

Rows HalfMatrix::full() const {
  std::vector<int> all(static_cast<std::size_t>(rows()));
  std::iota(all.begin(), all.end(), 0);
  return full(all);
}

double HalfMatrix::bytes() const {
  return 8.0 * static_cast<double>(rows_.below.size() + rows_.diagonal.size() + rows_.other.size()) +
         4.0 * static_cast<double>(rows_.starts.size() + rows_.columns.size() + rows_.others.size() + other_places_.size()) +
         4.0 * static_cast<double>(others_.size() + border_.size()) + 8.0 * static_cast<double>(theirs_.size()) +
         static_cast<double>(above_.bytes() + above_places_.bytes()) + room_.x.bytes() + room_.y.bytes();
}

}  // namespace dotyk::multigrid
