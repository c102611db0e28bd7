// A rank's rows of a symmetric matrix.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/buckets.hpp"
#include "multigrid/kernels.hpp"
#include "multigrid/ranks.hpp"
#include "multigrid/rows.hpp"

namespace dotyk::multigrid {

/// The rows of this rank, in blocks of nodes: half of those in its own columns, with the diagonal, and all in columns of other ranks. Rows, columns and nodes are
/// counted over all ranks where nothing else is said; own nodes from the rank's first.
class HalfMatrix {
 public:
  /// Zeros. `nodes`: of each node of this rank the nodes that its rows couple it to; of own ones those before it suffice, and itself is not needed.
  /// Collective.
  HalfMatrix(const Ranks& ranks, int block, const Rows& nodes);
  /// Of entries of its lower triangle: each(visit) calls visit(row, column, number), once for each, at least for those with a row or a column of this rank.
  /// It is called several times. Collective.
  template <class Each>
  HalfMatrix(const Ranks& ranks, int block, int own_rows, const Each& each) : HalfMatrix(ranks, block, couplings(ranks, block, own_rows, each)) {
    each([&](int i, int j, double number) {
      if (has(i)) *find(i - first_row(), j) = number;
      if (has(j) && (!has(i) || i / block == j / block)) *find(j - first_row(), i) = number;
    });
  }

  const Ranks& ranks() const { return ranks_; }
  int block() const { return block_; }              ///< rows of a node
  int nodes() const { return static_cast<int>(starts_.size()) - 1; }  ///< own ones
  int rows() const { return nodes() * block_; }
  int first_row() const { return first_ * block_; }
  bool has(int row) const { return row >= first_row() && row < first_row() + rows(); }

  /// The number at a row, counted from the rank's first, and a column; null where the pattern has no such entry. One place has the entries (i, j) and
  /// (j, i) of own rows.
  double* find(int row, int column);
  double diagonal(int row) const { return diagonal_[static_cast<std::size_t>(row) * block_ + row % block_]; }
  double& diagonal(int row) { return diagonal_[static_cast<std::size_t>(row) * block_ + row % block_]; }

  /// How a block is to be read.
  enum class Read { as_it_is, transposed };
  /// Calls visit(node, block, read) for the blocks of an own node. `node`: an own one, or nodes() + its place in others().
  template <class Visit>
  void each_block(int node, const Visit& visit) const {
    const std::int64_t square = block_ * block_;
    for (int k = starts_[node]; k < starts_[node + 1]; ++k) visit(columns_[k], below_.data() + k * square, Read::as_it_is);
    visit(node, diagonal_.data() + node * square, Read::as_it_is);
    const auto above = above_[node], places = above_places_[node];
    for (std::size_t k = 0; k < above.size(); ++k) visit(above[k], below_.data() + places[k] * square, Read::transposed);
    for (int k = other_starts_[node]; k < other_starts_[node + 1]; ++k) visit(nodes() + other_columns_[k], other_.data() + k * square, Read::as_it_is);
  }
  /// The same, with numbers to be changed, of the blocks that are stored with the node: none is transposed.
  template <class Visit>
  void each_own_block(int node, const Visit& visit) {
    const std::int64_t square = block_ * block_;
    for (int k = starts_[node]; k < starts_[node + 1]; ++k) visit(columns_[k], below_.data() + k * square);
    visit(node, diagonal_.data() + node * square);
    for (int k = other_starts_[node]; k < other_starts_[node + 1]; ++k) visit(nodes() + other_columns_[k], other_.data() + k * square);
  }
  const std::vector<int>& others() const { return others_; }  ///< nodes of other ranks, ascending
  /// The number of an own node, or of one of other ranks, as each_block() counts.
  int number(int node) const { return node < nodes() ? first_ + node : others_[node - nodes()]; }

  /// Half of the rows in own columns.
  HalfBlocks<double> half() const { return {block_, starts_, columns_.data(), below_.data(), diagonal_.data()}; }

  /// Two vectors to work with: what multiplies and sweeps with this matrix needs.
  struct Room {
    PaddedVector x, y;
  };
  Room& room() { return room_; }

  /// y = A x for vectors of own rows. Collective.
  void times(const double* x, double* y);
  /// The same in columns of other ranks alone: calls add(row, number) for own rows where there are such. Collective.
  template <class Add>
  void times_others(const double* x, const Add& add) {
    if (ranks_.alone()) return;
    fetch(x);
    const std::int64_t square = block_ * block_;
    for (const int node : border_)
      for (int r = 0; r < block_; ++r) {
        double sum = 0;
        for (int k = other_starts_[node]; k < other_starts_[node + 1]; ++k)
          for (int c = 0; c < block_; ++c) sum += other_[k * square + r * block_ + c] * theirs_[static_cast<std::size_t>(other_columns_[k]) * block_ + c];
        add(node * block_ + r, sum);
      }
  }
  /// Own rows with entries in columns of other ranks, ascending, counted from the rank's first.
  std::vector<int> border_rows() const;

  /// Some of the own rows, counted from the rank's first, as they are in A.
  Rows full(const std::vector<int>& rows) const;
  Rows full() const;
  double bytes() const;

 private:
  template <class Each>
  static Rows couplings(const Ranks& ranks, int block, int own_rows, const Each& each);
  void fetch(const double* x);

  Ranks ranks_;
  int block_, first_ = 0;  ///< first_: own node
  std::vector<int> starts_, columns_;                           ///< own blocks before the diagonal: of each own node, ascending
  std::vector<double> below_, diagonal_;                        ///< their numbers, row by row
  Buckets above_, above_places_;                                ///< of each own node those with a block in its column, and the places of these blocks
  std::vector<int> others_, other_starts_, other_columns_;      ///< other_columns_: places in others_
  std::vector<double> other_;
  std::vector<int> border_;                                     ///< own nodes that have such
  std::vector<std::vector<int>> asked_;                         ///< by rank the own nodes whose numbers it needs
  std::vector<int> other_counts_;                               ///< by rank how many of others_ are its
  std::vector<double> theirs_;                                  ///< of the nodes others_
  Room room_;
};

template <class Each>
Rows HalfMatrix::couplings(const Ranks& ranks, int block, int own_rows, const Each& each) {
  const int own = own_rows / block, first = ranks.before(own);
  std::vector<int> last(static_cast<std::size_t>(own), -1);  // the node that the pair before was with: each pair of nodes comes several times
  const auto is_own = [&](int node) { return node >= first && node < first + own; };
  const Buckets pairs(own, [&](auto&& put) {
    std::ranges::fill(last, -1);
    each([&](int i, int j, double) {
      const int a = i / block, b = j / block;
      if (a == b) return;
      const int at = is_own(a) && (!is_own(b) || b < a) ? a : b, other = at == a ? b : a;
      if (!is_own(at) || last[at - first] == other) return;
      last[at - first] = other, put(at - first, other);
    });
  });
  Rows nodes;
  std::vector<int> row;
  for (int node = 0; node < own; ++node) {
    row.assign(pairs[node].begin(), pairs[node].end());
    std::ranges::sort(row);
    nodes.columns.insert(nodes.columns.end(), row.begin(), std::ranges::unique(row).begin());
    nodes.starts.push_back(static_cast<int>(nodes.columns.size()));
  }
  return nodes;
}

}  // namespace dotyk::multigrid
