// A rank's rows of a symmetric matrix.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/buckets.hpp"
#include "multigrid/processes/ranks.hpp"
#include "multigrid/rows/kernels.hpp"
#include "multigrid/rows/rows.hpp"

namespace dotyk::multigrid {

/// Rows of a symmetric matrix, of nodes that follow one another, as blocks, one for each pair of coupled nodes. Of blocks between two of these nodes those left of
/// the diagonal are stored, and those on it; of blocks in columns of other nodes all. Nodes are counted over all ranks where nothing else is said.
struct HalfRows {
  int block = 1;                        ///< rows of a node
  int first = 0;                        ///< own node
  std::vector<int> starts{0}, columns;  ///< own blocks before the diagonal: of each own node, ascending, counted from `first`
  std::vector<double> below, diagonal;  ///< their numbers, row by row; kSpare numbers more in `below`
  std::vector<int> other_starts{0}, others;  ///< blocks in other columns: nodes, ascending for each own one
  std::vector<double> other;

  HalfRows() = default;
  /// Zeros. `nodes`: for each own node the nodes that it is coupled to. Own nodes after it, and itself, are ignored.
  HalfRows(int block, int first, const Rows& nodes);

  int nodes() const { return static_cast<int>(starts.size()) - 1; }
  bool own(int node) const { return node >= first && node < first + nodes(); }

  /// Where a block is stored: with the node of its row, or transposed with the node of its column. `numbers` is null where the pattern has no such block.
  struct Place {
    int row = -1, column = -1;  ///< nodes
    double* numbers = nullptr;
    bool transposed = false;

    /// The number at a row and a column of the block.
    double& at(int block, int r, int c) const { return numbers[transposed ? c * block + r : r * block + c]; }
  };
  Place place(int row, int column);  ///< of two nodes that others have: none
};

/// The same with zeros for these pairs of coupled nodes, too.
HalfRows widened(const HalfRows& rows, const std::vector<std::array<int, 2>>& pairs);

/// Zeros, with room for the pairs of coupled nodes: pairs(visit) calls visit(node, node), in any order and some of them several times. It is called twice.
template <class Pairs>
HalfRows room_for(int block, int first, int nodes, const Pairs& pairs);

/// each(visit) calls visit(row, column, number) once for each pair of entries (i, j), (j, i) that has one of these rows or columns, in any order. It is called
/// three times.
template <class Each>
HalfRows half_rows(int block, int first, int nodes, const Each& each);

/// The rows of this rank. Rows, columns and nodes are counted over all ranks where nothing else is said; own nodes from the rank's first.
class HalfMatrix {
 public:
  /// Collective.
  HalfMatrix(const Ranks& ranks, HalfRows rows);

  const Ranks& ranks() const { return ranks_; }
  const HalfRows& stored() const { return rows_; }
  int block() const { return rows_.block; }    ///< rows of a node
  int nodes() const { return rows_.nodes(); }  ///< own ones
  int rows() const { return nodes() * block(); }
  int first_row() const { return rows_.first * block(); }
  bool has(int row) const { return rows_.own(row / block()); }

  /// Replaces all numbers; the matrix is of one rank. `below` and `diagonal` are as in HalfRows, but `below` has no spare numbers. Sets the flag in `changed` of
  /// each row that has a new number.
  void take(const std::vector<double>& below, const std::vector<double>& diagonal, std::vector<char>& changed);

  /// The number at a row, counted from the rank's first, and a column; null where the pattern has no such entry. (i, j) and (j, i) share one place if they
  /// belong to different own nodes. Within one node each has its own, and both must be written.
  double* find(int row, int column);
  double diagonal(int row) const { return rows_.diagonal[static_cast<std::size_t>(row) * block() + row % block()]; }
  double& diagonal(int row) { return rows_.diagonal[static_cast<std::size_t>(row) * block() + row % block()]; }

  /// How a block is to be read.
  enum class Read { as_it_is, transposed };
  /// Calls visit(node, block, read) for the blocks of an own node. `node`: an own one, or nodes() + its place in others().
  template <class Visit>
  void each_block(int node, const Visit& visit) const {
    each_stored(*this, node, [&](int other, const double* block) { visit(other, block, Read::as_it_is); });
    const std::int64_t square = block() * block();
    const auto above = above_[node], places = above_places_[node];
    for (std::size_t k = 0; k < above.size(); ++k) visit(above[k], rows_.below.data() + places[k] * square, Read::transposed);
  }
  /// The number at a row and a column of a block.
  double entry(const double* block, Read read, int r, int c) const { return block[read == Read::transposed ? c * rows_.block + r : r * rows_.block + c]; }
  /// The same of the blocks that are stored with the node, whose numbers may be changed: none is transposed.
  template <class Visit>
  void each_own_block(int node, const Visit& visit) {
    each_stored(*this, node, visit);
  }
  template <class Visit>
  void each_own_block(int node, const Visit& visit) const {
    each_stored(*this, node, visit);
  }
  const std::vector<int>& others() const { return others_; }  ///< nodes of other ranks, ascending
  /// The number of an own node, or of one of other ranks, as each_block() counts.
  int number(int node) const { return node < nodes() ? rows_.first + node : others_[node - nodes()]; }

  /// Half of the rows in own columns.
  HalfBlocks<double> half() const { return {block(), rows_.starts, rows_.columns.data(), rows_.below.data(), 1, rows_.diagonal.data()}; }

  /// Two vectors to work with: what multiplies and sweeps with this matrix needs.
  struct Room {
    PaddedVector x, y;
  };
  Room& room() { return room_; }

  /// y = A x for vectors of own rows. Collective.
  void times(const double* x, double* y);
  /// The same in columns of other ranks alone: calls add(node, numbers) for own nodes where there are such, with the numbers of their rows. Collective.
  template <class Add>
  void times_others(const double* x, const Add& add) {
    times_others(x, block(), add);
  }
  template <class Add>
  void times_others(const PaddedVector& x, const Add& add) {
    times_others(x.data(), x.width(), add);
  }
  /// A vector of own rows at others(). Collective.
  const std::vector<double>& theirs(const double* x) {
    if (!ranks_.alone()) fetch(x, block());
    return theirs_;
  }
  const std::vector<std::vector<int>>& asked() const { return asked_; }  ///< by rank the own nodes that are among its others()
  const std::vector<int>& border() const { return border_; }  ///< own nodes that are coupled to others(), ascending

  /// Some of the own rows, counted from the rank's first, as they are in A.
  Rows full(const std::vector<int>& rows) const;
  Rows full() const;
  double bytes() const;

 private:
  template <class Self, class Visit>
  static void each_stored(Self& self, int node, const Visit& visit) {
    auto& rows = self.rows_;
    const std::int64_t square = rows.block * rows.block;
    for (int k = rows.starts[node]; k < rows.starts[node + 1]; ++k) visit(rows.columns[k], rows.below.data() + k * square);
    visit(node, rows.diagonal.data() + node * square);
    for (int k = rows.other_starts[node]; k < rows.other_starts[node + 1]; ++k) visit(self.nodes() + self.other_places_[k], rows.other.data() + k * square);
  }
  /// `width`: numbers of a node in x.
  void fetch(const double* x, int width);
  template <class Add>
  void times_others(const double* x, int width, const Add& add) {
    if (ranks_.alone()) return;
    fetch(x, width);
    dispatch(block(), [&]<int rows>() {
      for (const int node : border_) {
        double sums[rows] = {};
        for (int k = rows_.other_starts[node]; k < rows_.other_starts[node + 1]; ++k) {
          const double *numbers = rows_.other.data() + static_cast<std::int64_t>(k) * (rows * rows), *theirs = theirs_.data() + static_cast<std::int64_t>(other_places_[k]) * rows;
          for (int r = 0; r < rows; ++r)
            for (int c = 0; c < rows; ++c) sums[r] += numbers[r * rows + c] * theirs[c];
        }
        add(node, sums);
      }
    });
  }

  Ranks ranks_;
  HalfRows rows_;
  Buckets above_, above_places_;   ///< of each own node those with a block in its column, and the places of these blocks
  std::vector<int> others_, other_places_;  ///< the latter: of rows_.others in the former
  std::vector<int> border_;
  std::vector<std::vector<int>> asked_;    ///< by rank the own nodes whose numbers it needs
  std::vector<std::vector<double>> sent_;  ///< these numbers
  std::vector<int> other_counts_;          ///< by rank how many numbers it sends
  std::vector<double> theirs_;             ///< of the nodes others_
  Room room_;
};

template <class Pairs>
HalfRows room_for(int block, int first, int nodes, const Pairs& pairs) {
  std::vector<int> last(static_cast<std::size_t>(nodes), -1);  // neighbour of each node: most repeats of a pair follow one another
  const auto is_own = [&](int node) { return node >= first && node < first + nodes; };
  const Buckets coupled(nodes, [&](auto&& put) {
    std::ranges::fill(last, -1);
    pairs([&](int a, int b) {
      if (a == b) return;
      const int at = is_own(a) && (!is_own(b) || b < a) ? a : b, other = at == a ? b : a;
      if (!is_own(at) || last[at - first] == other) return;
      last[at - first] = other, put(at - first, other);
    });
  });
  Rows rows;
  std::vector<int> row;
  for (int node = 0; node < nodes; ++node) {
    row.assign(coupled[node].begin(), coupled[node].end());
    rows.append_columns(row);
  }
  return {block, first, rows};
}

template <class Each>
HalfRows half_rows(int block, int first, int nodes, const Each& each) {
  HalfRows rows = room_for(block, first, nodes, [&](auto&& visit) { each([&](int i, int j, double) { visit(i / block, j / block); }); });
  HalfRows::Place last_place;
  each([&](int i, int j, double number) {
    const int a = i / block, b = j / block, r = i % block, c = j % block;
    if (a != last_place.row || b != last_place.column) last_place = rows.place(a, b);
    if (!last_place.numbers) return;
    last_place.at(block, r, c) = number;
    if (a == b) last_place.at(block, c, r) = number;
  });
  return rows;
}

}  // namespace dotyk::multigrid
